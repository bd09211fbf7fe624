#include "app/problems/engine/engine_along.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "app/problems/engine/engine_output.hpp"
#include "core/errors.hpp"
#include "coupling/given_gas.hpp"
#include "coupling/model_along.hpp"
#include "coupling/path_ensemble.hpp"

namespace lampblack::app {
namespace {

// What is compared, by its name without the material.
constexpr std::array compared{"volume_fraction", "number_density", "mean_diameter"};

class HistoryColumns {
 public:
  HistoryColumns(const EngineCase& made, const std::vector<double>& history)
      : columns_(engineHistoryColumns(made)), history_(history) {}
  [[nodiscard]] std::vector<double> of(const std::string& name) const {
    const auto at = std::ranges::find(columns_, name, &Quantity::name) - columns_.begin();
    std::vector<double> values;
    for (auto k = static_cast<std::size_t>(at); k < history_.size(); k += columns_.size())
      values.push_back(history_[k]);
    return values;
  }

 private:
  std::vector<Quantity> columns_;
  const std::vector<double>& history_;
};

GasHistory meanGas(const EngineCase& made, const HistoryColumns& history) {
  GasHistory gas{history.of("time"), history.of("temperature"), history.of("pressure"), {}, {}};
  const std::size_t species = made.mechanism->numSpecies();
  gas.fractions.resize(gas.time.size() * species);
  for (const std::size_t k : made.species) {
    const std::vector<double> X = history.of("X_" + made.mechanism->speciesName(k));
    for (std::size_t row = 0; row < X.size(); ++row) gas.fractions[row * species + k] = std::max(0.0, X[row]);
  }
  return gas;
}

std::string materialOf(const EngineCase& made) {
  return made.soot ? made.soot->material() : made.population->material;
}

}  // namespace

EngineSootTable sootAlongMeanGas(MPI_Comm comm, const EngineCase& made, std::vector<double> history) {
  history.resize(made.angles().size() * engineHistoryColumns(made).size());
  MPI_Bcast(history.data(), static_cast<int>(history.size()), MPI_DOUBLE, 0, comm);
  const HistoryColumns given(made, history);
  const GasHistory gas = meanGas(made, given);
  const std::string material = materialOf(made) + "_";
  EngineSootTable table{{{"angle", "deg", "crank angle from the upper dead centre"}}, {}};
  std::vector<std::vector<double>> values{made.angles()};
  const auto add = [&](const std::string& name, const char* unit, const std::string& description,
                       std::vector<double> column) {
    table.columns.push_back({name, unit, description});
    values.push_back(std::move(column));
  };
  const auto unitOf = [](const std::string& name) {
    return std::ranges::find(particlePropertyNames, name, &ParticlePropertyName::name)->unit;
  };
  if (made.soot) {
    for (const std::string name : compared)
      add("carried_" + name, unitOf(name), "by the model that the particles of gas carry", given.of(material + name));
    const ParticleModel& model = made.soot->model();
    ParticlePath path = givenPath(*made.mechanism, gas, model.gasSpecies(), GasViscosity::transport);
    const std::vector<std::size_t> recorded = insertPoints(path, gas.time);
    const ModelAlong along = marchModel(model, path, recorded);
    for (const std::string name : compared) {
      const auto member = std::ranges::find(particlePropertyNames, name, &ParticlePropertyName::name)->value;
      std::vector<double> column;
      for (const ModelRecord& record : along.records) column.push_back(record.properties.*member);
      add("along_" + name, unitOf(name), "by this model along the mean gas", std::move(column));
    }
  }
  if (made.population) {
    std::vector<std::string> seen;
    for (const std::size_t k : made.population->species) seen.push_back(made.mechanism->speciesName(k));
    ParticlePath path = givenPath(*made.mechanism, gas, seen, made.population->viscosity);
    PathMarch march;
    march.bins = made.population->bins;
    march.recorded = insertPoints(path, gas.time);
    const PathEnsemble ensemble = runPathEnsemble(comm, path, made.population->make, 0, made.population->repeats, march,
                                                  "the population along the mean gas");
    for (std::size_t c = 0; c < ensemble.columns.size(); ++c) {
      const auto& [name, unit, description] = ensemble.columns[c];
      const std::string own = name.starts_with(material) ? name.substr(material.size()) : name;
      add("population_" + own, unit.c_str(), description + ", along the mean gas", ensemble.values[c].mean);
      add("population_" + own + "_error", unit.c_str(), "standard error of its mean", ensemble.values[c].error);
    }
  }
  for (std::size_t row = 0; row < gas.time.size(); ++row)
    for (const std::vector<double>& column : values) table.rows.push_back(column.at(row));
  return table;
}

}  // namespace lampblack::app
