#include "particles/models/particle_model.hpp"

#include <algorithm>

#include "core/constants.hpp"
#include "particles/collisions/collision_physics.hpp"

namespace lampblack::particles {
namespace {

// Steps of the differences: a relative 1e-6; of a value far below its typical size, that of the smallest value that
// matters. At 1e-7 the noise of MOMIC's closure costs five times the steps, and the elements that a Jacobian has to
// keep. Rates rise steeply with the temperature, whose step is shorter.
constexpr double relativeStep = 1e-6, relativeTemperatureStep = 1e-7;

// Below these there are no particles, and none can be born.
constexpr double negligibleVolumeFraction = 1e-21;
constexpr double negligibleMoleFraction = 1e-15;
constexpr double fewestWithSizes = 1e6;  // 1/m3

double totalConcentration(const CarrierGas& gas) {  // mol/m3
  return gas.pressure / (constants::gasConstant * gas.temperature);
}

}  // namespace

double ParticleScalar::massOf(std::string_view element) const {
  double mass = 0;
  for (const ElementMass& part : elements)
    if (part.element == element) mass += part.mass;
  return mass;
}

void ParticleModel::jacobian(const ParticleGas& gas, std::span<const double> densities,
                             std::span<double> values) const {
  const std::size_t n = scalars().size(), m = gasSpecies().size(), rows = n + m, columns = rows + 1;
  thread_local std::vector<double> state, base, moved;
  state.resize(rows);
  base.resize(rows);
  moved.resize(rows);
  for (std::size_t i = 0; i < n; ++i) state[i] = std::max(densities[i], 0.0);
  for (std::size_t i = 0; i < m; ++i) state[n + i] = std::max(gas.concentrations[i], 0.0);
  ParticleGas at = gas;
  at.concentrations = {state.data() + n, m};
  const auto evaluate = [&](std::vector<double>& out) {
    sources(at, {state.data(), n}, {out.data(), n}, {out.data() + n, m});
  };
  const auto column = [&](std::size_t j, double step) {
    evaluate(moved);
    for (std::size_t i = 0; i < rows; ++i) values[i * columns + j] = (moved[i] - base[i]) / step;
  };
  evaluate(base);
  const double total = totalConcentration(gas);
  for (std::size_t j = 0; j < rows; ++j) {
    const double x = state[j], typical = j < n ? scalars()[j].scale * gas.density : total;
    state[j] = x + relativeStep * std::max(x, smallestShare * typical);
    column(j, state[j] - x);
    state[j] = x;
  }
  at.temperature = gas.temperature * (1 + relativeTemperatureStep);
  column(rows, at.temperature - gas.temperature);
}

bool ParticleModel::isNegligible(std::span<const double> densities) const {
  return volumeFraction(densities) < negligibleVolumeFraction;
}

ParticleProperties ParticleModel::propertiesForResults(const ParticleGas& gas,
                                                       std::span<const double> densities) const {
  if (isNegligible(densities)) return {};
  ParticleProperties p = properties(gas, densities);
  if (p.numberDensity < fewestWithSizes)
    for (double* size :
         {&p.meanDiameter, &p.primaryDiameter, &p.primariesPerAggregate, &p.mobilityDiameter, &p.gyrationDiameter})
      *size = 0;
  return p;
}

bool ParticleModel::idle(const ParticleGas& gas, std::span<const double> densities) const {
  if (!isNegligible(densities)) return false;
  double sum = 0;
  for (const std::size_t i : precursors()) sum += std::max(gas.concentrations[i], 0.0);
  return sum < negligibleMoleFraction * totalConcentration(gas);
}

double ParticleModel::thermophoresis() const {
  return waldmannThermophoresis();
}

double ParticleModel::volumeFraction(std::span<const double> densities) const {
  const std::vector<double> none(gasSpecies().size(), 0.0);
  ParticleGas gas;  // nitrogen at 1500 K
  gas.temperature = 1500;
  gas.pressure = constants::oneAtmosphere;
  gas.meanMolecularWeight = 0.028;
  gas.density = gas.pressure * gas.meanMolecularWeight / (constants::gasConstant * gas.temperature);
  gas.viscosity = 5.4e-5;
  gas.concentrations = none;
  return properties(gas, densities).volumeFraction;
}

double ParticleModel::volumeFractionAtLimit(std::span<const double> /*densities*/) const {
  return 0;
}

SizeDistribution ParticleModel::sizeDistribution(std::span<const double> /*densities*/) const {
  return {};
}

}  // namespace lampblack::particles
