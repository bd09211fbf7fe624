#include "chemistry/reactor/reactor_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "numerics/dot.hpp"

namespace lampblack::chemistry {

ReactorSystem::ReactorSystem(const Mechanism& mechanism, CarriedPhase* carried, double leastFraction)
    : thermo_(mechanism),
      kinetics_(mechanism),
      leastFraction_(leastFraction),
      weights_(mechanism.molecularWeights().begin(), mechanism.molecularWeights().end()),
      carried_(carried) {
  for (const double W : weights_) {
    inverseWeights_.push_back(1.0 / W);
    gasConstants_.push_back(constants::gasConstant / W);
  }
  for (auto* work : {&source_, &loss_, &c_, &wdot_, &energy_, &capacity_, &capacitySlope_, &excess_, &byT_, &common_})
    work->assign(weights_.size(), 0.0);
  if (carried_ == nullptr) return;
  for (auto* work : {&carriedSource_, &carriedDensity_, &carriedRates_, &carriedEnergy_, &carriedCapacity_})
    work->assign(carried_->size(), 0.0);
  const std::size_t rows = carried_->size() + carried_->exchanged().size();
  exchange_.assign(carried_->exchanged().size(), 0.0);
  carriedJacobian_.assign(rows * (rows + 1), 0.0);
}

double reactorToleranceScale(std::size_t i, std::size_t species, bool temperatureIsGiven) {
  if (i > species) return 1e4;
  return i == species && temperatureIsGiven ? 1e30 : 1.0;
}

void ReactorSystem::setConditions(const Conditions& conditions) {
  conditions_ = conditions;
  if (conditions.source.empty())
    std::fill(source_.begin(), source_.end(), 0.0);
  else
    std::copy(conditions.source.begin(), conditions.source.end(), source_.begin());
  std::fill(loss_.begin(), loss_.end(), 0.0);
  std::copy(conditions.loss.begin(), conditions.loss.end(), loss_.begin());
  std::fill(carriedSource_.begin(), carriedSource_.end(), 0.0);
  std::copy(conditions.carriedSource.begin(), conditions.carriedSource.end(), carriedSource_.begin());
  conditions_.source = conditions_.carriedSource = conditions_.loss = {};
}

void ReactorSystem::setConditions(double pressure, std::span<const double> source, double heating, double rateFactor) {
  Conditions conditions;
  conditions.value = pressure;
  conditions.source = source;
  conditions.heating = heating;
  conditions.rateFactor = rateFactor;
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
  for (std::size_t s = n + 1; s < size(); ++s) sum += f[s];
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
  const double rho = density_, least = leastFraction_;
  const double* __restrict inverse = inverseWeights_.data();
  double* __restrict c = c_.data();
  for (std::size_t k = 0; k < n; ++k) c[k] = std::max(y[k], least) * rho * inverse[k];
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

void ReactorSystem::scaleRates(std::span<double> values) const {
  if (conditions_.rateFactor == 1) return;
  for (double& value : values) value *= conditions_.rateFactor;
}

bool ReactorSystem::chemicalRates(const double* y, double* f) {
  if (!prepare(y)) return false;
  const std::size_t n = weights_.size();
  try {
    if (conditions_.reacts)
      kinetics_.netProductionRates(y[n], c_, wdot_);
    else
      std::fill(wdot_.begin(), wdot_.end(), 0.0);
  } catch (const NumericsError& error) {
    return refuse(error.what());
  }
  scaleRates(wdot_);
  const double volume = 1.0 / density_;
  for (std::size_t k = 0; k < n; ++k) f[k] = wdot_[k] * weights_[k] * volume;
  return true;
}

// dT/dt from the finished dY/dt in f and speciesEnergies().
double ReactorSystem::temperatureSlope(const double* y, const double* f) {
  if (conditions_.energy == Energy::GivenTemperature) return conditions_.temperatureRate;
  const std::size_t n = weights_.size();
  double supply = conditions_.heating - conditions_.expansion * pressure_ / density_;
  if (conditions_.removal != 0) supply -= conditions_.removal * dot(energy_.data(), y, n);
  if (carried_ != nullptr) {
    const std::size_t count = numCarried();
    supply -= conditions_.removal * dot(carriedEnergy_.data(), y + n + 1, count);
    supply -= dot(carriedEnergy_.data(), f + n + 1, count);
  }
  return (supply - dot(energy_.data(), f, n)) / heatCapacity(y);
}

// J/kg/K
double ReactorSystem::heatCapacity(const double* y) const {
  const std::size_t n = weights_.size();
  const double gas = dot(capacity_.data(), y, n);
  return carried_ == nullptr ? gas : gas + dot(carriedCapacity_.data(), y + n + 1, numCarried());
}

bool ReactorSystem::rates(const double* y, double* f) {
  if (!chemicalRates(y, f)) return false;
  const std::size_t n = weights_.size();
  const double removal = conditions_.removal;
  for (std::size_t k = 0; k < n; ++k) f[k] += source_[k] - (removal + loss_[k]) * y[k];
  if (carried_ != nullptr && !addCarriedRates(y, f)) return false;
  if (conditions_.energy == Energy::Conserved) speciesEnergies(y[n]);
  f[n] = temperatureSlope(y, f);
  return accept(f);
}

}  // namespace lampblack::chemistry
