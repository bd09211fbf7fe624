#include <fmt/format.h>

#include "app/deck/gas_input.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/radiation_deck.hpp"
#include "app/deck/sensitivity_deck.hpp"
#include "app/deck/temperature_input.hpp"
#include "app/deck/transport_deck.hpp"
#include "app/problems/flame/flame_case.hpp"

namespace lampblack::app {
namespace {

// The solver's own defaults, as a deck would say them.
const FlameSolverOptions& defaults() {
  static const FlameSolverOptions options;
  return options;
}
std::string text(double value, const char* unit = "") {
  return fmt::format("{}{}", value, unit);
}
std::string text(std::size_t value) {
  return fmt::format("{}", value);
}

void addStream(DeckSchema& schema, const std::string& section, const std::string& doc,
               const std::vector<std::string>& types) {
  schema.section(section, Presence::optional, doc, {{"flame.type", types}})
      .add(temperatureKey(section + ".temperature", "Temperature of the gas."))
      .add(quantityKey(section + ".velocity", units::velocity,
                       "Velocity of the stream into the domain; free flame: a first guess of the flame speed, "
                       "estimated if not given. Not with potential flow.")
               .optional()
               .above(0)
               .onlyWith("flame.nozzles", {"plug"}))
      .add(quantityKey(section + ".mass_flux", units::massFlux,
                       "Mass flux of the stream into the domain, in place of a velocity.")
               .optional()
               .above(0)
               .onlyWith("flame.nozzles", {"plug"}));
  addMixtureKeys(schema, section);
}

void addFlame(DeckSchema& schema) {
  schema
      .add(choiceKey("flame.type", {"free", "burner", "wall", "counterflow"},
                     "free: premixed, propagating freely, its speed is found; burner: premixed, on a burner of given "
                     "mass flux; wall: a stream against a wall; counterflow: two streams against each other."))
      .add(quantityKey("flame.length", units::length,
                       "Length of the domain: from the burner to where nothing changes, from nozzle to wall, or from "
                       "nozzle to nozzle. A free flame may widen it.")
               .byDefault("20 mm")
               .above(0))
      .add(choiceKey("flame.nozzles", {"plug", "potential"},
                     "plug: velocities given, no spreading at the nozzles; potential: the streams come from afar, the "
                     "strain rate is given.")
               .byDefault("plug")
               .onlyWith("flame.type", {"wall", "counterflow"}))
      .add(quantityKey("flame.strain_rate", units::frequency,
                       "Strain rate of the stream on the right (flame against a wall: of the stream).")
               .optional()
               .above(0)
               .onlyWith("flame.type", {"wall", "counterflow"})
               .onlyWith("flame.nozzles", {"potential"}))
      .add(quantityKey("flame.stagnation_plane", units::length,
                       "Position where the streams meet; absent: the middle of the domain.")
               .optional()
               .above(0)
               .onlyWith("flame.type", {"counterflow"})
               .onlyWith("flame.nozzles", {"potential"}))
      .add(temperatureKey("flame.wall_temperature",
                          "Temperature of the wall; absent with flame.energy given: that of the profile there.")
               .optional()
               .onlyWith("flame.type", {"wall"}))
      .add(choiceKey("flame.energy", {"solved", "given"},
                     "solved: the temperature follows from the energy equation; given: it is the measured one of the "
                     "section temperature_profile.")
               .byDefault("solved")
               .onlyWith("flame.type", {"burner", "wall"}));
  addStream(schema, "inlet", "The stream that comes in on the left.", {"free", "burner", "wall"});
  addStream(schema, "left", "The stream from the left, by custom the fuel.", {"counterflow"});
  addStream(schema, "right", "The stream from the right, by custom the oxidiser.", {"counterflow"});
  schema
      .section("temperature_profile", Presence::optional,
               "The given temperature: straight lines between points, constant beyond them. Points here or in a file.",
               {{"flame.energy", {"given"}}})
      .add(
          quantityKey("temperature_profile.position", units::length, "Distances of the points from the burner, rising.")
              .list()
              .optional());
  addTemperatureProfileKeys(schema, "distance in m");
  schema.add(quantityKey("temperature_profile.smoothing", units::length,
                         "Half the distance over which the temperature is averaged, with weights that fall linearly to "
                         "its ends: for measured values whose kinks and steps of rounding the grid would follow. The "
                         "values at both ends of the flame stay. Absent: as it is given.")
                 .optional()
                 .above(0));
}

void addPhysics(DeckSchema& schema) {
  addTransportKeys(schema);
  addRadiationKeys(schema);
}

void addGrid(DeckSchema& schema) {
  schema
      .add(numberKey("grid.slope",
                     "Largest change of an unknown between neighbouring points, over the range of its values: smaller "
                     "makes a finer grid.")
               .byDefault(text(defaults().grid.slope))
               .above(0)
               .atMost(1))
      .add(numberKey("grid.curve",
                     "Largest change of an unknown's slope between neighbouring points, over the range of its slopes.")
               .byDefault(text(defaults().grid.curve))
               .above(0)
               .atMost(1))
      .add(numberKey("grid.ratio", "Largest ratio of the spacings of neighbouring points.")
               .byDefault(text(defaults().grid.ratio))
               .atLeast(2))
      .add(numberKey("grid.prune", "A point goes where slope and curve stay below this without it; 0: none goes.")
               .byDefault(text(defaults().grid.prune))
               .atLeast(0)
               .below(1))
      .add(integerKey("grid.maximum_points", "Largest number of points; a grid that needs more is a failure.")
               .byDefault(text(defaults().grid.maximumPoints))
               .atLeast(10))
      .add(integerKey("grid.initial_points", "Number of points of the first grid.")
               .byDefault(text(InitialFlameOptions{}.points))
               .atLeast(8)
               .atMost(100000))
      .add(booleanKey("grid.refine",
                      "true: the grid is refined until slope and curve are met; false: the flame is solved on the "
                      "first grid only.")
               .byDefault("true"));
}

void addSolver(DeckSchema& schema) {
  schema
      .add(numberKey("solver.relative_tolerance",
                     "Relative tolerance of all unknowns: a change by this part counts as 1 in the norm of the solver.")
               .byDefault(text(defaults().tolerances.relative))
               .above(0)
               .atMost(0.1))
      .add(numberKey("solver.species_tolerance", "Absolute tolerance of mass fractions.")
               .byDefault(text(defaults().tolerances.species))
               .above(0)
               .atMost(0.01))
      .add(quantityKey("solver.temperature_tolerance", units::temperature, "Absolute tolerance of the temperature.")
               .byDefault(text(defaults().tolerances.temperature, " K"))
               .above(0)
               .atMost(100))
      .add(numberKey("solver.step_tolerance",
                     "The flame has converged once a Newton step is smaller than this, in units of the tolerances.")
               .byDefault(text(defaults().newton.stepTolerance))
               .above(0)
               .atMost(10))
      .add(integerKey("solver.maximum_steps", "Number of Newton steps after which steps in time are taken instead.")
               .byDefault(text(defaults().newton.maximumSteps))
               .atLeast(1))
      .add(integerKey("solver.jacobian_age",
                      "Largest number of Newton steps with the same matrix, while they converge fast.")
               .byDefault(text(defaults().newton.jacobianAge))
               .atLeast(1))
      .add(quantityKey("solver.first_time_step", units::time,
                       "Length of the first pseudo-transient step, taken where Newton's method fails.")
               .byDefault(text(defaults().transient.firstStep, " s"))
               .above(0)
               .atMost(1))
      .add(integerKey("solver.maximum_time_steps", "Pseudo-transient steps after which a stage has failed.")
               .byDefault(text(defaults().transient.maximumSteps))
               .atLeast(1))
      .add(temperatureKey("solver.anchor_temperature",
                          "Temperature that is held in place; between unburnt and burnt if not given.")
               .optional()
               .onlyWith("flame.type", {"free"}))
      .add(stringKey(
               "initial",
               "Results of an earlier flame to start from (results.h5, also .part of one that failed), relative to "
               "the deck; also of another mechanism, length or type. Otherwise the start comes from the streams.")
               .optional());
}

void addContinuation(DeckSchema& schema) {
  static const FlameContinuationOptions options;
  schema
      .section(
          "continuation", Presence::optional,
          "The branch of flames over the strain, followed by arc length from the converged flame round its turning "
          "points (extinction, ignition).",
          {{"flame.type", {"burner", "wall", "counterflow"}}})
      .add(choiceKey("continuation.towards", {"higher", "lower"},
                     "Whether the strain rises or falls at the start of the branch.")
               .byDefault("higher"))
      .add(numberKey("continuation.lowest_load",
                     "The branch ends where the load is below this. The load is a factor on the strain rates and mass "
                     "fluxes of the deck.")
               .byDefault("0")
               .atLeast(0))
      .add(numberKey(
               "continuation.highest_load",
               "The branch ends where the load (factor on the strain rates and mass fluxes of the deck) is above this.")
               .optional()
               .above(0))
      .add(temperatureKey("continuation.lowest_temperature",
                          "The branch ends where the largest temperature of the flame is below this.")
               .optional())
      .add(integerKey(
               "continuation.turning_points",
               "The branch ends after this number of turning points; from a burning flame the first is extinction.")
               .byDefault("1")
               .atLeast(1))
      .add(integerKey("continuation.maximum_points", "The branch ends after this number of flames.")
               .byDefault(text(options.maximumPoints))
               .atLeast(2))
      .add(numberKey("continuation.first_step",
                     "Length of the first step along the branch (arc length), in units of the tolerances: 100 is about "
                     "one per cent of every unknown.")
               .byDefault(text(options.continuation.firstStep))
               .above(0))
      .add(numberKey("continuation.largest_step",
                     "Length of the largest step along the branch (arc length), in units of the tolerances.")
               .byDefault(text(options.continuation.largestStep))
               .above(0))
      .add(integerKey("continuation.points_between_grids", "Flames after which the grid is adapted; 0: never.")
               .byDefault(text(options.pointsBetweenGrids))
               .atLeast(0));
}

void addUnsteady(DeckSchema& schema) {
  static const UnsteadyOptions options;
  schema
      .section("unsteady", Presence::optional, "The flame in time, on the grid it starts with.",
               {{"flame.type", {"burner", "wall", "counterflow"}}})
      .add(choiceKey(
               "unsteady.start", {"steady", "initial"},
               "steady: the converged flame of this deck; initial: the flame of the key initial as it is, with the "
               "streams of this deck.")
               .byDefault("steady"))
      .add(quantityKey("unsteady.end", units::time, "Time at which the run ends, from zero.").above(0))
      .add(quantityKey("unsteady.output_interval", units::time,
                       "Time between profiles; absent: a hundredth of unsteady.end.")
               .optional()
               .above(0))
      .add(quantityKey("unsteady.first_step", units::time, "First time step.")
               .byDefault(text(options.firstStep, " s"))
               .above(0))
      .add(quantityKey("unsteady.largest_step", units::time, "Largest time step.").optional().above(0))
      .add(numberKey("unsteady.accuracy",
                     "Error of a step in units of the tolerances (10 with a relative tolerance of 1e-4: 0.1 %).")
               .byDefault(text(options.accuracy))
               .above(0)
               .atMost(1000))
      .add(numberKey("unsteady.amplitude",
                     "Relative amplitude a of a strain that oscillates: that of the deck times 1 + a sin(2 pi f t).")
               .byDefault("0")
               .atLeast(0)
               .below(1))
      .add(quantityKey("unsteady.frequency", units::frequency,
                       "Frequency f of a strain that oscillates: that of the deck times 1 + a sin(2 pi f t).")
               .optional()
               .above(0));
}

}  // namespace

DeckSchema flameSchema() {
  DeckSchema schema;
  schema.add(choiceKey("problem", {"flame1d"}, "What is solved."))
      .add(stringKey("title", "One line for reports and pictures.").byDefault("''"));
  addMechanismKeys(schema);
  schema.add(quantityKey("pressure", units::pressure, "Pressure of the gas.").byDefault("1 atm").above(0));
  addFlame(schema);
  addPhysics(schema);
  addParticleKeys(schema, {.description = "Particles, carried by the gas or along the flame's paths, by repeats of "
                                          "independent random numbers; absent: none.",
                           .besideModel = true,
                           .treeNumber = "2048"});
  addStochasticKeys(schema);
  addGrid(schema);
  addSolver(schema);
  addContinuation(schema);
  addUnsteady(schema);
  addSensitivityKeys(schema,
                     "Sensitivities d ln S_u / d ln k of the flame speed to the rate constants, forward and reverse "
                     "together, by the adjoint of the flame.",
                     "flame_speed", {{"flame.type", {"free"}}});
  return schema;
}

}  // namespace lampblack::app
