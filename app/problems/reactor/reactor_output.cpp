#include "app/problems/reactor/reactor_output.hpp"

#include <fmt/format.h>

#include <limits>

#include "io/csv.hpp"

namespace lampblack::app {

using Kind = IgnitionCriterion::Kind;

std::vector<Quantity> speciesColumns(const Mechanism& mechanism, const ReactorOutput& output) {
  std::vector<Quantity> columns;
  for (const std::size_t k : output.species) {
    const std::string& name = mechanism.speciesName(k);
    columns.push_back({(output.massFractions ? "Y_" : "X_") + name, "1",
                       (output.massFractions ? "mass fraction of " : "mole fraction of ") + name});
  }
  return columns;
}

void appendSpecies(const Mechanism& mechanism, const ReactorOutput& output, std::span<const double> Y,
                   std::vector<double>& row) {
  const auto W = mechanism.molecularWeights();
  double moles = 0;
  for (std::size_t k = 0; k < Y.size(); ++k) moles += Y[k] / W[k];
  for (const std::size_t k : output.species) row.push_back(output.massFractions ? Y[k] : Y[k] / (W[k] * moles));
}

std::vector<Sensitivities> namedSensitivities(const ClosedKind& closed, const IgnitionSensitivities& sensitivities) {
  std::vector<Sensitivities> named;
  for (std::size_t i = 0; i < closed.ignition.size(); ++i)
    named.push_back(
        {closed.ignition[i].name, i < sensitivities.values.size() ? sensitivities.values[i] : std::vector<double>()});
  return named;
}

std::string describe(const IgnitionCriterion& criterion, const Mechanism& mechanism) {
  switch (criterion.kind) {
    case Kind::TemperatureRate:
      return criterion.firstStage ? "first maximum of dT/dt, before a higher one" : "largest dT/dt";
    case Kind::PressureRate:
      return "largest dp/dt";
    case Kind::MoleFraction:
      return "largest mole fraction of " + mechanism.speciesName(criterion.species);
    case Kind::MassFraction:
      return "largest mass fraction of " + mechanism.speciesName(criterion.species);
    case Kind::TemperatureRise:
      return fmt::format("T is {:g} K up", criterion.rise);
  }
  return "";
}

namespace {

const char* unitOf(const IgnitionCriterion& criterion) {
  if (criterion.kind == Kind::TemperatureRate) return "K/s";
  if (criterion.kind == Kind::PressureRate) return "Pa/s";
  return criterion.kind == Kind::TemperatureRise ? "K" : "1";
}

}  // namespace

void writeIgnition(ResultsWriter& results, const Mechanism& mechanism, const ClosedKind& closed,
                   const std::vector<std::optional<IgnitionEvent>>& events) {
  for (std::size_t i = 0; i < closed.ignition.size(); ++i) {
    const IgnitionCriterion& criterion = closed.ignition[i];
    const std::string what = describe(criterion, mechanism);
    const double missing = std::numeric_limits<double>::quiet_NaN();
    const bool met = i < events.size() && events[i];
    const double time = met ? events[i]->time : missing, value = met ? events[i]->value : missing;
    results.dataset("/ignition/" + criterion.name + "/delay", {}, {&time, 1}, "s", "ignition delay: " + what);
    results.dataset("/ignition/" + criterion.name + "/value", {}, {&value, 1}, unitOf(criterion),
                    "what is largest, or the temperature reached");
  }
}

std::string outLine(const std::string& name, const ReactorSteadyState& reactor) {
  if (!reactor.out) return "";
  if (reactor.lastBurningTime)
    return fmt::format("Reactor '{}' is out: followed from longer residence times, burning states end at {:.4g} s.\n",
                       name, *reactor.lastBurningTime);
  return fmt::format("Reactor '{}' is out: no burning state was found at longer residence times, either.\n", name);
}

void recordOut(JsonWriter& json, const ReactorSteadyState& reactor) {
  json.field("out", reactor.out);
  if (reactor.lastBurningTime) json.field("last_burning_residence_time_s", *reactor.lastBurningTime);
}

}  // namespace lampblack::app
