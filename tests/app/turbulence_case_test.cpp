// Decks of turbulent flows that cannot be, each with its message, and those of which the user is told.
#include <string>
#include <vector>

#include "tests/app/flow_runs.hpp"
#include "tests/messages.hpp"

namespace lampblack::app {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

Deck channelDeck(const std::vector<std::string>& overrides) {
  return test::flowDeck("perfect_gas_1.yaml", R"(
turbulence: {model: sst, energy: 0.1 m^2/s^2}
mesh: {geometry: planar, x: [{to: 4 mm, cells: 5}], y: [{to: 8 mm, cells: 8}]}
boundaries:
  in: {type: inlet, side: y-min, velocity: 3 m/s, temperature: 300 K, composition: "GAS: 1"}
  out: {type: outlet, side: y-max, temperature: 300 K, composition: "GAS: 1"}
  left: {type: wall, side: x-min}
  right: {type: wall, side: x-max, slip: true}
initial: {layer: none, composition: "GAS: 1", temperature: 300 K}
time: {end: 1 ms, maximum_step: 0.1 ms}
)",
                        overrides);
}

const std::string atInlet = "boundaries.in.turbulence_intensity=0.1",
                  withLength = "boundaries.in.turbulence_length=1 mm",
                  withRatio = "boundaries.in.eddy_viscosity_ratio=5", noWall = "boundaries.left.type=symmetry",
                  sa = "turbulence.model=sa", varied = "boundaries.in.formula.turbulent_kinetic_energy=0.1 + 10*x",
                  ofDissipation = "boundaries.in.formula.turbulent_dissipation=2*(0.1 + 10*x)";

TEST(TurbulenceCase, RefusesWhatCannotBe) {
  struct Wrong {
    std::vector<std::string> overrides;
    std::vector<std::string> words;
  };
  const Wrong decks[] = {
      {{atInlet, withLength, noWall},
       {"turbulence.model", "'sst' goes by the distance from walls", "in, out, left, right"}},
      {{sa, noWall}, {"'sa' goes by the distance", "'wall_distance: infinite'"}},
      {{"turbulence={model: k_epsilon, walls: automatic, wall_distance: infinite}", atInlet, withLength},
       {"turbulence.wall_distance", "'turbulence.walls: automatic'", "'k_epsilon'", "the wall 'left'"}},
      {{"turbulence={model: realizable_k_epsilon, walls: automatic, wall_distance: infinite}", atInlet, withLength},
       {"turbulence.wall_distance", "'turbulence.walls: automatic'", "'realizable_k_epsilon'"}},
      {{"turbulence.model=wang", noWall}, {"'wang' goes by the distance"}},
      {{atInlet, withLength, withRatio},
       {"boundaries.in", "'turbulence_length' and 'eddy_viscosity_ratio', found both"}},
      {{}, {"boundaries.in", "needs a 'turbulence_intensity' and one of"}},
      {{atInlet}, {"boundaries.in", "one of 'turbulence_length' and 'eddy_viscosity_ratio'"}},
      {{withRatio}, {"boundaries.in", "needs a 'turbulence_intensity'"}},
      {{sa, withLength}, {"boundaries.in", "a 'turbulence_length' needs a 'turbulence_intensity'"}},
      {{atInlet, withLength, "boundaries.in.velocity=0 m/s"},
       {"turbulence_intensity", "expected an inlet with a velocity"}},
      {{"turbulence={model: k_omega}", varied, ofDissipation}, {"turbulence", "'k_omega' needs the key 'energy'"}},
      {{"turbulence.buoyancy=true", atInlet, withLength}, {"turbulence.buoyancy", "there is no gravity"}},
      {{"turbulence={model: none}", atInlet},
       {"boundaries.in.turbulence_intensity", "the flow has no turbulence model"}},
      {{"turbulence={model: none}", withLength}, {"boundaries.in.turbulence_length", "no turbulence model"}},
      {{"turbulence={model: none}", withRatio}, {"boundaries.in.eddy_viscosity_ratio", "no turbulence model"}},
      {{"boundaries.in.formula.turbulent_kinetic_energy=0.1"},
       {"boundaries.in.formula.turbulent_kinetic_energy", "needs 'turbulent_dissipation' beside it"}},
      {{"boundaries.in.formula.turbulent_dissipation=0.1"}, {"needs 'turbulent_kinetic_energy' beside it"}},
      {{varied, "boundaries.in.formula.turbulent_dissipation=1 + t"}, {"does not vary in time; expected no t"}},
      {{varied, ofDissipation, atInlet}, {"boundaries.in", "expected no 'turbulence_intensity'"}},
      {{varied, ofDissipation, withLength},
       {"boundaries.in", "expected no 'turbulence_intensity', 'turbulence_length'"}},
      {{varied, ofDissipation, withRatio}, {"boundaries.in", "and 'eddy_viscosity_ratio' beside them"}},
      {{"turbulence={model: none}", varied, ofDissipation}, {"boundaries.in", "the flow has no turbulence model"}},
      {{atInlet, withLength, "boundaries.left.formula.turbulent_kinetic_energy=1"}, {"boundaries.left"}},
      {{"turbulence.c_epsilon1=1.6"}, {"turbulence.c_epsilon1"}},
      {{"turbulence={model: none, schmidt: 0.7}"}, {"turbulence.schmidt"}},
      {{"turbulence={model: none, wall_distance: infinite}"}, {"turbulence.wall_distance"}},
      {{sa, "turbulence.walls=automatic"}, {"turbulence.walls"}},
      {{"turbulence.model=k_epsilon", "turbulence.walls=resolved"},
       {"turbulence.walls", "no form of its own", "'automatic'"}},
      {{"turbulence.model=les"}, {"turbulence.model", "les", "k_epsilon"}},
      {{"turbulence.energy=0 m^2/s^2"}, {"turbulence.energy"}},
      {{"turbulence.energy=-1 m^2/s^2"}, {"turbulence.energy"}},
      {{"turbulence.eddy_viscosity_ratio=0"}, {"turbulence.eddy_viscosity_ratio"}},
      {{"turbulence.largest_eddy_viscosity_ratio=0"}, {"turbulence.largest_eddy_viscosity_ratio"}},
      {{"turbulence.prandtl=0"}, {"turbulence.prandtl"}},
      {{"boundaries.in.turbulence_intensity=0", withLength}, {"boundaries.in.turbulence_intensity"}},
      {{atInlet, "boundaries.in.turbulence_length=0 mm"}, {"boundaries.in.turbulence_length"}},
      {{atInlet, "boundaries.in.eddy_viscosity_ratio=-2"}, {"boundaries.in.eddy_viscosity_ratio"}},
      {{"boundaries.left.turbulence_intensity=0.1"}, {"boundaries.left.turbulence_intensity"}},
      {{sa, "turbulence.wall_distance=infinite", "output.wall_distance=true"}, {"output.wall_distance", "infinite"}},
  };
  for (const Wrong& deck : decks) {
    std::string said = "deck";
    for (const std::string& override : deck.overrides) said += " " + override;
    SCOPED_TRACE(said);
    const std::string message = test::messageOf<InputError>([&] { (void)readFlowCase(channelDeck(deck.overrides)); });
    for (const std::string& word : deck.words) EXPECT_THAT(message, HasSubstr(word));
  }
}

TEST(TurbulenceCase, TellsOfUnlikelyInlets) {
  EXPECT_TRUE(readFlowCase(channelDeck({atInlet, withLength})).notes.empty());
  EXPECT_THAT(
      readFlowCase(channelDeck({"boundaries.in.turbulence_intensity=2", "boundaries.in.turbulence_length=9 mm"})).notes,
      ElementsAre("boundaries.in.turbulence_length: 0.009 m, more than the mesh is long",
                  "boundaries.in.turbulence_intensity: more than one, 2"));
}

TEST(TurbulenceCase, TakesTurbulenceThatVariesOverAnInlet) {
  for (const char* model : {"sst", "k_epsilon", "sa"}) {
    const FlowCase flowCase =
        readFlowCase(channelDeck({varied, ofDissipation, std::string("turbulence.model=") + model}));
    const flow::FreeStream there = flowCase.turbulence.boundaries.at(0).at({1e-3, 0.0, 0.0});
    EXPECT_NEAR(there.energy, 0.11, 1e-15) << model;
    EXPECT_NEAR(there.eddyViscosity, 0.09 * 0.11 / 2.0, 1e-15) << model;
  }
}

TEST(TurbulenceCase, KnowsTheMixtureFractionOfTwoStreams) {
  const std::string fuel = "output.mixture_fraction.fuel=fuel", air = "output.mixture_fraction.oxidizer=oxidiser";
  const FlowCase flowCase = readFlowCase(test::flameDeck({fuel, air}));
  ASSERT_TRUE(flowCase.output.mixtureFraction.has_value());
  for (const flow::BoundaryCondition& boundary : flowCase.boundaries) {
    if (boundary.kind != flow::BoundaryKind::Inlet) continue;
    EXPECT_NEAR(flowCase.output.mixtureFraction->of(boundary.Y), boundary.name == "fuel" ? 1.0 : 0.0, 1e-14);
  }
  const auto said = [&](const std::string& one, const std::string& two) {
    return test::messageOf<InputError>([&] { (void)readFlowCase(test::flameDeck({one, two})); });
  };
  EXPECT_THAT(
      said("output.mixture_fraction.fuel=feul", air),
      AllOf(HasSubstr("output.mixture_fraction.fuel"), HasSubstr("'feul' is no boundary"), HasSubstr("oxidiser")));
  EXPECT_THAT(said("output.mixture_fraction.fuel=oxidiser", air), HasSubstr("no mixture fraction between them"));
  EXPECT_THAT(said("chemistry.reference_map.fuel=fuel", "chemistry.reference_map.oxidizer=feul"),
              HasSubstr("chemistry.reference_map.oxidizer"));
  const FlowCase mapped = readFlowCase(test::flameDeck(
      {"chemistry.reference_map={fuel: fuel, oxidizer: oxidiser, temperature: 7 K, mixture_fraction: 0.5}"}));
  ASSERT_TRUE(mapped.chemistry.map.has_value());
  const std::vector<double>& Y = mapped.boundaries.front().Y;
  EXPECT_EQ(mapped.chemistry.map->binOf(701.0, 1.0, Y), mapped.chemistry.map->binOf(698.0, 1.0, Y));
  EXPECT_NE(mapped.chemistry.map->binOf(701.0, 1.0, Y), mapped.chemistry.map->binOf(705.0, 1.0, Y));
}

TEST(TurbulenceCase, OfSwirlTellsWhatModelsDoNotKnow) {
  const FlowCase swirls =
      readFlowCase(test::flameDeck({"turbulence={model: wray_agarwal}", "boundaries.fuel.swirl_velocity=1 m/s"}));
  EXPECT_THAT(swirls.notes, Contains(HasSubstr("curvature of its streamlines")));
}

TEST(TurbulenceCase, StartsWithTheEnergyOfItsInlets) {
  const FlowCase given = readFlowCase(channelDeck({atInlet, withLength})),
                 absent = readFlowCase(channelDeck({"turbulence={model: sst}", atInlet, withLength}));
  EXPECT_EQ(given.turbulence.start.energy, 0.1);
  EXPECT_DOUBLE_EQ(absent.turbulence.start.energy, 1.5 * 0.3 * 0.3);
  EXPECT_DOUBLE_EQ(absent.turbulence.boundaries[0].energy, 1.5 * 0.3 * 0.3);
}

TEST(TurbulenceCase, NeedsNoWallsWhereTheirDistanceDoesNotCount) {
  EXPECT_FALSE(readFlowCase(channelDeck({sa})).turbulence.ignoresWalls);
  EXPECT_TRUE(readFlowCase(channelDeck({sa, noWall, "turbulence.wall_distance=infinite"})).turbulence.ignoresWalls);
  for (const char* model : {"wray_agarwal", "k_omega", "k_omega1988", "k_epsilon"})
    EXPECT_NO_THROW(
        (void)readFlowCase(channelDeck({atInlet, withLength, noWall, std::string("turbulence.model=") + model})));
  const std::string lengths = "turbulence={model: k_epsilon, walls: automatic, wall_distance: infinite}";
  EXPECT_TRUE(readFlowCase(channelDeck({lengths, atInlet, withLength, noWall})).turbulence.ignoresWalls);
  for (const char* without :
       {"{model: k_epsilon, wall_distance: infinite}", "{model: sst, walls: automatic, wall_distance: infinite}"})
    EXPECT_NO_THROW((void)readFlowCase(channelDeck({atInlet, withLength, std::string("turbulence=") + without})));
  EXPECT_EQ(readFlowCase(channelDeck({sa})).turbulence.options.mostRatio, 1e5);
}

}  // namespace
}  // namespace lampblack::app
