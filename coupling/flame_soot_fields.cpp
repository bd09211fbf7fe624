#include "coupling/flame_soot_fields.hpp"

#include <algorithm>
#include <stdexcept>

namespace lampblack::coupling {
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

}  // namespace lampblack::coupling
