// Decks become the right numbers, and the reference pages know every key.
#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/modules.hpp"
#include "tests/app/app_fixture.hpp"

namespace lampblack::app {
namespace {

using testing::ElementsAre;

FlowCase withTransport(const std::vector<std::string>& overrides) {
  return readFlowCase(
      Deck::load(test::sourceFolder / "cases/flow/counterflow_ethylene/deck.yaml", overrides, flowSchema()));
}

TEST(FlowCase, ReadsTheTransportModel) {
  EXPECT_EQ(withTransport({}).transport.diffusion, TransportModel::Diffusion::MixtureAveraged);
  EXPECT_EQ(withTransport({}).transport.integrals, CollisionIntegrals::MonchickMason);
  EXPECT_EQ(withTransport({"transport.collision_integrals=wang_fits"}).transport.integrals,
            CollisionIntegrals::WangFits);
  EXPECT_EQ(withTransport({"transport.model=unity_lewis"}).transport.diffusion, TransportModel::Diffusion::UnityLewis);
  const auto constant =
      withTransport({"transport.model=constant_lewis", "transport.lewis_numbers='H2: 0.3, C2H4: 1.2'"});
  EXPECT_EQ(constant.transport.diffusion, TransportModel::Diffusion::ConstantLewis);
  EXPECT_EQ(constant.transport.lewisNumbers[constant.mechanism->speciesIndex("H2")], 0.3);
  EXPECT_EQ(constant.transport.lewisNumbers[constant.mechanism->speciesIndex("N2")], 1.0);
  EXPECT_THROW(withTransport({"transport.model=constant_lewis"}), InputError);
  EXPECT_THROW(withTransport({"transport.lewis_numbers='H2: 0.3'"}), InputError);
  EXPECT_THROW(withTransport({"transport.model=constant_lewis", "transport.lewis_numbers='H2: 0'"}), InputError);
  EXPECT_THROW(withTransport({"transport.model=constant_lewis", "transport.lewis_numbers='HH: 1'"}), InputError);
}

TEST(FlowCase, ReadsSutherlandsLaw) {
  const std::string law =
      "transport.sutherland={viscosity: 1.68e-5 Pa s, temperature: 273 K, constant: 110.5 K, "
      "prandtl_number: 0.71}";
  const auto read = withTransport({"transport.model=unity_lewis", law}).transport.sutherland;
  ASSERT_TRUE(read);
  EXPECT_EQ(read->viscosity, 1.68e-5);
  EXPECT_EQ(read->temperature, 273);
  EXPECT_EQ(read->constant, 110.5);
  EXPECT_EQ(read->prandtl, 0.71);
  EXPECT_THROW(withTransport({law}), InputError);
}

TEST(FlowCase, ReadsHowVelocitiesAreCarried) {
  EXPECT_EQ(withTransport({}).flow.velocityScheme, VelocityScheme::Limited);
  EXPECT_EQ(withTransport({"convection.velocity=central", "time.sweeps=2"}).flow.velocityScheme,
            VelocityScheme::Central);
  EXPECT_THROW(withTransport({"convection.velocity=central"}), InputError);
}

TEST(FlowCase, ReadsTheShippedDeck) {
  const Deck deck = Deck::load(test::sourceFolder / "cases/flow/counterflow_ethylene/deck.yaml", {}, flowSchema());
  const FlowCase flowCase = readFlowCase(deck);
  EXPECT_EQ(flowCase.mechanism->numSpecies(), 47U);
  EXPECT_DOUBLE_EQ(flowCase.pressure, 101325.0);
  EXPECT_EQ(flowCase.mesh.geometry, Geometry::Axisymmetric);
  EXPECT_TRUE(flowCase.mesh.vertices[2].empty());
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto& vertices = flowCase.mesh.vertices[axis];
    EXPECT_EQ(vertices.front(), 0.0);
    EXPECT_TRUE(std::is_sorted(vertices.begin(), vertices.end()));
  }
  EXPECT_NEAR(flowCase.mesh.vertices[0].back(), 14e-3, 1e-15);
  EXPECT_NEAR(flowCase.mesh.vertices[1].back(), 8e-3, 1e-15);

  std::vector<std::string> names;
  for (const BoundaryCondition& boundary : flowCase.boundaries) names.push_back(boundary.name);
  EXPECT_THAT(names, ElementsAre("fuel", "oxidiser", "fuel_flange", "oxidiser_flange", "axis", "outflow"));
  const std::size_t C2H4 = flowCase.mechanism->speciesIndex("C2H4");
  const std::size_t O2 = flowCase.mechanism->speciesIndex("O2");
  const BoundaryCondition& fuel = flowCase.boundaries[0];
  EXPECT_EQ(fuel.kind, BoundaryKind::Inlet);
  EXPECT_DOUBLE_EQ(fuel.speed, 0.2);
  EXPECT_DOUBLE_EQ(fuel.temperature, 298.0);
  EXPECT_DOUBLE_EQ(fuel.Y[C2H4], 1.0);
  // Mole fractions 0.25 and 0.75 of molecules of 31.998 and 28.014 g/mol.
  EXPECT_NEAR(flowCase.boundaries[1].Y[O2], 0.25 * 31.998 / (0.25 * 31.998 + 0.75 * 28.014), 1e-6);
  EXPECT_EQ(flowCase.boundaries[2].kind, BoundaryKind::Wall);
  EXPECT_FALSE(flowCase.boundaries[2].isothermal);
  EXPECT_EQ(flowCase.boundaries[4].kind, BoundaryKind::Symmetry);
  EXPECT_EQ(flowCase.boundaries[5].kind, BoundaryKind::Outlet);
  EXPECT_EQ(flowCase.mesh.patches[0].axis, 1);
  EXPECT_FALSE(flowCase.mesh.patches[0].atMax);
  EXPECT_DOUBLE_EQ(flowCase.mesh.patches[0].to, 10e-3);
  EXPECT_EQ(flowCase.mesh.patches[5].axis, 0);
  EXPECT_TRUE(flowCase.mesh.patches[5].atMax);

  EXPECT_EQ(flowCase.initial.low.Y, fuel.Y);
  EXPECT_EQ(flowCase.initial.high.Y, flowCase.boundaries[1].Y);
  EXPECT_TRUE(flowCase.initial.burnt);
  ASSERT_TRUE(flowCase.carried);
  const SootModelOptions& soot = test::dimerOptions(flowCase);
  ASSERT_EQ(soot.pah.size(), 1U);
  EXPECT_EQ(soot.pah[0].name, "A2");
  EXPECT_EQ(soot.pah[0].carbon, 10);
  EXPECT_EQ(soot.pah[0].hydrogen, 8);
  EXPECT_DOUBLE_EQ(soot.pah[0].stickingCoefficient, *defaultStickingCoefficient("A2"));
  ASSERT_TRUE(flowCase.trajectories);
  ASSERT_EQ(flowCase.trajectories->starts.size(), 4U);
  EXPECT_DOUBLE_EQ(flowCase.trajectories->starts[0][0], 0.5e-3);
  EXPECT_DOUBLE_EQ(flowCase.trajectories->starts[0][1], 4.5e-3);
}

TEST(FlowCase, FillsInDefaultsInSi) {
  const FlowCase flowCase = readFlowCase(test::flameDeck());
  EXPECT_EQ(flowCase.title, "A small flame");
  EXPECT_EQ(flowCase.seed, 1U);
  EXPECT_DOUBLE_EQ(flowCase.time.end, 10e-6);
  EXPECT_DOUBLE_EQ(flowCase.time.firstStep, 1e-6);
  EXPECT_DOUBLE_EQ(flowCase.output.interval, flowCase.time.end);
  EXPECT_EQ(flowCase.output.species.size(), flowCase.mechanism->numSpecies());
  EXPECT_DOUBLE_EQ(flowCase.chemistry.reactor.relativeTolerance, 1e-6);
  EXPECT_DOUBLE_EQ(test::dimerOptions(flowCase).sootDensity, 1850.0);
  EXPECT_FALSE(test::dimerOptions(flowCase).alpha);
  EXPECT_DOUBLE_EQ(flowCase.trajectories->bins.logMin, std::log10(0.5e-9));
  EXPECT_DOUBLE_EQ(flowCase.trajectories->bins.logMax, std::log10(200e-9));
}

// Every default of the schema has to be one: a deck that only says what it must is a good deck.
// An opening whose gas outside nobody names, where the flow starts as one gas.
TEST(FlowCase, OutsideAnOutletIsTheGasOfTheStart) {
  const std::string outlet = "boundaries.outflow={type: outlet, side: r-max}";
  const std::string one = "initial={layer: none, temperature: 310 K, composition: 'O2: 1'}";
  const FlowCase flowCase = withTransport({outlet, one});
  EXPECT_EQ(flowCase.boundaries[5].kind, BoundaryKind::Outlet);
  EXPECT_EQ(flowCase.boundaries[5].temperature, 310);
  EXPECT_EQ(flowCase.boundaries[5].Y[flowCase.mechanism->speciesIndex("O2")], 1);
  EXPECT_THROW(withTransport({outlet}), InputError);
  EXPECT_THROW(withTransport({outlet, "initial={layer: none, composition: 'O2: 1'}"}), InputError);
  EXPECT_THROW(withTransport({"boundaries.outflow={type: outlet, side: r-max, temperature: 300 K}", one}), InputError);
}

TEST(FlowCase, NeedsNoTitle) {
  std::string text;
  {
    std::ifstream file(test::sourceFolder / "tests/app/flame.yaml");
    for (std::string line; std::getline(file, line);)
      if (!line.starts_with("title:")) text += line + "\n";
  }
  EXPECT_EQ(Deck::parse(text, "flame.yaml", {}, flowSchema()).string("title"), "");
}

TEST(FlowCase, WithoutSootThereAreNoTrajectories) {
  const FlowCase flowCase = readFlowCase(test::flameDeck({"particles.description=none"}));
  EXPECT_FALSE(flowCase.carried);
  EXPECT_FALSE(flowCase.trajectories);
}

TEST(FlowCase, RefinementMultipliesTheCells) {
  const FlowCase fine = readFlowCase(test::flameDeck({"mesh.refinement=3"}));
  EXPECT_EQ(fine.mesh.vertices[0].size(), 3U * 6U + 1U);
  EXPECT_EQ(fine.mesh.vertices[1].size(), 3U * 10U + 1U);
}

TEST(FlowSchema, BothReferencesListEveryKey) {
  const DeckSchema schema = flowSchema();
  const std::string page = markdownReference(schema);
  const std::string json = jsonSchema(schema);
  for (const DeckKey& key : schema.keys()) {
    std::string name = key.path.substr(key.path.rfind('.') + 1);
    if (name.ends_with("[]")) name.resize(name.size() - 2);
    // Not by HasSubstr, which would print the whole page.
    EXPECT_NE(page.find("`" + key.path + "`"), std::string::npos) << key.path;
    EXPECT_NE(page.find(key.doc), std::string::npos) << key.path;
    // A name that the user chooses stands in no schema; what it is does.
    EXPECT_NE(json.find(name == "*" ? key.doc : "\"" + name + "\""), std::string::npos) << key.path;
  }
}

}  // namespace
}  // namespace lampblack::app
