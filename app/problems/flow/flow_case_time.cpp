// The section time of a flow's deck.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "app/deck/gas_input.hpp"
#include "app/problems/flow/flow_case_parts.hpp"

namespace lampblack::app::flowcase {

void addTimeKeys(DeckSchema& schema) {
  const std::vector<std::string> transient{"transient"};
  schema
      .add(choiceKey("time.mode", {"transient", "steady"},
                     "transient: the flow in time, from the start to time.end; steady: the state of the flow that does "
                     "not change any more, by steps in time until the flow is established, and iterations on the "
                     "residual of its equations from there. Outlets, boundaries that do not depend on time, and no "
                     "ensembles in the cells.")
               .byDefault("transient"))
      .add(quantityKey("time.end", units::time, "Time at which the run ends, from zero; a run in time needs it.")
               .optional()
               .above(0)
               .onlyWith("time.mode", transient))
      .add(quantityKey("time.first_step", units::time, "First time step.").byDefault("1 us").above(0))
      .add(quantityKey("time.maximum_step", units::time, "Largest time step.").byDefault("1 ms").above(0))
      .add(numberKey("time.courant", "Share of a cell's volume that may flow out in a step.")
               .byDefault("0.5")
               .above(0)
               .atMost(1))
      .add(integerKey(
               "time.sweeps",
               "Sweeps of deferred correction in a time step. 1: first order in time, for flames that become steady, "
               "whose steady state is the same; 2: second order, at twice the cost, without the waves that one sweep "
               "leaves in fast jets of little diffusion; more: smaller errors.")
               .byDefault("1")
               .atLeast(1)
               .atMost(10)
               .onlyWith("time.mode", transient))
      .add(numberKey("time.tolerance",
                     "Largest change by the last sweep that a time step may have in any cell, of the temperature "
                     "(relative) and of a mass fraction; steps become as short as that needs, and no longer than the "
                     "Courant number allows. Needs two sweeps; absent: the Courant number alone.")
               .optional()
               .above(0)
               .below(1)
               .onlyWith("time.mode", transient))
      .add(numberKey("time.growth", "Largest ratio of a time step to the one before.").byDefault("1.2").above(1))
      .add(integerKey(
               "time.retries",
               "How often a time step that fails is tried again, each time with a quarter of its length, before "
               "the run ends with its last good state and a checkpoint. Steps fail where a value is no number "
               "any more, a temperature is out of range or colder than the start and all boundaries, more changes "
               "than time.temperature_change and time.least_mass_fraction allow, or the pressure or a cell's "
               "chemistry cannot be solved. "
               "0: the first failure ends the run.")
               .byDefault("4")
               .atLeast(0)
               .atMost(20))
      .add(quantityKey("time.temperature_change", units::temperature,
                       "Largest change of a cell's temperature in a time step. A step that changes one by more fails "
                       "and is tried again, shorter, and the steps behind it become no longer than that needs.")
               .byDefault("500 K")
               .above(0))
      .add(numberKey(
               "time.least_mass_fraction",
               "Most negative mass fraction that a time step may leave in a cell; one that leaves less, and has taken "
               "it there by more than a tenth of this itself, fails and is tried again, shorter. Nothing is "
               "clipped.")
               .byDefault("-1e-4")
               .below(0))
      .add(quantityKey("time.wall_limit", units::time,
                       "Wall time, from the start of the program, before whose end the run stops by itself as SIGTERM "
                       "stops it: with its last state in the results and a checkpoint, from which `lampblack run "
                       "--restart` goes on, and exit code 143. It makes one step at least. Absent: no limit.")
               .optional()
               .above(0));
  addSteadyKeys(schema);
}

void readTime(const Deck& deck, FlowCase& flowCase) {
  TimeControl& time = flowCase.time;
  if (isSearched(deck)) {
    time.search = readSearch(deck, flowCase);
    time.end = std::numeric_limits<double>::infinity();
  } else {
    time.end = neededQuantity(deck, "time", "end", "a run in time");
    time.tolerance = deck.optionalNumber("time.tolerance");
    time.steady = readSteady(deck, flowCase);
    flowCase.flow.sweeps = deck.integer<int>("time.sweeps");
  }
  time.firstStep = deck.quantity("time.first_step");
  time.maximumStep = deck.quantity("time.maximum_step");
  time.growth = deck.number("time.growth");
  time.retries = deck.integer<int>("time.retries");
  time.wallLimit = deck.optionalQuantity("time.wall_limit");
  time.temperatureChange = deck.quantity("time.temperature_change");
  time.leastMassFraction = deck.number("time.least_mass_fraction");
  if (time.search && flowCase.ensembles) readRounds(deck, flowCase);
  flowCase.flow.courant = deck.number("time.courant");
  if (deck.choice("convection.velocity") == "central") {
    flowCase.flow.velocityScheme = VelocityScheme::Central;
    if (flowCase.flow.sweeps < 2)
      throw deck.error("convection.velocity",
                       "central convection is not stable in steps of one sweep; expected "
                       "'time.sweeps: 2' or more");
  }
  if (flowCase.time.tolerance && flowCase.flow.sweeps < 2)
    throw deck.error("time.tolerance",
                     "the error of a step is what its last sweep corrects; expected 'sweeps: 2' or more");
  if (flowCase.time.firstStep > flowCase.time.maximumStep)
    throw deck.error("time.first_step", "expected no more than 'maximum_step'");
}

}  // namespace lampblack::app::flowcase
