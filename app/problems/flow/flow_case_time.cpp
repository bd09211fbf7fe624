// The section time of a flow's deck.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "app/deck/gas_input.hpp"
#include "app/problems/flow/flow_case_parts.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app::flowcase {

namespace {

DeckKeys<FlowCase> timeKeys() {
  using Time = TimeControl;
  using Flow = TransportOperator::Options;
  constexpr auto time = [](auto member) { return inner(&FlowCase::time, member); };
  const DeckCondition inTime{"time.mode", {"transient"}};
  DeckKeys<FlowCase> keys("time");
  keys.choice("mode", {"transient", "steady"}, rules().byDefault("transient"),
              "transient: the flow in time, from the start to time.end; steady: the state of the flow that does "
              "not change any more, by steps in time until the flow is established, and iterations on the "
              "residual of its equations from there. Outlets, boundaries that do not depend on time, and no "
              "ensembles in the cells.");
  keys.quantity("end", units::time, time(&Time::end), rules().optional().above(0).onlyWith(inTime),
                "Time at which the run ends, from zero; a run in time needs it.");
  keys.quantity("first_step", units::time, time(&Time::firstStep), rules().byDefault("1 us").above(0),
                "First time step.");
  keys.quantity("maximum_step", units::time, time(&Time::maximumStep), rules().byDefault("1 ms").above(0),
                "Largest time step.");
  keys.number("courant", inner(&FlowCase::flow, &Flow::courant), rules().byDefault("0.5").above(0).atMost(1),
              "Share of a cell's volume that may flow out in a step.");
  keys.integer("sweeps", inner(&FlowCase::flow, &Flow::sweeps), rules().atLeast(1).atMost(10).onlyWith(inTime),
               "Sweeps of deferred correction in a time step. 1: first order in time, for flames that become steady, "
               "whose steady state is the same; 2: second order, at twice the cost, without the waves that one sweep "
               "leaves in fast jets of little diffusion; more: smaller errors.");
  keys.number("tolerance", time(&Time::tolerance), rules().above(0).below(1).onlyWith(inTime),
              "Largest change by the last sweep that a time step may have in any cell, of the temperature "
              "(relative) and of a mass fraction; steps become as short as that needs, and no longer than the "
              "Courant number allows. Needs two sweeps; absent: the Courant number alone.");
  keys.number("growth", time(&Time::growth), rules().above(1), "Largest ratio of a time step to the one before.");
  keys.integer("retries", time(&Time::retries), rules().atLeast(0).atMost(20),
               "How often a time step that fails is tried again, each time with a quarter of its length, before "
               "the run ends with its last good state and a checkpoint. Steps fail where a value is no number "
               "any more, a temperature is out of range or colder than the start and all boundaries, more changes "
               "than time.temperature_change and time.least_mass_fraction allow, or the pressure or a cell's "
               "chemistry cannot be solved. "
               "0: the first failure ends the run.");
  keys.quantity("temperature_change", units::temperature, time(&Time::temperatureChange), rules().above(0),
                "Largest change of a cell's temperature in a time step. A step that changes one by more fails "
                "and is tried again, shorter, and the steps behind it become no longer than that needs.");
  keys.number("least_mass_fraction", time(&Time::leastMassFraction), rules().byDefault("-1e-4").below(0),
              "Most negative mass fraction that a time step may leave in a cell; one that leaves less, and has taken "
              "it there by more than a tenth of this itself, fails and is tried again, shorter. Nothing is "
              "clipped.");
  keys.quantity("wall_limit", units::time, time(&Time::wallLimit), rules().above(0),
                "Wall time, from the start of the program, before whose end the run stops by itself as SIGTERM "
                "stops it: with its last state in the results and a checkpoint, from which `lampblack run "
                "--restart` goes on, and exit code 143. It makes one step at least. Absent: no limit.");
  return keys;
}

}  // namespace

void addTimeKeys(DeckSchema& schema) {
  schema.add(timeKeys().schema());
  addSteadyKeys(schema);
}

void readTime(const Deck& deck, FlowCase& flowCase) {
  timeKeys().read(deck, flowCase, "time");
  TimeControl& time = flowCase.time;
  if (isSearched(deck)) {
    time.search = readSearch(deck, flowCase);
    time.end = std::numeric_limits<double>::infinity();
  } else {
    neededQuantity(deck, "time", "end", "a run in time");
    time.steady = readSteady(deck, flowCase);
  }
  if (time.search && flowCase.ensembles) readRounds(deck, flowCase);
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
