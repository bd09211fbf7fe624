#include "app/prescribed_gas/prescribed_gas_output.hpp"

#include <cmath>

#include "app/run/repeat_columns.hpp"
#include "core/constants.hpp"

namespace lampblack::app {
namespace {

struct NamedValue {
  const char *name, *unit, *description;
  RepeatedValue PathEnsemble::*value;
};
constexpr NamedValue namedValues[] = {
    {"soot_number_density", "1/m^3", "particles", &PathEnsemble::number},
    {"soot_volume_fraction", "1", "particle volume per volume of gas", &PathEnsemble::volumeFraction},
    {"soot_mass", "kg/m^3", "mass of particles", &PathEnsemble::mass},
    {"soot_mean_diameter", "m", "of the sphere of mean volume", &PathEnsemble::volumeDiameter},
    {"soot_mobility_diameter", "m", "mean mobility diameter, by number", &PathEnsemble::meanDiameter},
    {"soot_geometric_deviation", "1", "of the diameter of mobility, by number", &PathEnsemble::geometricDeviation},
    {"soot_surface_area", "m^2/m^3", "surface of all particles", &PathEnsemble::surface},
    {"soot_primaries", "1", "primary particles in an aggregate", &PathEnsemble::primaries},
    {"soot_carbon", "kg/m^3", "carbon in particles", &PathEnsemble::carbon},
    {"soot_hydrogen", "kg/m^3", "hydrogen in particles", &PathEnsemble::hydrogen},
    {"soot_mass_squared", "kg^2/m^3", "sum of the squares of the masses", &PathEnsemble::massSquared},
    {"soot_mass_cubed", "kg^3/m^3", "sum of the cubes of the masses", &PathEnsemble::massCubed},
    {"coagulation_events", "1", "collisions of numerical particles since the start", &PathEnsemble::coagulations}};

struct NamedRate {
  const char *name, *unit, *description;
  double EnsembleExchange::*value;
};
constexpr NamedRate namedRates[] = {
    {"nucleation_number", "1/m^3/s", "new particles", &EnsembleExchange::nucleatedNumber},
    {"oxidation_number", "1/m^3/s", "particles oxidised away", &EnsembleExchange::oxidisedNumber},
    {"nucleation", "kg/m^3/s", "soot mass from nucleation", &EnsembleExchange::nucleated},
    {"condensation", "kg/m^3/s", "soot mass from condensation", &EnsembleExchange::condensed},
    {"growth", "kg/m^3/s", "soot mass from surface growth", &EnsembleExchange::grown},
    {"oxidation_O2", "kg/m^3/s", "soot mass lost by oxidation by O2", &EnsembleExchange::oxidisedO2},
    {"oxidation_OH", "kg/m^3/s", "soot mass lost by oxidation by OH", &EnsembleExchange::oxidisedOH},
    {"dilution_carbon", "kg/m^3/s", "carbon lost by the expansion of the gas", &EnsembleExchange::dilutedCarbon},
    {"resampled_carbon", "kg/m^3/s", "carbon of numerical particles that come and go, zero in the mean",
     &EnsembleExchange::resampledCarbon}};

const Quantity gasColumns[] = {{"time", "s", "time"},
                               {"temperature", "K", "gas temperature"},
                               {"pressure", "Pa", "pressure"},
                               {"density", "kg/m^3", "density of the gas"}};

void appendGas(const PrescribedGasCase& along, std::size_t row, std::vector<double>& rows) {
  const GasSample& at = along.path.points[along.recorded[row]];
  rows.insert(rows.end(), {at.time, at.gas.temperature, at.gas.pressure, at.gas.density});
}

}  // namespace

PrescribedGasTable historyOf(const PrescribedGasCase& along, const PathEnsemble& ensemble) {
  PrescribedGasTable table{{std::begin(gasColumns), std::end(gasColumns)}, {}};
  for (const NamedValue& v : namedValues) addRepeatColumns({v.name, v.unit, v.description}, table.columns);
  const RepeatIntervals intervals(along.ensemble->repeats);
  for (std::size_t row = 0; row < along.recorded.size(); ++row) {
    appendGas(along, row, table.rows);
    for (const NamedValue& v : namedValues)
      intervals.append((ensemble.*v.value).mean[row], (ensemble.*v.value).error[row], table.rows);
  }
  return table;
}

PrescribedGasTable historyOf(const PrescribedGasCase& along, const ModelAlong& model) {
  PrescribedGasTable table{{std::begin(gasColumns), std::end(gasColumns)}, {}};
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

PrescribedGasTable ratesOf(const PrescribedGasCase& along, const PathEnsemble& ensemble) {
  PrescribedGasTable table{{{"from", "s", "begin of the interval"}, {"to", "s", "end of the interval"}}, {}};
  for (const NamedRate& r : namedRates) addRepeatColumns({r.name, r.unit, r.description}, table.columns);
  const RepeatIntervals intervals(along.ensemble->repeats);
  for (std::size_t i = 0; i < ensemble.exchange.size(); ++i) {
    const double from = along.path.points[along.recorded[i]].time, to = along.path.points[along.recorded[i + 1]].time;
    table.rows.insert(table.rows.end(), {from, to});
    for (const NamedRate& r : namedRates)
      intervals.append(ensemble.exchange[i].*r.value / (to - from), ensemble.exchangeError[i].*r.value / (to - from),
                       table.rows);
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

void recordPrescribedGas(JsonWriter& json, const PrescribedGasTable& history) {
  const std::size_t n = history.columns.size();
  for (std::size_t c = 1; c < n; ++c)
    json.field("final_" + history.columns[c].name, history.rows[history.rows.size() - n + c]);
}

void recordCounts(JsonWriter& json, const PathEnsemble& ensemble) {
  json.key("counts").beginObject();
  for (const PopulationCounter& counter : populationCounters)
    json.field(counter.name, static_cast<std::int64_t>(ensemble.counters.*counter.value));
  json.endObject();
}

}  // namespace lampblack::app
