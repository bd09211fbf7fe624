// The tables of a reactor run: their columns and rows, and what the sensitivities leave.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "app/deck/sensitivity_deck.hpp"
#include "app/problems/reactor/reactor_kind.hpp"
#include "chemistry/reactor/ignition_sensitivity.hpp"
#include "core/modules.hpp"
#include "io/json.hpp"
#include "io/results_writer.hpp"
#include "io/run_folder.hpp"
#include "io/table.hpp"

namespace lampblack::app {

// The columns of the chosen species, and their values at mass fractions Y.
std::vector<Quantity> speciesColumns(const Mechanism& mechanism, const ReactorOutput& output);
void appendSpecies(const Mechanism& mechanism, const ReactorOutput& output, std::span<const double> Y,
                   std::vector<double>& row);

// What a row of a history is of: the equations, and their state y at a time (s) or place (m).
template <typename Equations>
using StateTable = TableOf<Equations&, double, std::span<const double>>;
// The chosen species, behind the other columns.
template <typename Equations>
void addSpecies(StateTable<Equations>& table, const ReactorCase& reactorCase) {
  table.add(speciesColumns(*reactorCase.mechanism, reactorCase.output),
            [&reactorCase](Equations&, double, std::span<const double> y, std::vector<double>& row) {
              const Mechanism& mechanism = *reactorCase.mechanism;
              appendSpecies(mechanism, reactorCase.output, y.first(mechanism.numSpecies()), row);
            });
}
// The temperature, which all have.
template <typename Equations>
typename StateTable<Equations>::Column temperatureColumn(const ReactorCase& reactorCase) {
  return {{"temperature", "K", "gas temperature"},
          [n = reactorCase.mechanism->numSpecies()](Equations&, double, std::span<const double> y) { return y[n]; }};
}

// Of the ignition delays, by the criteria of the deck.
std::vector<Sensitivities> namedSensitivities(const ClosedKind& closed, const IgnitionSensitivities& sensitivities);

// The group /ignition. Collective; rank 0 has the values.
void writeIgnition(ResultsWriter& results, const Mechanism& mechanism, const ClosedKind& closed,
                   const std::vector<std::optional<IgnitionEvent>>& events);

// A line for the console on a stirred reactor that is out; empty for others.
std::string outLine(const std::string& name, const ReactorSteadyState& reactor);
// The fields of a stirred reactor that is out, in the record of the run.
void recordOut(JsonWriter& json, const ReactorSteadyState& reactor);

// "largest dT/dt": a criterion in words.
std::string describe(const IgnitionCriterion& criterion, const Mechanism& mechanism);

}  // namespace lampblack::app
