#include "chemistry/reactor/reactor_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "chemistry/numerics/dot.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack {

ReactorSystem::ReactorSystem(const Mechanism& mechanism)
    : thermo_(mechanism),
      kinetics_(mechanism),
      weights_(mechanism.molecularWeights().begin(), mechanism.molecularWeights().end()) {
  for (const double W : weights_) {
    inverseWeights_.push_back(1.0 / W);
    gasConstants_.push_back(constants::gasConstant / W);
  }
  for (auto* work : {&source_, &c_, &wdot_, &energy_, &capacity_, &capacitySlope_, &excess_, &byT_, &common_})
    work->assign(weights_.size(), 0.0);
}

void ReactorSystem::setConditions(const Conditions& conditions) {
  conditions_ = conditions;
  if (conditions.source.empty())
    std::fill(source_.begin(), source_.end(), 0.0);
  else
    std::copy(conditions.source.begin(), conditions.source.end(), source_.begin());
  conditions_.source = {};
}

void ReactorSystem::setConditions(double pressure, std::span<const double> source) {
  Conditions conditions;
  conditions.value = pressure;
  conditions.source = source;
  setConditions(conditions);
}

bool ReactorSystem::refuse(std::string reason) {
  refusal_ = std::move(reason);
  return false;
}

bool ReactorSystem::accept(const double* f) {
  const std::size_t n = weights_.size();
  double sum = f[n];
  for (std::size_t k = 0; k < n; ++k) sum += f[k];
  return std::isfinite(sum) || refuse("rates that are not finite");
}

// Density, pressure and concentrations.
bool ReactorSystem::prepare(const double* y) {
  const std::size_t n = weights_.size();
  const double T = y[n];
  if (!(T >= Thermo::minTemperature && T <= Thermo::maxTemperature))
    return refuse(fmt::format("a temperature of {:.6g} K, outside {} to {} K", T, Thermo::minTemperature,
                              Thermo::maxTemperature));
  const double moles = dot(y, inverseWeights_.data(), n);
  if (!(moles > 0) || !std::isfinite(moles)) return refuse(fmt::format("{:.6g} moles a kilogram", moles));
  meanWeight_ = 1.0 / moles;
  const double massPerPressure = meanWeight_ / (constants::gasConstant * T);
  const bool pressureHeld = conditions_.held == Held::Pressure;
  density_ = pressureHeld ? conditions_.value * massPerPressure : conditions_.value;
  pressure_ = pressureHeld ? conditions_.value : conditions_.value / massPerPressure;
  const double rho = density_;
  const double* __restrict inverse = inverseWeights_.data();
  double* __restrict c = c_.data();
  for (std::size_t k = 0; k < n; ++k) c[k] = y[k] * rho * inverse[k];
  return true;
}

// What dT/dt weighs the change of composition with, and the heat capacity that goes with it.
void ReactorSystem::speciesEnergies(double T) {
  thermo_.speciesEnthalpies(T, energy_);
  thermo_.speciesCp(T, capacity_);
  if (conditions_.held == Held::Pressure) return;
  for (std::size_t k = 0; k < weights_.size(); ++k) {
    energy_[k] -= gasConstants_[k] * T;
    capacity_[k] -= gasConstants_[k];
  }
}

bool ReactorSystem::chemicalRates(const double* y, double* f) {
  if (!prepare(y)) return false;
  const std::size_t n = weights_.size();
  try {
    kinetics_.netProductionRates(y[n], c_, wdot_);
  } catch (const NumericsError& error) {
    return refuse(error.what());
  }
  const double volume = 1.0 / density_;
  for (std::size_t k = 0; k < n; ++k) f[k] = wdot_[k] * weights_[k] * volume;
  return true;
}

// dT/dt from the finished dY/dt in f and speciesEnergies().
double ReactorSystem::temperatureSlope(const double* y, const double* f) {
  if (conditions_.energy == Energy::GivenTemperature) return conditions_.temperatureRate;
  const std::size_t n = weights_.size();
  double supply = conditions_.heating;
  if (conditions_.removal != 0) supply -= conditions_.removal * dot(energy_.data(), y, n);
  return (supply - dot(energy_.data(), f, n)) / dot(capacity_.data(), y, n);
}

bool ReactorSystem::rates(const double* y, double* f) {
  if (!chemicalRates(y, f)) return false;
  const std::size_t n = weights_.size();
  const double removal = conditions_.removal;
  for (std::size_t k = 0; k < n; ++k) f[k] += source_[k] - removal * y[k];
  if (conditions_.energy == Energy::Conserved) speciesEnergies(y[n]);
  f[n] = temperatureSlope(y, f);
  return accept(f);
}

}  // namespace lampblack
