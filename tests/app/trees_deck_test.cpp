#include "app/deck/trees_deck.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "app/deck/particles_deck.hpp"
#include "app/deck/population_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/problems/reactor/reactor_case.hpp"
#include "tests/flow/flame/streams.hpp"
#include "tests/messages.hpp"

namespace lampblack::app {
namespace {

TreeRequest requestOf(const std::string& mechanism, const std::string& particles, const std::string& rest = "") {
  const std::string text =
      "problem: reactor\nmechanism: m.yaml\nreactor: {type: constant_pressure}\ntime: {end: 1 s}\n"
      "particles:\n  description: trees\n" +
      rest + particles;
  return readTrees(Deck::parse(text, "deck.yaml", {}, reactorSchema()), shippedMechanism(mechanism));
}

constexpr double rounding = 1e-15;
void expectUnits(const TreeUnits& one, const TreeUnits& other) {
  for (std::size_t c = 0; c < one.size(); ++c) EXPECT_EQ(one[c], other[c]);
}

// The shipped material as a table of the deck's own.
TEST(TreesDeck, SilicaAsATableIsSilica) {
  const std::string table = R"(
  material: table
  density: 2200 kg/m^3
  fractal_dimension: 1.8
  growth_rate: 1e13 cm^3/mol/s
  sintering: {mechanism: viscous_flow, prefactor: 1.1e-16, activation_temperature: 1.2e5 K, critical_diameter: 4.4 nm}
  table:
    name: silica
    components:
      - {name: Si, weight: 28.08 g/mol, elements: [Si], atoms: [1]}
      - {name: O, weight: 16 g/mol, elements: [O], atoms: [1]}
      - {name: OH, weight: 17.01 g/mol, elements: [O, H], atoms: [1, 1]}
    precursor: H4O4SI
    product: H2O
    molecule_mass: 9.981e-26 kg
    molecule_diameter: 0.32 nm
    nucleus: [2, 1, 6]
    site: OH
    bridge: O
    growth: [1, 1, 2]
)";
  const TreeMaterial own = requestOf("silica_teos_29.yaml", table).options.material;
  const TreeMaterial deck = requestOf("silica_teos_29.yaml", "  material: silica\n").options.material;
  for (const TreeMaterial& shipped : {silica(), deck}) {
    EXPECT_EQ(own.name, shipped.name);
    EXPECT_EQ(own.density, shipped.density);
    EXPECT_EQ(own.fractalDimension, shipped.fractalDimension);
    EXPECT_EQ(own.smoothing, shipped.smoothing);
    ASSERT_EQ(own.components.size(), shipped.components.size());
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(own.components[c].name, shipped.components[c].name);
      EXPECT_NEAR(own.components[c].weight / shipped.components[c].weight, 1, rounding);
      EXPECT_EQ(own.components[c].elements, shipped.components[c].elements);
    }
    EXPECT_EQ(own.sintering.mechanism, shipped.sintering.mechanism);
    EXPECT_EQ(own.sintering.prefactor, shipped.sintering.prefactor);
    EXPECT_EQ(own.sintering.temperature, shipped.sintering.temperature);
    EXPECT_NEAR(own.sintering.critical / shipped.sintering.critical, 1, rounding);
    const SiteReactions &a = *own.sites(), &b = *shipped.sites();
    EXPECT_EQ(own.species(), shipped.species());
    EXPECT_EQ(a.site, b.site);
    EXPECT_EQ(a.bridge, b.bridge);
    EXPECT_EQ(a.condenses, b.condenses);
    expectUnits(a.nucleus, b.nucleus);
    expectUnits(a.growth, b.growth);
    for (const auto value :
         {&SiteReactions::nucleusPrecursors, &SiteReactions::nucleusProducts, &SiteReactions::moleculeMass,
          &SiteReactions::growthProducts, &SiteReactions::power, &SiteReactions::energy})
      EXPECT_EQ(a.*value, b.*value);
    EXPECT_NEAR(a.moleculeDiameter / b.moleculeDiameter, 1, rounding);
    EXPECT_NEAR(a.prefactor / b.prefactor, 1, rounding);
  }
}

TEST(TreesDeck, PrimariesAreSpheresInSpaceWhereItSaysSo) {
  const std::string silica = "silica_teos_29.yaml", spheres = "  material: silica\n  geometry: spheres\n";
  const TreeOptions options = requestOf(silica, spheres + "  collision_size: shadow\n").options;
  EXPECT_EQ(options.shape, TreeShape::spheres);
  EXPECT_EQ(options.size, CollisionSize::shadow);
  EXPECT_EQ(requestOf(silica, "  material: silica\n").options.shape, TreeShape::primaries);
  EXPECT_THAT(
      test::messageOf<InputError>([&] { (void)requestOf(silica, "  material: silica\n  collision_size: shadow\n"); }),
      testing::HasSubstr("only particles with 'geometry: spheres' have a shadow"));
  EXPECT_THAT(test::messageOf<InputError>(
                  [&] { (void)requestOf(silica, spheres + "  sintering: {size: volume_to_surface}\n"); }),
              testing::HasSubstr("the size is that of the 'smaller'"));
}

TEST(TreesDeck, SootHasThePhysicsOfItsModels) {
  const std::string soot =
      "  pah: [A2, A4]\n  density: 1700 kg/m^3\n  van_der_waals: 2\n  slip: air\n  oxidation: false\n";
  const TreeRequest request = requestOf("ethylene_abf2000_101.yaml", "  material: soot\n", soot);
  const TreeOptions& options = request.options;
  const TreeMaterial& m = options.material;
  ASSERT_NE(m.soot(), nullptr);
  EXPECT_EQ(m.density, 1700);
  EXPECT_EQ(m.soot()->soot.pah[1].carbon, 16);
  EXPECT_FALSE(m.soot()->soot.oxidation);
  EXPECT_TRUE(m.soot()->breaksUp && m.soot()->keepsHydrogen && !m.soot()->alphaOfPrimaries);
  EXPECT_EQ(options.kernel.enhancement, 2);
  EXPECT_EQ(options.kernel.slip, SlipLaw::air);
  EXPECT_EQ(options.size, CollisionSize::volumeToSurface);
  EXPECT_EQ(request.viscosity, GasViscosity::transport);
  EXPECT_TRUE(options.coagulation);
  EXPECT_FALSE(m.sintering.active());
  EXPECT_FALSE(m.soot()->fragmentation.active);
  EXPECT_EQ(m.soot()->fragmentation.factor, 1e5);
  const SootReactions other = *requestOf("ethylene_abf2000_101.yaml",
                                         "  burnt_primaries: join\n  keep_hydrogen: false\n  active_sites: primary\n"
                                         "  fragmentation: true\n  fragmentation_factor: 3e4\n",
                                         soot)
                                   .options.material.soot();
  EXPECT_TRUE(!other.breaksUp && !other.keepsHydrogen && other.alphaOfPrimaries && other.fragmentation.active);
  EXPECT_EQ(other.fragmentation.factor, 3e4);
}

// By volume and surface silica has the law of collisions, the sample and the viscosity of trees.
TEST(TreesDeck, AnEnsembleOfSilicaIsBySurfaceAndVolume) {
  const std::string text =
      "problem: reactor\nmechanism: m.yaml\nreactor: {type: constant_pressure}\ntime: {end: 1 s}\n"
      "particles: {material: silica, description: ensemble}\n";
  const Deck deck = Deck::parse(text, "deck.yaml", {}, reactorSchema());
  EXPECT_TRUE(isOfTrees(deck));
  const TreeRequest request = readTrees(deck, shippedMechanism("silica_teos_29.yaml"));
  EXPECT_EQ(request.options.shape, TreeShape::surfaceVolume);
  EXPECT_EQ(request.options.particles, 8192U);
  EXPECT_EQ(request.options.splitTolerance, 0.05);
  EXPECT_EQ(request.options.size, CollisionSize::primaries);
  EXPECT_EQ(request.viscosity, GasViscosity::air);
}

TEST(TreesDeck, SilicaKeepsItsOwnDefaults) {
  const TreeRequest request = requestOf("silica_teos_29.yaml", "  material: silica\n");
  EXPECT_EQ(request.options.size, CollisionSize::primaries);
  EXPECT_EQ(request.viscosity, GasViscosity::air);
  EXPECT_EQ(request.options.kernel.slip, SlipLaw::air);
  EXPECT_EQ(request.options.material.sintering.mechanism, SinteringMechanism::viscousFlow);
}

// One factory for every kind: an owner of random numbers of its own for each, and what the start says.
TEST(PopulationDeck, MakesTheKindThatADeckAsksFor) {
  const auto requestOfDeck = [](const std::string& mechanism, const std::string& text) {
    const Deck deck = Deck::parse(
        "problem: reactor\nmechanism: m.yaml\nreactor: {type: constant_pressure}\n"
        "time: {end: 1 s}\n" +
            text,
        "deck.yaml", {}, reactorSchema());
    EXPECT_TRUE(hasPopulation(deck));
    return readPopulation(deck, std::make_shared<Mechanism>(shippedMechanism(mechanism)));
  };
  const auto ownerOfMade = [](const StochasticPopulation& made) {
    const std::vector<double> packed = made.pack();
    return ownerOf({packed[packedOwnerAt], packed[packedOwnerAt + 1]});
  };
  const PopulationRequest trees = requestOfDeck("silica_teos_29.yaml",
                                                "particles: {material: silica, description: trees, number: 100, "
                                                "initial: {number: 1e15 1/m^3, units: [10, 15, 6]},\n"
                                                "  classes: {primaries: [2, 10]}}\n");
  EXPECT_EQ(trees.viscosity, GasViscosity::air);
  EXPECT_TRUE(trees.hasStart);
  ASSERT_EQ(trees.classes.size(), 1U);
  const auto silica = trees.make(7);
  EXPECT_EQ(silica->material(), "silica");
  EXPECT_EQ(silica->size(), 100U);
  EXPECT_EQ(ownerOfMade(*silica), 7U);
  EXPECT_EQ(silica->classedBy()[trees.classes[0].by].name, "primaries");

  const PopulationRequest spheres =
      requestOfDeck("ethylene_abf2000_101.yaml", "particles: {description: ensemble, repeats: 3, number: 50}\n");
  EXPECT_EQ(spheres.repeats, 3U);
  EXPECT_FALSE(spheres.hasStart);
  const auto soot = spheres.make(5);
  EXPECT_EQ(soot->material(), "soot");
  EXPECT_EQ(ownerOfMade(*soot), 5U);
}

// Published: Kobata, Kusakabe, Morooka (1991), of 10 nm at 1500 K.
TEST(TreesDeck, TitaniaSintersByGrainBoundaryDiffusion) {
  const SinteringLaw law = requestOf("silica_teos_29.yaml",
                                     "  material: silica\n  sintering: {mechanism: grain_boundary, prefactor: 7.4e16, "
                                     "activation_temperature: 3.1e4 K, "
                                     "critical_diameter: 0 nm}\n")
                               .options.material.sintering;
  EXPECT_NEAR(law.time(1500, 1e-8) / (7.4e16 * 1e-32 * 1500 * std::exp(31000.0 / 1500)), 1, 1e-12);
  for (const auto& [name, power] : {std::pair{"surface_diffusion", 4}, std::pair{"volume_diffusion", 3},
                                    std::pair{"viscous_flow", 1}, std::pair{"constant", 0}}) {
    const SinteringLaw other =
        requestOf("silica_teos_29.yaml", std::string("  material: silica\n  sintering: {mechanism: ") + name +
                                             ", prefactor: 2, activation_temperature: 0 K}\n")
            .options.material.sintering;
    EXPECT_NEAR(other.time(900, 4e-9) / other.time(900, 2e-9), std::pow(2.0, power), 1e-9) << name;
  }
}

TEST(TreesDeck, TheStartMayBeASumOfDistributions) {
  const auto startOf = [](const std::string& initial) {
    return requestOf("silica_teos_29.yaml", "  material: silica\n  initial: " + initial + "\n").start;
  };
  EXPECT_TRUE(requestOf("silica_teos_29.yaml", "  material: silica\n").start.empty());
  EXPECT_TRUE(startOf("[]").empty());
  const auto alike = startOf("{number: 1e10 1/cm^3, units: [100, 150, 100]}");
  ASSERT_EQ(alike.size(), 1U);
  EXPECT_DOUBLE_EQ(alike[0].number, 1e16);
  EXPECT_EQ(alike[0].sizes.distribution, InitialPopulation::Distribution::none);
  expectUnits(alike[0].units, {100, 150, 100});
  const auto two = startOf(R"(
    - {number: 1e10 1/cm^3, units: [100, 150, 100]}
    - {distribution: lognormal, number: 1e8 1/cm^3, diameter: 20 nm, geometric_deviation: 1.4, units: [1, 2, 0]})");
  ASSERT_EQ(two.size(), 2U);
  EXPECT_DOUBLE_EQ(two[0].number, 1e16);
  EXPECT_NEAR(two[1].sizes.volume / (std::acos(-1.0) / 6 * 8e-24), 1, 1e-12);
  EXPECT_DOUBLE_EQ(two[1].sizes.number, 1e14);
  expectUnits(two[1].units, {1, 2, 0});
  const auto warningOf = [&](const std::string& deviation) {
    testing::internal::CaptureStderr();
    (void)startOf("{distribution: lognormal, number: 1, diameter: 20 nm, units: [1, 2, 0], geometric_deviation: " +
                  deviation + "}");
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(warningOf("1.1"), "");
  EXPECT_THAT(warningOf("2"),
              testing::HasSubstr("particles.initial: the 8192 numerical particles of the first sample miss"));
  for (const auto& [initial, message] : std::vector<std::pair<std::string, std::string>>{
           {"{number: 1}", "particles.initial: particles at the start need both 'number' and 'units'"},
           {"[{units: [1, 2, 0]}]", "particles.initial[0]: particles at the start need both 'number' and 'units'"},
           {"{distribution: lognormal, number: 1, diameter: 1 nm, geometric_deviation: 2}",
            "need both 'distribution' and 'units'"},
           {"{number: 1, units: [1, 2]}", "particles.initial.units: 2 numbers for 3 components of silica"},
           {"{number: 1, diameter: 1 nm, units: [1, 2, 0]}", "this counts only with 'particles.initial.distribution'"},
           {"{distribution: table, number: 1, file: b.csv, units: [1, 2, 0]}", "the numbers are those of the table"}})
    EXPECT_THAT(test::messageOf<InputError>([&, &text = initial] { (void)startOf(text); }), testing::HasSubstr(message))
        << initial;
}

}  // namespace
}  // namespace lampblack::app
