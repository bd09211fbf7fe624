#include "app/reactor/reactor_output.hpp"

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

std::vector<Quantity> closedColumns(const ReactorCase& reactorCase) {
  std::vector<Quantity> columns{{"time", "s", "time"},
                                {"temperature", "K", "gas temperature"},
                                {"pressure", "Pa", "pressure"},
                                {"density", "kg/m^3", "density"},
                                {"temperature_rate", "K/s", "dT/dt"},
                                {"heat_release", "W/m^3", "heat set free by the reactions"}};
  for (auto& column : speciesColumns(*reactorCase.mechanism, reactorCase.output)) columns.push_back(std::move(column));
  return columns;
}

std::vector<double> closedRow(const ReactorCase& reactorCase, ClosedReactor& reactor, double time,
                              std::span<const double> y) {
  std::vector<double> f(y.size());
  reactor.rates(time, y.data(), f.data());
  const std::size_t n = reactorCase.mechanism->numSpecies();
  std::vector<double> row{
      time, y[n], reactor.pressure(y.data()), reactor.density(y.data()), f[n], reactor.heatRelease(y.data())};
  appendSpecies(*reactorCase.mechanism, reactorCase.output, y.first(n), row);
  return row;
}

void writeSensitivityTable(const std::filesystem::path& path, const ReactorCase& reactorCase,
                           const IgnitionSensitivities& sensitivities) {
  std::vector<std::string> names{"reaction", "equation"};
  for (std::size_t i = 0; i < reactorCase.ignition.size(); ++i)
    if (!sensitivities.values[i].empty()) names.push_back(reactorCase.ignition[i].name + " [1]");
  std::string text = csvLine(names);
  for (std::size_t p = 0; p < reactorCase.sensitivities.size(); ++p) {
    const std::size_t r = reactorCase.sensitivities[p];
    std::vector<std::string> fields{std::to_string(r + 1), reactorCase.mechanism->reaction(r).equation};
    for (const auto& values : sensitivities.values)
      if (!values.empty()) fields.push_back(fmt::format("{}", values[p]));
    text += csvLine(fields);
  }
  writeFileAtomically(path, text);
}

std::string describe(const IgnitionCriterion& criterion, const Mechanism& mechanism) {
  switch (criterion.kind) {
    case Kind::TemperatureRate:
      return "largest dT/dt";
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
  return criterion.kind == Kind::TemperatureRise ? "K" : "1";
}

}  // namespace

void writeIgnition(ResultsWriter& results, const ReactorCase& reactorCase,
                   const std::vector<std::optional<IgnitionEvent>>& events) {
  for (std::size_t i = 0; i < reactorCase.ignition.size(); ++i) {
    const IgnitionCriterion& criterion = reactorCase.ignition[i];
    const std::string what = describe(criterion, *reactorCase.mechanism);
    const double missing = std::numeric_limits<double>::quiet_NaN();
    const bool met = i < events.size() && events[i];
    const double time = met ? events[i]->time : missing, value = met ? events[i]->value : missing;
    results.dataset("/ignition/" + criterion.name + "/delay", {}, {&time, 1}, "s", "ignition delay: " + what);
    results.dataset("/ignition/" + criterion.name + "/value", {}, {&value, 1}, unitOf(criterion),
                    "what is largest, or the temperature reached");
  }
}

void writeSensitivities(ResultsWriter& results, const ReactorCase& reactorCase,
                        const IgnitionSensitivities& sensitivities) {
  const auto count = static_cast<std::int64_t>(reactorCase.sensitivities.size());
  std::vector<std::int64_t> numbers;
  for (const std::size_t r : reactorCase.sensitivities) numbers.push_back(static_cast<std::int64_t>(r) + 1);
  results.dataset("/sensitivity/reaction", {count}, std::span<const std::int64_t>(numbers), "1",
                  "number of the reaction in the mechanism file, from 1");
  for (std::size_t i = 0; i < reactorCase.ignition.size(); ++i) {
    std::vector<double> values(numbers.size(), std::numeric_limits<double>::quiet_NaN());
    if (i < sensitivities.values.size() && !sensitivities.values[i].empty()) values = sensitivities.values[i];
    results.dataset("/sensitivity/" + reactorCase.ignition[i].name, {count}, std::span<const double>(values), "1",
                    "d ln(ignition delay) / d ln(rate constant)");
  }
}

}  // namespace lampblack::app
