// What flame decks become: streams in SI, configurations, an earlier flame; and what is refused.
#include "app/problems/flame/flame_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "app/shell/problem.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/errors.hpp"
#include "tests/every_module.hpp"
#include "tests/messages.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::app {
namespace {

using ::testing::HasSubstr;

using test::sourceFolder;

const std::string freeFlame = R"(problem: flame1d
mechanism: mechanisms/hydrogen_h2o2_10.yaml
flame: {type: free, length: 3 cm}
inlet: {temperature: 298 K, fuel: "H2: 1", oxidizer: "O2: 1, N2: 3.76", equivalence_ratio: 1}
)";

const std::string counterflow = R"(problem: flame1d
mechanism: mechanisms/hydrogen_h2o2_10.yaml
pressure: 2 atm
flame: {type: counterflow, length: 8 mm}
left: {temperature: 300 K, composition: "H2: 1, N2: 1", velocity: 20 cm/s}
right: {temperature: 400 K, mass_fractions: "O2: 0.233, N2: 0.767", mass_flux: 0.5 kg/m^2/s}
)";

const std::string potential = R"(problem: flame1d
mechanism: mechanisms/hydrogen_h2o2_10.yaml
flame: {type: counterflow, nozzles: potential, strain_rate: 100 1/s, length: 2 cm}
left: {temperature: 300 K, composition: "H2: 1, N2: 1"}
right: {temperature: 300 K, composition: "O2: 1, N2: 4"}
)";

const std::string burner = R"(problem: flame1d
mechanism: mechanisms/hydrogen_h2o2_10.yaml
flame: {type: burner, energy: given}
inlet: {temperature: 300 K, composition: "H2: 1, O2: 1, AR: 7", velocity: 50 cm/s}
temperature_profile: {position: [0 mm, 2 mm], temperature: [300 K, 1500 K]}
)";

const std::string wall = R"(problem: flame1d
mechanism: mechanisms/hydrogen_h2o2_10.yaml
flame: {type: wall, length: 1 cm, wall_temperature: 500 K}
inlet: {temperature: 300 K, composition: "H2: 1, O2: 1, AR: 7", velocity: 50 cm/s}
)";

FlameCase read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return readFlameCase(Deck::parse(text, sourceFolder / "cases/deck.yaml", overrides, flameSchema()));
}

std::string messageOf(const std::string& text, const std::vector<std::string>& overrides) {
  return test::messageOf<InputError>([&] { static_cast<void>(read(text, overrides)); });
}

TEST(FlameCase, AStreamsMassFluxFollowsFromItsVelocity) {
  const FlameCase flame = read(counterflow);
  const FlameProblem& p = flame.problem;
  EXPECT_EQ(p.type, FlameType::Counterflow);
  EXPECT_EQ(p.nozzles, FlameNozzles::Plug);
  EXPECT_EQ(p.pressure, 2 * 101325.0);
  EXPECT_DOUBLE_EQ(p.left.massFlux, 0.2 * Thermo(*flame.mechanism).density(300, p.pressure, p.left.Y));
  ASSERT_TRUE(p.right);
  EXPECT_EQ(p.right->massFlux, 0.5);
  EXPECT_EQ(p.right->temperature, 400);
  EXPECT_NEAR(p.right->Y[flame.mechanism->speciesIndex("O2")], 0.233, 1e-15);
  EXPECT_FALSE(p.given);
}

TEST(FlameCase, EveryTypeIsRead) {
  const FlameCase premixed = read(freeFlame);
  EXPECT_EQ(premixed.problem.type, FlameType::Free);
  EXPECT_EQ(premixed.problem.left.massFlux, 0) << "the speed is guessed from the gas, not from the deck";
  EXPECT_FALSE(premixed.problem.right);

  const FlameProblem afar = read(potential).problem;
  EXPECT_EQ(afar.nozzles, FlameNozzles::Potential);
  EXPECT_EQ(afar.strainRate, 100);
  EXPECT_DOUBLE_EQ(afar.stagnationPlane, 0.01);

  const FlameProblem measured = read(burner).problem;
  ASSERT_TRUE(measured.given);
  EXPECT_EQ(measured.given->z, (std::vector<double>{0, 0.002}));
  EXPECT_EQ(measured.given->T, (std::vector<double>{300, 1500}));

  EXPECT_EQ(read(wall).problem.wallTemperature, 500);
}

TEST(FlameCase, PhysicsAndSolverComeFromTheDeck) {
  const FlameCase flame =
      read(freeFlame, {"transport.model=multicomponent", "transport.soret=true", "radiation.model=optically_thin",
                       "radiation.surroundings=350 K", "grid.slope=0.1", "grid.curve=0.2", "grid.ratio=2",
                       "grid.prune=0.05", "grid.initial_points=20", "solver.anchor_temperature=500 K"});
  EXPECT_EQ(flame.problem.transport.diffusion, TransportModel::Diffusion::Multicomponent);
  EXPECT_TRUE(flame.problem.transport.soret);
  EXPECT_TRUE(flame.problem.radiation.on);
  EXPECT_EQ(flame.problem.radiation.surroundings, 350);
  EXPECT_EQ(flame.solver.grid.slope, 0.1);
  EXPECT_EQ(flame.solver.grid.curve, 0.2);
  EXPECT_EQ(flame.solver.grid.ratio, 2);
  EXPECT_EQ(flame.solver.grid.prune, 0.05);
  EXPECT_EQ(flame.start.points, 20U);
  EXPECT_EQ(flame.solver.anchorTemperature, 500);
  const FlameCase lewis = read(freeFlame, {"transport.model=constant_lewis", "transport.lewis_numbers=\"H2: 0.3\""});
  EXPECT_EQ(lewis.problem.transport.lewisNumbers[lewis.mechanism->speciesIndex("H2")], 0.3);
  EXPECT_EQ(lewis.problem.transport.lewisNumbers[lewis.mechanism->speciesIndex("O2")], 1.0);
}

TEST(FlameCase, BranchesAndTimeComeFromTheDeck) {
  const FlameCase branch = read(counterflow, {"continuation.towards=lower", "continuation.lowest_load=0.1",
                                              "continuation.lowest_temperature=900 K", "grid.slope=0.2"});
  ASSERT_TRUE(branch.continuation);
  EXPECT_FALSE(branch.unsteady);
  EXPECT_FALSE(branch.continuation->continuation.towardsHigherLoad);
  EXPECT_EQ(branch.continuation->lowestLoad, 0.1);
  EXPECT_EQ(branch.continuation->lowestPeakTemperature, 900);
  EXPECT_EQ(branch.continuation->maximumTurningPoints, 1U);
  EXPECT_EQ(branch.continuation->grid.slope, 0.2);
  const FlameCase course =
      read(counterflow, {"unsteady.end=10 ms", "unsteady.amplitude=0.3", "unsteady.frequency=200 1/s"});
  ASSERT_TRUE(course.unsteady);
  EXPECT_EQ(course.unsteady->options.end, 0.01);
  EXPECT_EQ(course.unsteady->amplitude, 0.3);
  EXPECT_EQ(course.unsteady->frequency, 200);
  EXPECT_FALSE(course.unsteady->fromInitial);
}

TEST(FlameCase, WhatDoesNotFitIsRefused) {
  struct Mistake {
    std::string deck;
    std::vector<std::string> settings;
    std::string message;
  };
  const std::string stream = R"({temperature: 300 K, composition: "O2: 1"})";
  const std::vector<Mistake> mistakes{
      {freeFlame,
       {"flame.type=counterflow"},
       "inlet: 'flame.type: counterflow' does not have this; leave it out, or choose: free"},
      {freeFlame,
       {"left=" + stream},
       "left: 'flame.type: free' does not have this; leave it out, or choose: counterflow"},
      {freeFlame, {"flame.nozzles=potential"}, "flame.nozzles: 'flame.type: free' does not have this"},
      {freeFlame,
       {"flame.energy=given"},
       "flame.energy: 'flame.type: free' does not have this; leave it out, or choose: burner"},
      {freeFlame, {"inlet.velocity=1", "inlet.mass_flux=1"}, "expected 'velocity' or 'mass_flux', found both"},
      {freeFlame, {"inlet.composition=\"H2: 1\""}, "inlet: the mixture is given twice"},
      {freeFlame,
       {"transport.model=unity_lewis", "transport.soret=true"},
       "the transport model unity_lewis has no thermal diffusion"},
      {freeFlame,
       {"transport.lewis_numbers=\"H2: 0.3\""},
       "transport.lewis_numbers: 'transport.model: mixture_averaged' does not have this"},
      {freeFlame, {"solver.anchor_temperature=290 K"}, "expected more than the unburnt 298 K, found 290 K"},
      {freeFlame, {"grid.prune=0.06"}, "grid.prune: expected less than 'slope' and 'curve'"},
      {freeFlame, {"grid.maximum_points=30"}, "grid.initial_points: expected no more than 'maximum_points'"},
      {freeFlame, {"initial=missing.h5"}, "initial: "},
      {freeFlame, {"inlet={temperature: 298 K, composition: 'O2: 1, N2: 3.76'}"}, "inlet: the stream has no fuel"},
      {freeFlame, {"inlet={temperature: 298 K, composition: 'H2: 1, N2: 1'}"}, "the stream has no oxidiser"},
      {freeFlame, {"inlet.equivalence_ratio=0.01"}, "burns to only"},
      {freeFlame, {"inlet.velocity=400 m/s"}, "inlet.velocity: 400 m/s is Mach"},
      {counterflow, {"right.mass_flux=1000 kg/m^2/s"}, "right.mass_flux: "},
      {wall, {"inlet.velocity=200 m/s"}, "inlet.velocity: 200 m/s is Mach"},
      {potential, {"flame.strain_rate=1e5 1/s"}, "flame.strain_rate: 2000 m/s is Mach"},
      {freeFlame, {"solver.step_tolerance=1e300"}, "solver.step_tolerance: expected"},
      {freeFlame, {"solver.relative_tolerance=0.5"}, "solver.relative_tolerance: expected"},
      {freeFlame, {"solver.species_tolerance=1"}, "solver.species_tolerance: expected"},
      {freeFlame, {"solver.temperature_tolerance=1e9 K"}, "solver.temperature_tolerance: expected"},
      {counterflow, {"unsteady.end=1 s", "unsteady.accuracy=1e9"}, "unsteady.accuracy: expected"},
      {freeFlame, {"initial=mechanisms/hydrogen_h2o2_10.yaml"}, "cannot be read as HDF5"},
      {freeFlame, {"continuation={turning_points: 1}"}, "continuation: 'flame.type: free' does not have this"},
      {freeFlame, {"unsteady.end=1 ms"}, "unsteady: 'flame.type: free' does not have this"},
      {counterflow, {"continuation.highest_load=0.5"}, "expected 'lowest_load' below 1 and 'highest_load' above 1"},
      {counterflow, {"continuation.first_step=1e5"}, "expected no more than 'largest_step'"},
      {counterflow,
       {"continuation.towards=lower", "unsteady.end=1 s"},
       "a flame is followed either in time (unsteady) or along a branch"},
      {counterflow, {"unsteady.end=1 s", "unsteady.output_interval=1e-15 s"}, "about 1e+15 profiles would be written"},
      {counterflow, {"unsteady.end=1 s", "unsteady.start=initial"}, "'initial' needs the key 'initial'"},
      {counterflow, {"unsteady.end=1 s", "unsteady.amplitude=0.1"}, "'amplitude' and 'frequency' belong together"},
      {counterflow, {"unsteady.end=1 s", "unsteady.first_step=2 s"}, "expected no more than 'end' and 'largest_step'"},
      {counterflow,
       {"flame.strain_rate=100 1/s"},
       "flame.strain_rate: 'flame.nozzles: plug' does not have this; leave it out, or choose: potential"},
      {potential, {"left.velocity=1 m/s"}, "left.velocity: 'flame.nozzles: potential' does not have this"},
      {potential, {"flame.stagnation_plane=2 cm"}, "expected a place between the streams, below 0.02 m, found 0.02 m"},
      {potential, {"flame.nozzles=plug"}, "flame.strain_rate: 'flame.nozzles: plug' does not have this"},
      {burner,
       {"flame.energy=solved"},
       "temperature_profile: 'flame.energy: solved' does not have this; leave it out, or choose: given"},
      {burner, {"temperature_profile.position=[2 mm, 0 mm]"}, "the points of a temperature profile have to rise"},
      {burner, {"inlet.temperature=310 K"}, "temperature_profile: the profile is 300 K at the burner, the inlet 310 K"},
      {burner, {"temperature_profile.file=t.csv"}, "expected either 'position' and 'temperature' or 'file'"},
  };
  for (const auto& [deck, settings, message] : mistakes) EXPECT_THAT(messageOf(deck, settings), HasSubstr(message));

  const auto without = [](std::string text, const std::string& part) {
    const auto at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    return text.erase(at, part.size());
  };
  EXPECT_THAT(messageOf(without(counterflow, ", velocity: 20 cm/s"), {}),
              HasSubstr("left: this stream needs either 'velocity' or 'mass_flux'"));
  EXPECT_THAT(messageOf(without(potential, ", strain_rate: 100 1/s"), {}),
              HasSubstr("flame: potential flow needs the key 'strain_rate'"));
  EXPECT_THAT(messageOf(without(wall, ", wall_temperature: 500 K"), {}),
              HasSubstr("a flame against a wall needs the key 'wall_temperature'"));
  EXPECT_THAT(messageOf(counterflow.substr(0, counterflow.find("right:")), {}),
              HasSubstr("a counterflow flame needs the section 'right'"));
  EXPECT_THAT(messageOf(burner.substr(0, burner.find("temperature_profile:")), {}),
              HasSubstr("flame.energy: 'given' needs the section 'temperature_profile'"));
}

// Air against air and the like are problems of flow and mixing; only a free flame has to burn.
TEST(FlameCase, StreamsThatCannotBurnAreProblemsToo) {
  const std::string air = "={temperature: 300 K, composition: 'O2: 1, N2: 3.76', velocity: 1 m/s}";
  EXPECT_NO_THROW(static_cast<void>(read(counterflow, {"left" + air, "right" + air})));
  EXPECT_NO_THROW(static_cast<void>(read(wall, {"inlet" + air})));
  EXPECT_NO_THROW(static_cast<void>(read(burner, {"inlet" + air})));
}

}  // namespace
}  // namespace lampblack::app
