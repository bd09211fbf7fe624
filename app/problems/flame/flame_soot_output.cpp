#include "app/problems/flame/flame_soot_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace lampblack::app {
namespace {

template <typename Columns>
std::vector<FlameSootFields::Field> emptyFields(const Columns& columns) {
  std::vector<FlameSootFields::Field> fields;
  fields.reserve(columns.size());
  for (const auto& column : columns) fields.push_back({column.name, column.unit, column.description, {}});
  return fields;
}

}  // namespace

const FlameSootFields::Field& FlameSootFields::property(const std::string& name) const {
  for (const Field& field : properties)
    if (field.name == name) return field;
  throw std::logic_error("soot has no property " + name);
}

FlameSootFields flameSootFields(const Mechanism& mechanism, double pressure, const CarriedParticles& soot,
                                const FlameProfile& profile, const FlameFields& gas) {
  FlameSootFields fields;
  fields.properties = emptyFields(particlePropertyNames);
  fields.processes = emptyFields(particleProcessNames);
  for (const ParticleScalar& scalar : soot.model().scalars())
    fields.scalars.push_back({scalar.name, scalar.unit, scalar.description, {}});
  const auto& exchanged = soot.exchanged();
  std::vector<double> concentrations(exchanged.size()), densities(fields.scalars.size());
  double most = 0, mostAtLimit = 0;
  for (std::size_t i = 0; i < profile.points(); ++i) {
    for (std::size_t e = 0; e < exchanged.size(); ++e)
      concentrations[e] =
          gas.density[i] * profile.massFractions(i)[exchanged[e]] / mechanism.molecularWeights()[exchanged[e]];
    for (std::size_t s = 0; s < densities.size(); ++s) {
      densities[s] = profile.scalars(i)[s] * soot.scalars()[s].scale * gas.density[i];
      fields.scalars[s].values.push_back(densities[s]);
    }
    const ParticleGas at{{gas.temperature[i], pressure, gas.density[i], gas.viscosity[i], gas.meanMolecularWeight[i]},
                         concentrations};
    const ParticleProperties properties = soot.model().propertiesForResults(at, densities);
    for (std::size_t c = 0; c < particlePropertyNames.size(); ++c)
      fields.properties[c].values.push_back(properties.*particlePropertyNames[c].value);
    const ParticleProcesses processes = soot.model().processes(at, densities);
    for (std::size_t c = 0; c < particleProcessNames.size(); ++c)
      fields.processes[c].values.push_back(processes.*particleProcessNames[c].value);
    most = std::max(most, properties.volumeFraction);
    mostAtLimit = std::max(mostAtLimit, soot.model().volumeFractionAtLimit(densities));
    const SizeDistribution sizes = soot.model().sizeDistribution(densities);
    if (i == 0) fields.diameter = sizes.diameter;
    fields.sizeDistribution.insert(fields.sizeDistribution.end(), sizes.density.begin(), sizes.density.end());
  }
  if (most > 0) fields.partAtLimit = mostAtLimit / most;
  return fields;
}

std::vector<NamedNumber> namedSootNumbers(const FlameFields& gas, const FlameSootFields& soot) {
  const std::vector<double>& fraction = soot.property("volume_fraction").values;
  const std::vector<double>& number = soot.property("number_density").values;
  const auto sootiest = static_cast<std::size_t>(std::max_element(fraction.begin(), fraction.end()) - fraction.begin());
  double column = 0;
  for (std::size_t i = 0; i + 1 < fraction.size(); ++i)
    column += 0.5 * (gas.z[i + 1] - gas.z[i]) * (fraction[i] + fraction[i + 1]);
  return {{"maximum_volume_fraction", "1", fraction[sootiest]},
          {"position_of_maximum_volume_fraction", "m", gas.z[sootiest]},
          {"integrated_volume_fraction", "m", column},
          {"maximum_number_density", "1/m^3", *std::max_element(number.begin(), number.end())},
          {"mean_diameter_at_maximum_volume_fraction", "m", soot.property("mean_diameter").values[sootiest]}};
}

void writeFlameSoot(ResultsWriter& results, const FlameSootFields& soot) {
  const auto write = [&](const std::string& folder, const std::vector<FlameSootFields::Field>& fields) {
    for (const FlameSootFields::Field& field : fields)
      results.dataset(folder + field.name, {static_cast<std::int64_t>(field.values.size())}, field.values, field.unit,
                      field.description);
  };
  write("/flame/soot/", soot.properties);
  write("/flame/soot/processes/", soot.processes);
  write("/flame/soot/scalars/", soot.scalars);
  if (soot.diameter.empty()) return;
  const auto sizes = static_cast<std::int64_t>(soot.diameter.size());
  results.dataset("/flame/soot/diameter", {sizes}, soot.diameter, "m", "diameters of the size distribution");
  results.dataset("/flame/soot/size_distribution",
                  {static_cast<std::int64_t>(soot.sizeDistribution.size()) / sizes, sizes}, soot.sizeDistribution,
                  "1/m^3", "dN/dlog10 d of each point");
}

}  // namespace lampblack::app
