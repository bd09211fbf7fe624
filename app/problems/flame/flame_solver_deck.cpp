#include "app/problems/flame/flame_solver_deck.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/deck/temperature_input.hpp"
#include "io/deck_keys.hpp"
#include "io/request_limits.hpp"

namespace lampblack::app {
namespace {

DeckKeys<FlameCase> gridKeys() {
  constexpr auto grid = [](auto member) { return inner(inner(&FlameCase::solver, &FlameSolverOptions::grid), member); };
  DeckKeys<FlameCase> keys("grid");
  keys.number("slope", grid(&GridOptions::slope), rules().above(0).atMost(1),
              "Largest change of an unknown between neighbouring points, over the range of its values: smaller "
              "makes a finer grid.");
  keys.number("curve", grid(&GridOptions::curve), rules().above(0).atMost(1),
              "Largest change of an unknown's slope between neighbouring points, over the range of its slopes.");
  keys.number("ratio", grid(&GridOptions::ratio), rules().atLeast(2),
              "Largest ratio of the spacings of neighbouring points.");
  keys.number("prune", grid(&GridOptions::prune), rules().atLeast(0).below(1),
              "A point goes where slope and curve stay below this without it; 0: none goes.");
  keys.integer("maximum_points", grid(&GridOptions::maximumPoints), rules().atLeast(10),
               "Largest number of points; a grid that needs more is a failure.");
  keys.integer("initial_points", inner(&FlameCase::start, &InitialFlameOptions::points),
               rules().atLeast(8).atMost(100000), "Number of points of the first grid.");
  keys.boolean("refine", inner(&FlameCase::solver, &FlameSolverOptions::refine), rules(),
               "true: the grid is refined until slope and curve are met; false: the flame is solved on the "
               "first grid only.");
  return keys;
}

DeckKeys<FlameSolverOptions> solverKeys() {
  using Solver = FlameSolverOptions;
  constexpr auto tolerances = [](auto member) { return inner(&Solver::tolerances, member); };
  constexpr auto newton = [](auto member) { return inner(&Solver::newton, member); };
  constexpr auto transient = [](auto member) { return inner(&Solver::transient, member); };
  DeckKeys<Solver> keys("solver");
  keys.number("relative_tolerance", tolerances(&FlameTolerances::relative), rules().above(0).atMost(0.1),
              "Relative tolerance of all unknowns: a change by this part counts as 1 in the norm of the solver.");
  keys.number("species_tolerance", tolerances(&FlameTolerances::species), rules().above(0).atMost(0.01),
              "Absolute tolerance of mass fractions.");
  keys.quantity("temperature_tolerance", units::temperature, tolerances(&FlameTolerances::temperature),
                rules().above(0).atMost(100), "Absolute tolerance of the temperature.");
  keys.number("step_tolerance", newton(&NewtonOptions::stepTolerance), rules().above(0).atMost(10),
              "The flame has converged once a Newton step is smaller than this, in units of the tolerances.");
  keys.integer("maximum_steps", newton(&NewtonOptions::maximumSteps), rules().atLeast(1),
               "Number of Newton steps after which steps in time are taken instead.");
  keys.integer("jacobian_age", newton(&NewtonOptions::jacobianAge), rules().atLeast(1),
               "Largest number of Newton steps with the same matrix, while they converge fast.");
  keys.quantity("first_time_step", units::time, transient(&PseudoTransientOptions::firstStep),
                rules().above(0).atMost(1),
                "Length of the first pseudo-transient step, taken where Newton's method fails.");
  keys.integer("maximum_time_steps", transient(&PseudoTransientOptions::maximumSteps), rules().atLeast(1),
               "Pseudo-transient steps after which a stage has failed.");
  keys.quantity("anchor_temperature", units::temperature, &Solver::anchorTemperature,
                temperatureRules().optional().onlyWith("flame.type", {"free"}),
                "Temperature that is held in place; between unburnt and burnt if not given.");
  return keys;
}

DeckKeys<FlameContinuationOptions> continuationKeys() {
  using Options = FlameContinuationOptions;
  constexpr auto along = [](auto member) { return inner(&Options::continuation, member); };
  DeckKeys<Options> keys("continuation");
  keys.section(
      Presence::optional,
      "The branch of flames over the strain, followed by arc length from the converged flame round its turning "
      "points (extinction, ignition).",
      {{"flame.type", {"burner", "wall", "counterflow"}}});
  keys.choice("towards", along(&ContinuationOptions::towardsHigherLoad), {{"higher", true}, {"lower", false}}, rules(),
              "Whether the strain rises or falls at the start of the branch.");
  keys.number("lowest_load", &Options::lowestLoad, rules().atLeast(0),
              "The branch ends where the load is below this. The load is a factor on the strain rates and mass "
              "fluxes of the deck.");
  keys.number("highest_load", &Options::highestLoad, rules().optional().above(0),
              "The branch ends where the load (factor on the strain rates and mass fluxes of the deck) is above this.");
  keys.quantity("lowest_temperature", units::temperature, &Options::lowestPeakTemperature,
                temperatureRules().optional(),
                "The branch ends where the largest temperature of the flame is below this.");
  keys.integer("turning_points", &Options::maximumTurningPoints, rules().byDefault("1").atLeast(1),
               "The branch ends after this number of turning points; from a burning flame the first is extinction.");
  keys.integer("maximum_points", &Options::maximumPoints, rules().atLeast(2),
               "The branch ends after this number of flames.");
  keys.number("first_step", along(&ContinuationOptions::firstStep), rules().above(0),
              "Length of the first step along the branch (arc length), in units of the tolerances: 100 is about "
              "one per cent of every unknown.");
  keys.number("largest_step", along(&ContinuationOptions::largestStep), rules().above(0),
              "Length of the largest step along the branch (arc length), in units of the tolerances.");
  keys.integer("points_between_grids", &Options::pointsBetweenGrids, rules().atLeast(0),
               "Flames after which the grid is adapted; 0: never.");
  return keys;
}

DeckKeys<FlameUnsteady> unsteadyKeys() {
  using Unsteady = FlameUnsteady;
  constexpr auto steps = [](auto member) { return inner(&Unsteady::options, member); };
  DeckKeys<Unsteady> keys("unsteady");
  keys.section(Presence::optional, "The flame in time, on the grid it starts with.",
               {{"flame.type", {"burner", "wall", "counterflow"}}});
  keys.choice("start", &Unsteady::fromInitial, {{"steady", false}, {"initial", true}}, rules(),
              "steady: the converged flame of this deck; initial: the flame of the key initial as it is, with the "
              "streams of this deck.");
  keys.quantity("end", units::time, steps(&UnsteadyOptions::end), rules().required().above(0),
                "Time at which the run ends, from zero.");
  keys.quantity("output_interval", units::time, &Unsteady::interval, rules().above(0),
                "Time between profiles; absent: a hundredth of unsteady.end.");
  keys.quantity("first_step", units::time, steps(&UnsteadyOptions::firstStep), rules().above(0), "First time step.");
  keys.quantity("largest_step", units::time, steps(&UnsteadyOptions::largestStep), rules().optional().above(0),
                "Largest time step.");
  keys.number("accuracy", steps(&UnsteadyOptions::accuracy), rules().above(0).atMost(1000),
              "Error of a step in units of the tolerances (10 with a relative tolerance of 1e-4: 0.1 %).");
  keys.number("amplitude", &Unsteady::amplitude, rules().atLeast(0).below(1),
              "Relative amplitude a of a strain that oscillates: that of the deck times 1 + a sin(2 pi f t).");
  keys.quantity("frequency", units::frequency, &Unsteady::frequency, rules().optional().above(0),
                "Frequency f of a strain that oscillates: that of the deck times 1 + a sin(2 pi f t).");
  return keys;
}

void readContinuation(const Deck& deck, FlameCase& flame) {
  if (!deck.has("continuation")) return;
  const FlameContinuationOptions& options = flame.continuation.emplace(continuationKeys().read(deck));
  if (options.continuation.firstStep > options.continuation.largestStep)
    throw deck.error("continuation.first_step", "expected no more than 'largest_step'");
  if (!(options.lowestLoad < 1 && options.highestLoad > 1))
    throw deck.error("continuation",
                     "expected 'lowest_load' below 1 and 'highest_load' above 1: the flame of the deck");
  flame.continuation->grid = flame.solver.grid;
  flame.continuation->tolerances = flame.solver.tolerances;
}

void readUnsteady(const Deck& deck, FlameCase& flame) {
  if (!deck.has("unsteady")) return;
  if (flame.continuation)
    throw deck.error("unsteady",
                     "a flame is followed either in time (unsteady) or along a branch (continuation); leave out one of "
                     "the two sections");
  const FlameUnsteady& unsteady = flame.unsteady.emplace(unsteadyKeys().read(deck));
  if (unsteady.fromInitial && !deck.has("initial"))
    throw deck.error("unsteady.start", "'initial' needs the key 'initial', the results of an earlier flame");
  if (unsteady.interval) {
    // All profiles are kept until the end.
    const double outputs = unsteady.options.end / *unsteady.interval;
    const double bytes = sizeof(double) * static_cast<double>(flame.start.points * flame.mechanism->numSpecies());
    requireOutputs(deck, "unsteady.output_interval", "profiles", outputs, bytes);
    requireMemory(deck, "unsteady.output_interval", fmt::format("{:.3g} profiles", outputs), outputs * bytes);
  }
  if (unsteady.options.firstStep > std::min(unsteady.options.end, unsteady.options.largestStep))
    throw deck.error("unsteady.first_step", "expected no more than 'end' and 'largest_step'");
  if ((unsteady.amplitude > 0) != deck.has("unsteady.frequency"))
    throw deck.error("unsteady", "'amplitude' and 'frequency' belong together: give both or neither");
}

}  // namespace

void addFlameSolverKeys(DeckSchema& schema) {
  schema.add(gridKeys().schema()).add(solverKeys().schema());
  schema.add(
      stringKey("initial",
                "Results of an earlier flame to start from (results.h5, also .part of one that failed), relative to "
                "the deck; also of another mechanism, length or type. Otherwise the start comes from the streams.")
          .optional());
  schema.add(continuationKeys().schema()).add(unsteadyKeys().schema());
}

void readFlameSolver(const Deck& deck, FlameCase& flame) {
  gridKeys().read(deck, flame, "grid");
  const GridOptions& grid = flame.solver.grid;
  if (grid.prune >= std::min(grid.slope, grid.curve))
    throw deck.error(
        "grid.prune",
        "expected less than 'slope' and 'curve': the same points would be taken out and put in again without end");
  if (flame.start.points > grid.maximumPoints)
    throw deck.error("grid.initial_points", "expected no more than 'maximum_points'");
  // The Newton matrix alone has three square blocks a point.
  const auto unknowns = static_cast<double>(flame.mechanism->numSpecies());
  requireMemory(deck, "grid.initial_points", fmt::format("a grid of {} points", flame.start.points),
                3 * sizeof(double) * unknowns * unknowns * static_cast<double>(flame.start.points));
  solverKeys().read(deck, flame.solver, "solver");
  if (const double anchor = flame.solver.anchorTemperature; anchor > 0 && anchor <= flame.problem.left.temperature)
    throw deck.error("solver.anchor_temperature", fmt::format("expected more than the unburnt {:g} K, found {:g} K",
                                                              flame.problem.left.temperature, anchor));
  readContinuation(deck, flame);
  readUnsteady(deck, flame);
}

}  // namespace lampblack::app
