#include "app/problems/prescribed_gas/prescribed_gas_output.hpp"

#include <cmath>

#include "app/run/repeat_columns.hpp"
#include "core/constants.hpp"

namespace lampblack::app {
namespace {

const Quantity gasColumns[] = {{"time", "s", "time"},
                               {"temperature", "K", "gas temperature"},
                               {"pressure", "Pa", "pressure"},
                               {"density", "kg/m^3", "density of the gas"}};

void appendGas(const PrescribedGasCase& along, std::size_t row, std::vector<double>& rows) {
  const GasSample& at = along.path.points[along.recorded[row]];
  rows.insert(rows.end(), {at.time, at.gas.temperature, at.gas.pressure, at.gas.density});
}

}  // namespace

Table historyOf(const PrescribedGasCase& along, const PathEnsemble& ensemble) {
  Table table{{std::begin(gasColumns), std::end(gasColumns)}, {}};
  for (const Quantity& column : ensemble.columns) addRepeatColumns(column, table.columns);
  const RepeatIntervals intervals(along.ensemble->repeats);
  for (std::size_t row = 0; row < along.recorded.size(); ++row) {
    appendGas(along, row, table.rows);
    for (const RepeatedValue& value : ensemble.values) intervals.append(value.mean[row], value.error[row], table.rows);
  }
  return table;
}

Table historyOf(const PrescribedGasCase& along, const ModelAlong& model) {
  Table table{{std::begin(gasColumns), std::end(gasColumns)}, {}};
  const std::string material = along.model->material() + "_";
  for (const auto& p : particlePropertyNames) table.columns.push_back({material + p.name, p.unit, p.description});
  for (const auto& p : particleProcessNames) table.columns.push_back({material + p.name, p.unit, p.description});
  for (const ParticleScalar& s : along.model->scalars())
    table.columns.push_back({material + s.name, s.unit, s.description});
  for (const std::size_t k : along.depleted) {
    const std::string& name = along.model->gasSpecies()[k];
    table.columns.push_back({"X_" + name, "1", "mole fraction of " + name});
  }
  for (std::size_t row = 0; row < model.records.size(); ++row) {
    const ModelRecord& record = model.records[row];
    appendGas(along, row, table.rows);
    for (const auto& p : particlePropertyNames) table.rows.push_back(record.properties.*p.value);
    for (const auto& p : particleProcessNames) table.rows.push_back(record.processes.*p.value);
    table.rows.insert(table.rows.end(), record.densities.begin(), record.densities.end());
    const CarrierGas& gas = along.path.points[along.recorded[row]].gas;
    for (const double c : record.depleted)
      table.rows.push_back(c * constants::gasConstant * gas.temperature / gas.pressure);
  }
  return table;
}

Table ratesOf(const PrescribedGasCase& along, const PathEnsemble& ensemble) {
  Table table{{{"from", "s", "begin of the interval"}, {"to", "s", "end of the interval"}}, {}};
  for (const auto& [name, unit, description] : ensemble.processes)
    addRepeatColumns({name, unit + "/s", description}, table.columns);
  const RepeatIntervals intervals(along.ensemble->repeats);
  for (std::size_t i = 0; i < ensemble.exchange.size(); ++i) {
    const double from = along.path.points[along.recorded[i]].time, to = along.path.points[along.recorded[i + 1]].time;
    table.rows.insert(table.rows.end(), {from, to});
    for (std::size_t k = 0; k < ensemble.processes.size(); ++k)
      intervals.append(ensemble.exchange[i].processes[k] / (to - from),
                       ensemble.exchangeError[i].processes[k] / (to - from), table.rows);
  }
  return table;
}

void writeDistributions(ResultsWriter& results, const PrescribedGasCase& along, const PathEnsemble& ensemble) {
  const std::vector<double> edges = along.ensemble->bins.edges();
  std::vector<double> diameter;
  for (std::size_t b = 0; b + 1 < edges.size(); ++b) diameter.push_back(std::sqrt(edges[b] * edges[b + 1]));
  const auto bins = static_cast<std::int64_t>(diameter.size()), rows = static_cast<std::int64_t>(along.recorded.size());
  results.dataset("/particles/bin_edges", {bins + 1}, edges, "m", "diameters between the bins");
  results.dataset("/particles/diameter", {bins}, diameter, "m", "middles of the bins of the size distribution");
  results.dataset("/particles/size_distribution", {rows, bins}, ensemble.distribution.mean, "1/m^3",
                  "dN/dlog10 d of each row of the history, mean of the repeats, by mobility diameter");
  results.dataset("/particles/size_distribution_error", {rows, bins}, ensemble.distribution.error, "1/m^3",
                  "standard error of that mean");
}

void writeDistributions(ResultsWriter& results, const ModelAlong& model) {
  // Rank 0 alone has records; the others' sizes do not count.
  std::vector<double> diameter, density;
  for (const ModelRecord& record : model.records) {
    diameter = record.sizes.diameter;
    density.insert(density.end(), record.sizes.density.begin(), record.sizes.density.end());
  }
  const auto sizes = static_cast<std::int64_t>(diameter.size()), rows = static_cast<std::int64_t>(model.records.size());
  results.dataset("/particles/diameter", {sizes}, diameter, "m", "diameters of the size distribution");
  results.dataset("/particles/size_distribution", {rows, sizes}, density, "1/m^3",
                  "dN/dlog10 d of each row of the history");
}

void recordCounts(JsonWriter& json, const PathEnsemble& ensemble) {
  json.key("counts").beginObject();
  for (const auto& [name, count] : ensemble.counts) json.field(name, static_cast<std::int64_t>(count));
  json.endObject();
}

}  // namespace lampblack::app
