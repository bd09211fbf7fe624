#include "chemistry/thermo.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack {

Thermo::Thermo(const Mechanism& mechanism)
    : table_(mechanism.allSpecies()),
      weights_(mechanism.molecularWeights().begin(), mechanism.molecularWeights().end()),
      work_(weights_.size()) {
  for (const double W : weights_) {
    inverseWeights_.push_back(1.0 / W);
    gasConstants_.push_back(constants::gasConstant / W);
  }
}

double Thermo::meanMolecularWeight(std::span<const double> Y) const {
  double moles = 0;
  for (std::size_t k = 0; k < weights_.size(); ++k) moles += Y[k] * inverseWeights_[k];
  return 1.0 / moles;
}

double Thermo::density(double T, double p, std::span<const double> Y) const {
  return p * meanMolecularWeight(Y) / (constants::gasConstant * T);
}

void Thermo::speciesEnthalpies(double T, std::span<double> h) const {
  table_.enthalpyOverRT(T, h.data());
  for (std::size_t k = 0; k < weights_.size(); ++k) h[k] *= gasConstants_[k] * T;
}

void Thermo::speciesCp(double T, std::span<double> cp) const {
  table_.cpOverR(T, cp.data());
  for (std::size_t k = 0; k < weights_.size(); ++k) cp[k] *= gasConstants_[k];
}

void Thermo::speciesCpSlope(double T, std::span<double> slope) const {
  table_.cpSlopeOverR(T, slope.data());
  for (std::size_t k = 0; k < weights_.size(); ++k) slope[k] *= gasConstants_[k];
}

double Thermo::cpMass(double T, std::span<const double> Y) const {
  speciesCp(T, work_);
  double cp = 0;
  for (std::size_t k = 0; k < weights_.size(); ++k) cp += Y[k] * work_[k];
  return cp;
}

double Thermo::enthalpyMass(double T, std::span<const double> Y) const {
  speciesEnthalpies(T, work_);
  double h = 0;
  for (std::size_t k = 0; k < weights_.size(); ++k) h += Y[k] * work_[k];
  return h;
}

double Thermo::temperatureFromEnthalpy(double h, std::span<const double> Y, double guess) const {
  double low = minTemperature, high = maxTemperature;
  double T = guess > low && guess < high ? guess : 1000.0;
  bool lowChecked = false, highChecked = false;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const double difference = enthalpyMass(T, Y) - h;
    if (!std::isfinite(difference)) break;
    if (difference > 0) {
      high = T;
      highChecked = true;
    } else {
      low = T;
      lowChecked = true;
    }
    const double cp = cpMass(T, Y);
    double next = T - difference / cp;
    if (!(cp > 0) || !(next > low && next < high)) {
      // A step out of the bracket: see first whether the bracket's end really is one, then halve it.
      if (!lowChecked && enthalpyMass(low, Y) > h) break;
      if (!highChecked && enthalpyMass(high, Y) < h) break;
      lowChecked = highChecked = true;
      if (std::abs(next - T) <= 1e-13 * T) return T;
      next = 0.5 * (low + high);
    }
    if (std::abs(next - T) <= 1e-13 * T || high - low <= 1e-13 * T) return next;
    T = next;
  }
  throw NumericsError(fmt::format("no temperature between {} and {} K gives the enthalpy {:.6g} J/kg (guess {:.6g} K)",
                                  minTemperature, maxTemperature, h, guess));
}

void Thermo::massToMole(std::span<const double> Y, std::span<double> X) const {
  double moles = 0;
  for (std::size_t k = 0; k < weights_.size(); ++k) moles += Y[k] * inverseWeights_[k];
  const double factor = 1.0 / moles;
  for (std::size_t k = 0; k < weights_.size(); ++k) X[k] = Y[k] * inverseWeights_[k] * factor;
}

void Thermo::moleToMass(std::span<const double> X, std::span<double> Y) const {
  double mass = 0;
  for (std::size_t k = 0; k < weights_.size(); ++k) mass += X[k] * weights_[k];
  const double factor = 1.0 / mass;
  for (std::size_t k = 0; k < weights_.size(); ++k) Y[k] = X[k] * weights_[k] * factor;
}

}  // namespace lampblack
