#include "chemistry/reactor/engine/engine_mixing.hpp"

#include <algorithm>
#include <cmath>

#include "core/poisson.hpp"

namespace lampblack::chemistry {

double EngineMixing::advance(double duration, double tau, RandomStream& random, EngineGas& gas) {
  const std::size_t n = gas.count();
  if (model_ == EngineMixingModel::none || n < 2 || !(duration > 0)) return 0;
  const double before = volumeOf(thermo_, gas), times = constant_ * duration / tau;
  enthalpy_.resize(n);
  isChanged_.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) enthalpy_[i] = thermo_.enthalpyMass(gas.temperature[i], gas.Y(i));
  if (model_ == EngineMixingModel::iem) {
    exchange(-std::expm1(-0.5 * times), gas);
  } else {
    // An event takes 1/(N - 1) of the variance, with a uniform part of the way two thirds of that.
    const double each = model_ == EngineMixingModel::curl ? 1.0 : 1.5;
    pairs(poisson(random, each * times * static_cast<double>(n - 1)), random, gas);
  }
  for (std::size_t i = 0; i < n; ++i)
    if (isChanged_[i] != 0)
      gas.temperature[i] = thermo_.temperatureFromEnthalpy(enthalpy_[i], gas.Y(i), gas.temperature[i]);
  return volumeOf(thermo_, gas) - before;
}

void EngineMixing::exchange(double part, EngineGas& gas) {
  mean_.assign(gas.species + gas.scalars, 0);
  double mass = 0, enthalpy = 0;
  for (std::size_t i = 0; i < gas.count(); ++i) {
    mass += gas.mass[i];
    enthalpy += gas.mass[i] * enthalpy_[i];
    for (std::size_t k = 0; k < gas.species; ++k) mean_[k] += gas.mass[i] * gas.Y(i)[k];
    for (std::size_t s = 0; s < gas.scalars; ++s) mean_[gas.species + s] += gas.mass[i] * gas.amounts(i)[s];
  }
  for (std::size_t i = 0; i < gas.count(); ++i) {
    enthalpy_[i] += part * (enthalpy / mass - enthalpy_[i]);
    for (std::size_t k = 0; k < gas.species; ++k) gas.Y(i)[k] += part * (mean_[k] / mass - gas.Y(i)[k]);
    for (std::size_t s = 0; s < gas.scalars; ++s)
      gas.amounts(i)[s] += part * (mean_[gas.species + s] / mass - gas.amounts(i)[s]);
    isChanged_[i] = 1;
  }
}

// A pair by the sum of its masses: then the variance by mass decays as that of equal particles.
void EngineMixing::pairs(double events, RandomStream& random, EngineGas& gas) {
  const std::size_t n = gas.count();
  const double heaviest = *std::ranges::max_element(gas.mass);
  for (double event = 0; event < events; ++event) {
    std::size_t i = random.below(n);
    while (random.uniform() * heaviest > gas.mass[i]) i = random.below(n);
    std::size_t j = random.below(n - 1);
    if (j >= i) ++j;
    const double way = model_ == EngineMixingModel::curl ? 1.0 : random.uniform();
    const double both = gas.mass[i] + gas.mass[j], ofI = way * gas.mass[j] / both, ofJ = way * gas.mass[i] / both;
    const auto mix = [&](double& a, double& b) {
      const double apart = b - a;
      a += ofI * apart;
      b -= ofJ * apart;
    };
    mix(enthalpy_[i], enthalpy_[j]);
    for (std::size_t k = 0; k < gas.species; ++k) mix(gas.Y(i)[k], gas.Y(j)[k]);
    for (std::size_t s = 0; s < gas.scalars; ++s) mix(gas.amounts(i)[s], gas.amounts(j)[s]);
    isChanged_[i] = isChanged_[j] = 1;
  }
}

}  // namespace lampblack::chemistry
