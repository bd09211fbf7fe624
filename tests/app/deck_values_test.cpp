// Every number of a deck arrives where it belongs, in SI: decks whose values are all different and none the default.
#include <string>
#include <vector>

#include "app/problems/flame/flame_case.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"
#include "particles/ensemble/soot_ensemble.hpp"
#include "tests/app/app_fixture.hpp"
#include "tests/app/kind_of.hpp"
#include "tests/scratch.hpp"

namespace lampblack::app {
namespace {

using testing::ElementsAre;

const std::filesystem::path folder = test::sourceFolder / "cases/deck.yaml";
const std::string hydrogenMechanism = "mechanism: mechanisms/hydrogen_h2o2_10.yaml\n";

TEST(DeckValues, OfAFlow) {
  const FlowCase flow = readFlowCase(test::flameDeck(
      {"pressure=2 atm", "seed=7", "boundaries.fuel.species=fixed", "boundaries.fuel.temperature=310 K",
       "boundaries.fuel_flange.slip=true", "boundaries.oxidiser_flange.temperature=350 K",
       "boundaries.outflow={type: outlet, side: r-max, temperature: 320 K, composition: \"O2: 1\"}",
       "initial={low: fuel, high: oxidiser, position: 3 mm, width: 1 mm, layer: hot, temperature: 1900 K, "
       "hot_position: 4 mm, hot_width: 0.5 mm}",
       "time={end: 3 us, first_step: 0.2 us, maximum_step: 0.4 us, courant: 0.3, growth: 1.5}",
       "output={interval: 2 us, history_steps: 3, species: [OH, C2H2]}",
       "chemistry={share_work: false, relative_tolerance: 1e-5, absolute_tolerance: 1e-11}",
       "particles={description: two_equation_dimer, pah: [A2], density: 1700 kg/m^3, alpha: 0.4, oh_efficiency: 0.1, "
       "van_der_waals: 1.5}",
       "trajectories={duration: 2 ms, time_step: 20 us, particles: 128, bins: 30, smallest: 1 nm, "
       "largest: 100 nm, start: [{r: 1 mm, z: 4 mm}]}"}));
  EXPECT_DOUBLE_EQ(flow.pressure, 202650);
  EXPECT_EQ(flow.seed, 7U);
  const auto& b = flow.boundaries;
  EXPECT_TRUE(b[0].fixedComposition);
  EXPECT_FALSE(b[1].fixedComposition);
  EXPECT_EQ(b[0].temperature, 310);
  EXPECT_TRUE(b[2].slip);
  EXPECT_FALSE(b[2].takesParticles);
  EXPECT_FALSE(b[2].isothermal);
  EXPECT_FALSE(b[3].slip);
  EXPECT_TRUE(b[3].takesParticles);
  EXPECT_TRUE(b[3].isothermal);
  EXPECT_EQ(b[3].temperature, 350);
  EXPECT_EQ(b[5].temperature, 320);
  EXPECT_EQ(b[5].Y[flow.mechanism->speciesIndex("O2")], 1);
  EXPECT_DOUBLE_EQ(flow.mesh.patches[2].from, 0.01);
  const MixingLayer& layer = flow.initial;
  EXPECT_EQ(layer.low.temperature, 310);
  EXPECT_EQ(layer.high.temperature, 298);
  EXPECT_FALSE(layer.burnt);
  EXPECT_DOUBLE_EQ(layer.position, 3e-3);
  EXPECT_DOUBLE_EQ(layer.width, 1e-3);
  EXPECT_EQ(layer.temperature, 1900);
  EXPECT_DOUBLE_EQ(layer.hotPosition, 4e-3);
  EXPECT_DOUBLE_EQ(layer.hotWidth, 0.5e-3);
  EXPECT_DOUBLE_EQ(flow.time.end, 3e-6);
  EXPECT_DOUBLE_EQ(flow.time.firstStep, 0.2e-6);
  EXPECT_DOUBLE_EQ(flow.time.maximumStep, 0.4e-6);
  EXPECT_EQ(flow.flow.courant, 0.3);
  EXPECT_EQ(flow.time.growth, 1.5);
  EXPECT_DOUBLE_EQ(flow.output.interval, 2e-6);
  EXPECT_EQ(flow.output.historySteps, 3);
  EXPECT_THAT(flow.output.species,
              ElementsAre(flow.mechanism->speciesIndex("OH"), flow.mechanism->speciesIndex("C2H2")));
  EXPECT_FALSE(flow.chemistry.shareWork);
  EXPECT_EQ(flow.chemistry.reactor.relativeTolerance, 1e-5);
  EXPECT_EQ(flow.chemistry.reactor.absoluteTolerance, 1e-11);
  const TrajectoryRequest& paths = *flow.trajectories;
  const auto traveller = paths.make(0);
  const EnsembleOptions& travelling = dynamic_cast<const SootEnsemble&>(*traveller).ensemble().options();
  for (const SootModelOptions* soot : {&test::dimerOptions(flow), &travelling.soot}) {
    EXPECT_EQ(soot->sootDensity, 1700);
    EXPECT_EQ(soot->alpha, 0.4);
    EXPECT_EQ(soot->ohEfficiency, 0.1);
    EXPECT_EQ(soot->vanDerWaals, 1.5);
  }
  EXPECT_DOUBLE_EQ(paths.duration, 2e-3);
  EXPECT_DOUBLE_EQ(paths.timeStep, 20e-6);
  EXPECT_EQ(travelling.particles, 128U);
  EXPECT_EQ(travelling.seed, flow.seed);
  EXPECT_EQ(paths.bins.count, 30U);
  EXPECT_DOUBLE_EQ(paths.bins.logMin, -9.0);
  EXPECT_DOUBLE_EQ(paths.bins.logMax, -7.0);
}

TEST(DeckValues, OverPlaceAndTime) {
  const test::ScratchFolder scratch;
  const std::string table = scratch.file("inlet.csv", "t [ms],temperature [degC],X_O2\n0,26.85,0.25\n2,126.85,0.35\n");
  const FlowCase flow = readFlowCase(test::flameDeck(
      {"boundaries.fuel={type: inlet, side: z-min, to: 10 mm, composition: 'C2H4: 1', temperature: 310 K, "
       "formula: {velocity: 0.3*(1 - (r/0.01)^2), tangential_velocity: 0.1*z + t}}",
       "boundaries.oxidiser={type: inlet, side: z-max, to: 10 mm, composition: 'O2: 0.2, N2: 0.8', velocity: 0.2, "
       "table: " +
           table + "}",
       "boundaries.fuel_flange={type: wall, side: z-min, from: 10 mm, heat_flux: 3 kW/m^2}",
       "boundaries.oxidiser_flange={type: wall, side: z-max, from: 10 mm, formula: {heat_flux: 5*t, swirl_velocity: "
       "6*r}}",
       "initial.formula={temperature: 300 + 1e5*r, velocity_z: 2*z, swirl_velocity: 7*r, X_N2: 0.5}"}));
  const auto& b = flow.boundaries;
  const std::size_t O2 = flow.mechanism->speciesIndex("O2"), N2 = flow.mechanism->speciesIndex("N2");
  ASSERT_TRUE(b[0].varies.speed && b[0].varies.tangential);
  EXPECT_FALSE(b[0].varies.gas.temperature);
  EXPECT_DOUBLE_EQ(b[0].varies.speed({5e-3, 0.0}, 0.0), 0.225);
  EXPECT_DOUBLE_EQ(b[0].varies.tangential({0.0, 2.0}, 3.0), 3.2);
  EXPECT_DOUBLE_EQ(b[0].speed, 0.225) << "in its middle";
  EXPECT_EQ(b[0].temperature, 310.0);
  EXPECT_DOUBLE_EQ(b[1].varies.gas.temperature({1.0, 1.0}, 1e-3), 350.0);
  EXPECT_DOUBLE_EQ(b[1].temperature, 300.0);
  double T = 0.0;
  std::vector<double> Y = b[1].Y, X(Y.size());
  b[1].varies.gas.apply({0.0, 0.0}, 5e-4, Thermo(*flow.mechanism), T, Y);
  Thermo(*flow.mechanism).massToMole(Y, X);
  EXPECT_DOUBLE_EQ(T, 325.0);
  EXPECT_NEAR(X[O2], 0.275, 1e-14);
  EXPECT_NEAR(X[N2], 0.725, 1e-14);
  EXPECT_EQ(b[2].heatFlux, 3000.0);
  EXPECT_FALSE(b[2].isothermal);
  EXPECT_DOUBLE_EQ(b[3].varies.heatFlux({0.0, 0.0}, 3.0), 15.0);
  EXPECT_DOUBLE_EQ(b[3].varies.swirl({2.0, 0.0}, 3.0), 12.0);
  EXPECT_TRUE(flow.swirls);
  const InitialFields& start = flow.initialFields;
  EXPECT_DOUBLE_EQ(start.gas.temperature({1e-3, 0.0}, 0.0), 400.0);
  EXPECT_FALSE(start.velocity[0]);
  EXPECT_DOUBLE_EQ(start.velocity[1]({0.0, 3.0}, 0.0), 6.0);
  EXPECT_DOUBLE_EQ(start.swirl({2.0, 0.0}, 0.0), 14.0);
  ASSERT_EQ(start.gas.moleFractions.size(), 1U);
  EXPECT_EQ(start.gas.moleFractions[0].first, N2);
}

TEST(DeckValues, SwirlsWhereAStreamOrAWallDoes) {
  EXPECT_FALSE(readFlowCase(test::flameDeck()).swirls);
  const FlowCase flow = readFlowCase(test::flameDeck({"boundaries.fuel.swirl_velocity=10 cm/s"}));
  EXPECT_TRUE(flow.swirls);
  EXPECT_DOUBLE_EQ(flow.boundaries[0].swirl, 0.1);
}

TEST(DeckValues, HaveNoSwirlWithoutAnAxis) {
  const Deck deck = Deck::load(test::sourcePath("cases/flow/heated_cavity/deck.yaml"),
                               {"boundaries.warm.swirl_velocity=1 m/s"}, flowSchema());
  EXPECT_THAT([&] { (void)readFlowCase(deck); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("there is no axis to swirl about")));
}

TEST(DeckValues, AStreamOfGivenMoleFractionsNeedsNoComposition) {
  const FlowCase flow = readFlowCase(
      test::flameDeck({"boundaries.fuel={type: inlet, side: z-min, to: 10 mm, velocity: 0.2, temperature: 310 K, "
                       "formula: {X_C2H4: r/0.01, X_N2: 1 - r/0.01}}"}));
  const BoundaryCondition& fuel = flow.boundaries[0];
  std::vector<double> X(fuel.Y.size());
  Thermo(*flow.mechanism).massToMole(fuel.Y, X);
  EXPECT_NEAR(X[flow.mechanism->speciesIndex("C2H4")], 0.5, 1e-12) << "in its middle";
  EXPECT_NEAR(X[flow.mechanism->speciesIndex("N2")], 0.5, 1e-12);
}

TEST(DeckValues, AFlameLaidOverTheMesh) {
  const test::ScratchFolder scratch;
  const std::string profile =
      scratch.file("profile.csv",
                   "z [m],temperature [K],velocity [m/s],spread [1/s],heat_release [W/m^3],X_O2 [1],X_N2 [1]\n"
                   "0,300,0.2,10,7,0.2,0.8\n0.004,700,0.4,20,7,0.4,0.6\n");
  const FlowCase flow =
      readFlowCase(test::flameDeck({"initial={layer: none, flame1d: {file: " + profile + ", axis: z, origin: 1 mm}}"}));
  const InitialFields& start = flow.initialFields;
  EXPECT_DOUBLE_EQ(start.gas.temperature({9.0, 3e-3}, 0.0), 500.0);
  EXPECT_DOUBLE_EQ(start.velocity[1]({9.0, 2e-3}, 0.0), 0.25);
  EXPECT_DOUBLE_EQ(start.velocity[0]({2e-3, 3e-3}, 0.0), 15.0 * 2e-3);
  EXPECT_EQ(start.gas.moleFractions.size(), 2U);
}

ReactorCase reactor(const std::string& text) {
  return readReactorCase(Deck::parse("problem: reactor\n" + hydrogenMechanism + text, folder, {}, reactorSchema()));
}

TEST(DeckValues, OfAPlugFlow) {
  const ReactorCase duct = reactor(R"(pressure: 3 atm
reactor: {type: plug_flow, length: 30 cm, area: 2 cm^2, energy: isothermal, temperature: 950 K}
inlet: {temperature: 900 K, composition: "H2: 1, O2: 1", mass_flow: 4 g/s}
output: {spacing: 1 cm, species: [H], fractions: mass}
integrator: {relative_tolerance: 1e-7, absolute_tolerance: 1e-14, maximum_steps: 77}
)");
  EXPECT_DOUBLE_EQ(kindOf<PlugFlowKind>(duct).massFlux, 4e-3 / 2e-4);
  EXPECT_DOUBLE_EQ(kindOf<PlugFlowKind>(duct).length, 0.3);
  EXPECT_DOUBLE_EQ(kindOf<PlugFlowKind>(duct).inlet.pressure, 3 * 101325.0);
  EXPECT_EQ(kindOf<PlugFlowKind>(duct).inlet.temperature, 900);
  EXPECT_EQ(duct.profile.value().value(0.1), 950);
  EXPECT_DOUBLE_EQ(duct.output.interval.value(), 0.01);
  EXPECT_TRUE(duct.output.massFractions);
  EXPECT_EQ(duct.integrator.relativeTolerance, 1e-7);
  EXPECT_EQ(duct.integrator.absoluteTolerance, 1e-14);
  EXPECT_EQ(duct.integrator.maximumSteps, 77);
  const ReactorCase fast = reactor(R"(reactor: {type: plug_flow, length: 1 m}
inlet: {temperature: 900 K, composition: "H2: 1, O2: 1", velocity: 5 m/s}
)");
  EXPECT_DOUBLE_EQ(kindOf<PlugFlowKind>(fast).massFlux,
                   5 * Thermo(*fast.mechanism).density(900, 101325, kindOf<PlugFlowKind>(fast).inlet.Y));
}

TEST(DeckValues, OfAClosedReactor) {
  const ReactorCase closed = reactor(R"(reactor: {type: constant_volume}
initial: {temperature: 1100 K, mass_fractions: "H2: 1, O2: 3"}
time: {end: 2 ms, maximum_step: 5 us}
output: {interval: 10 us}
ignition: {temperature_rate: false, species: [H2O2], temperature_rise: 250 K}
)");
  EXPECT_EQ(kindOf<ClosedKind>(closed).held, ReactorSystem::Held::Density);
  EXPECT_EQ(kindOf<ClosedKind>(closed).initial.temperature, 1100);
  EXPECT_DOUBLE_EQ(kindOf<ClosedKind>(closed).initial.Y[closed.mechanism->speciesIndex("O2")], 0.75);
  EXPECT_DOUBLE_EQ(closed.kind->end(), 2e-3);
  EXPECT_DOUBLE_EQ(closed.integrator.maximumStep, 5e-6);
  EXPECT_DOUBLE_EQ(closed.output.interval.value(), 10e-6);
  EXPECT_FALSE(closed.profile);
  ASSERT_EQ(kindOf<ClosedKind>(closed).ignition.size(), 3U);
  EXPECT_EQ(kindOf<ClosedKind>(closed).ignition[0].kind, IgnitionCriterion::Kind::MoleFraction);
  EXPECT_EQ(kindOf<ClosedKind>(closed).ignition[1].kind, IgnitionCriterion::Kind::MassFraction);
  EXPECT_EQ(kindOf<ClosedKind>(closed).ignition[2].rise, 250);
}

TEST(DeckValues, OfStirredReactors) {
  const ReactorCase stirred = reactor(R"(pressure: 0.5 atm
reactor: {type: stirred, volume: 70 cm^3, heat_loss: {conductance: 0.2 W/K, surroundings: 350 K}}
inlet: {temperature: 400 K, composition: "H2: 1, O2: 1", mass_flow: 3 g/s}
initial: {temperature: 1500 K, composition: "H2O: 1"}
time: {end: 10 ms}
)");
  const StirredReactor& vessel = kindOf<StirredKind>(stirred).vessels.reactors.at(0);
  EXPECT_DOUBLE_EQ(vessel.volume.value(), 70e-6);
  EXPECT_FALSE(vessel.residenceTime);
  EXPECT_FALSE(vessel.temperature);
  EXPECT_DOUBLE_EQ(vessel.conductance, 0.2);
  EXPECT_EQ(vessel.surroundings, 350);
  EXPECT_DOUBLE_EQ(kindOf<StirredKind>(stirred).vessels.inflows.at(0).massFlow, 3e-3);
  EXPECT_EQ(kindOf<StirredKind>(stirred).vessels.inflows.at(0).temperature, 400);
  EXPECT_EQ(kindOf<StirredKind>(stirred).start.given.value().temperature, 1500);
  EXPECT_DOUBLE_EQ(kindOf<StirredKind>(stirred).start.given.value().pressure, 0.5 * 101325);
  EXPECT_DOUBLE_EQ(stirred.kind->end(), 0.01);

  const ReactorCase network = reactor(R"(reactor: {type: network, start: fresh}
network:
  reactors:
    one: {volume: 1 cm^3}
    two: {residence_time: 2 ms, temperature: 1300 K}
  inlets:
    a: {to: one, mass_flow: 1 g/s, temperature: 300 K, composition: "H2: 1"}
    b: {to: two, mass_flow: 2 g/s, temperature: 500 K, composition: "O2: 1"}
  connections:
    - {from: one, to: two, fraction: 0.25}
)");
  EXPECT_FALSE(kindOf<StirredKind>(network).start.burnt);
  EXPECT_FALSE(kindOf<StirredKind>(network).vessels.reactors.at(0).temperature);
  EXPECT_EQ(kindOf<StirredKind>(network).vessels.reactors.at(1).temperature, 1300);
  EXPECT_DOUBLE_EQ(kindOf<StirredKind>(network).vessels.reactors.at(1).residenceTime.value(), 2e-3);
  EXPECT_EQ(kindOf<StirredKind>(network).vessels.inflows.at(1).to, 1U);
  EXPECT_EQ(kindOf<StirredKind>(network).vessels.inflows.at(1).temperature, 500);
  ASSERT_EQ(kindOf<StirredKind>(network).vessels.streams.size(), 1U);
  EXPECT_EQ(kindOf<StirredKind>(network).vessels.streams[0].from, 0U);
  EXPECT_EQ(kindOf<StirredKind>(network).vessels.streams[0].to, 1U);
  EXPECT_NEAR(kindOf<StirredKind>(network).vessels.streams[0].massFlow, 0.25e-3, 1e-18);
}

TEST(DeckValues, OfAFlamesSolver) {
  const FlameCase flame = readFlameCase(Deck::parse("problem: flame1d\n" + hydrogenMechanism + R"(
flame: {type: counterflow, nozzles: potential, strain_rate: 150 1/s, stagnation_plane: 4 mm, length: 11 mm}
left: {temperature: 310 K, composition: "H2: 1, N2: 1"}
right: {temperature: 420 K, composition: "O2: 1, N2: 4"}
grid: {maximum_points: 900, initial_points: 33, refine: false}
solver: {relative_tolerance: 2e-4, species_tolerance: 3e-9, temperature_tolerance: 0.04 K, step_tolerance: 0.5,
         maximum_steps: 41, jacobian_age: 6, first_time_step: 7 us, maximum_time_steps: 800}
continuation: {first_step: 20, largest_step: 300, highest_load: 9, turning_points: 2, maximum_points: 55,
               points_between_grids: 4}
)",
                                                    folder, {}, flameSchema()));
  const FlameProblem& problem = flame.problem;
  EXPECT_DOUBLE_EQ(problem.length, 0.011);
  EXPECT_EQ(problem.strainRate, 150);
  EXPECT_DOUBLE_EQ(problem.stagnationPlane, 0.004);
  EXPECT_EQ(problem.left.temperature, 310);
  EXPECT_EQ(problem.right->temperature, 420);
  const FlameSolverOptions& solver = flame.solver;
  EXPECT_EQ(solver.grid.maximumPoints, 900U);
  EXPECT_EQ(flame.start.points, 33U);
  EXPECT_FALSE(solver.refine);
  EXPECT_EQ(solver.tolerances.relative, 2e-4);
  EXPECT_EQ(solver.tolerances.species, 3e-9);
  EXPECT_EQ(solver.tolerances.temperature, 0.04);
  EXPECT_EQ(solver.newton.stepTolerance, 0.5);
  EXPECT_EQ(solver.newton.maximumSteps, 41U);
  EXPECT_EQ(solver.newton.jacobianAge, 6U);
  EXPECT_DOUBLE_EQ(solver.transient.firstStep, 7e-6);
  EXPECT_EQ(solver.transient.maximumSteps, 800U);
  const FlameContinuationOptions& branch = *flame.continuation;
  EXPECT_TRUE(branch.continuation.towardsHigherLoad);
  EXPECT_EQ(branch.continuation.firstStep, 20);
  EXPECT_EQ(branch.continuation.largestStep, 300);
  EXPECT_EQ(branch.highestLoad, 9);
  EXPECT_EQ(branch.maximumTurningPoints, 2U);
  EXPECT_EQ(branch.maximumPoints, 55U);
  EXPECT_EQ(branch.pointsBetweenGrids, 4U);
}

}  // namespace
}  // namespace lampblack::app
