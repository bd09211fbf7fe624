#include "chemistry/reactor/engine/engine_gas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {

void EngineGas::add(double particleMass, double particleTemperature, std::span<const double> particleY) {
  mass.push_back(particleMass);
  temperature.push_back(particleTemperature);
  massFractions.insert(massFractions.end(), particleY.begin(), particleY.end());
  carried.resize(carried.size() + scalars);
  firstStep.push_back(0);
  cost.push_back(1);
}

void EngineGas::remove(std::size_t i) {
  const std::size_t last = count() - 1;
  for (std::vector<double>* values : {&mass, &temperature, &firstStep, &cost}) {
    (*values)[i] = values->back();
    values->pop_back();
  }
  std::copy_n(massFractions.begin() + static_cast<std::ptrdiff_t>(last * species), species,
              massFractions.begin() + static_cast<std::ptrdiff_t>(i * species));
  massFractions.resize(last * species);
  std::copy_n(carried.begin() + static_cast<std::ptrdiff_t>(last * scalars), scalars,
              carried.begin() + static_cast<std::ptrdiff_t>(i * scalars));
  carried.resize(last * scalars);
}

EngineTotals totalsOf(const Thermo& thermo, const EngineGas& gas) {
  EngineTotals all;
  all.massFractions.assign(gas.species, 0);
  for (std::size_t i = 0; i < gas.count(); ++i) {
    const double m = gas.mass[i], T = gas.temperature[i];
    all.mass += m;
    all.temperature += m * T;
    all.capacity += m * thermo.cpMass(T, gas.Y(i));
    for (std::size_t k = 0; k < gas.species; ++k) all.massFractions[k] += m * gas.Y(i)[k];
  }
  all.temperature /= all.mass;
  for (double& Y : all.massFractions) Y /= all.mass;
  all.volume = volumeOf(thermo, gas);
  all.enthalpy = enthalpyOf(thermo, gas);
  all.energy = energyOf(thermo, gas);
  return all;
}

double volumeOf(const Thermo& thermo, const EngineGas& gas) {
  double volume = 0;
  for (std::size_t i = 0; i < gas.count(); ++i)
    volume += gas.mass[i] / thermo.density(gas.temperature[i], gas.pressure, gas.Y(i));
  return volume;
}

double energyOf(const Thermo& thermo, const EngineGas& gas) {
  double sum = 0;
  for (std::size_t i = 0; i < gas.count(); ++i)
    sum += gas.mass[i] * thermo.internalEnergyMass(gas.temperature[i], gas.Y(i));
  return sum;
}

double enthalpyOf(const Thermo& thermo, const EngineGas& gas) {
  double sum = 0;
  for (std::size_t i = 0; i < gas.count(); ++i) sum += gas.mass[i] * thermo.enthalpyMass(gas.temperature[i], gas.Y(i));
  return sum;
}

std::vector<double> elementsOf(const Mechanism& mechanism, const EngineGas& gas) {
  std::vector<double> moles(mechanism.numElements(), 0);
  for (std::size_t i = 0; i < gas.count(); ++i)
    for (std::size_t k = 0; k < gas.species; ++k)
      for (std::size_t e = 0; e < moles.size(); ++e)
        moles[e] += gas.mass[i] * gas.Y(i)[k] / mechanism.species(k).molecularWeight * mechanism.atoms(k, e);
  return moles;
}

double EngineCompression::entropyAt(double T, std::span<const double> Y) {
  thermo_.speciesEntropies(T, work_);
  double sum = 0;
  for (std::size_t k = 0; k < Y.size(); ++k) sum += Y[k] * work_[k];
  return sum;
}

// Newton's method in ln T within a bracket: polynomials in two pieces may jump by round-off where they meet.
double EngineCompression::isentropic(double entropy, double guess, std::span<const double> Y) {
  double low = Thermo::minTemperature, high = Thermo::maxTemperature, T = guess;
  for (int tries = 0; tries < 100; ++tries) {
    const double apart = entropyAt(T, Y) - entropy;
    (apart < 0 ? low : high) = T;
    double next = T * std::exp(-apart / thermo_.cpMass(T, Y));
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const bool isThere = std::abs(next - T) <= 4e-16 * T || high - low <= 4e-16 * T;
    T = next;
    if (isThere) break;
  }
  if (!(T >= Thermo::minTemperature * 1.0001 && T <= Thermo::maxTemperature * 0.9999))
    throw NumericsError(
        fmt::format("the gas of the cylinder comes to {:.4g} K on its isentrope, outside of the range of its "
                    "thermodynamics, {:g} to {:g} K",
                    T, Thermo::minTemperature, Thermo::maxTemperature));
  return T;
}

double EngineCompression::moveTo(double volume, EngineGas& gas) {
  if (!(volume > 0))
    throw NumericsError(
        "the reactions of a step need more room than the cylinder has; give a smaller step.angle or more "
        "step.halvings");
  const std::size_t n = gas.count();
  const double before = energyOf(thermo_, gas);
  entropy_.resize(n);
  constant_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    constant_[i] = constants::gasConstant / thermo_.meanMolecularWeight(gas.Y(i));
    entropy_[i] = entropyAt(gas.temperature[i], gas.Y(i));
  }
  const double start = gas.pressure;
  double logarithm = 0, low = -HUGE_VAL, high = HUGE_VAL;  // of the pressure over that at the start
  for (int tries = 0; tries < 60; ++tries) {
    double sum = 0, slope = 0;
    for (std::size_t i = 0; i < n; ++i) {
      double& T = gas.temperature[i];
      const double R = constant_[i];
      if (tries > 0) T = isentropic(entropy_[i] + R * logarithm, T, gas.Y(i));
      sum += gas.mass[i] * R * T;
      slope += gas.mass[i] * R * T * (1 - R / thermo_.cpMass(T, gas.Y(i)));
    }
    const double ratio = sum / (start * std::exp(logarithm) * volume);  // of the volumes
    (ratio > 1 ? low : high) = logarithm;
    double step = std::log(ratio) * sum / slope;
    if (!(logarithm + step > low && logarithm + step < high) && std::isfinite(high - low))
      step = 0.5 * (low + high) - logarithm;
    if (std::abs(step) < 2e-15) break;
    logarithm += step;
  }
  gas.pressure = start * std::exp(logarithm);
  gas.pressure *= volumeOf(thermo_, gas) / volume;
  return before - energyOf(thermo_, gas);
}

}  // namespace lampblack::chemistry
