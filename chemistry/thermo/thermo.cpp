#include "chemistry/thermo/thermo.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "numerics/dot.hpp"

namespace lampblack::chemistry {

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
  return 1.0 / dot(Y.data(), inverseWeights_.data(), weights_.size());
}

double Thermo::density(double T, double p, std::span<const double> Y) const {
  return p * meanMolecularWeight(Y) / (constants::gasConstant * T);
}

void Thermo::speciesEnthalpies(double T, std::span<double> h) const {
  table_.enthalpyOverRT(T, h.data());
  for (std::size_t k = 0; k < weights_.size(); ++k) h[k] *= gasConstants_[k] * T;
}

void Thermo::speciesInternalEnergies(double T, std::span<double> u) const {
  table_.enthalpyOverRT(T, u.data());
  for (std::size_t k = 0; k < weights_.size(); ++k) u[k] = (u[k] - 1.0) * gasConstants_[k] * T;
}

void Thermo::speciesEntropies(double T, std::span<double> s) const {
  table_.entropyOverR(T, std::log(T), s.data());
  for (std::size_t k = 0; k < weights_.size(); ++k) s[k] *= gasConstants_[k];
}

void Thermo::speciesGibbs(double T, std::span<double> g) const {
  table_.gibbsOverRT(T, std::log(T), g.data());
  for (std::size_t k = 0; k < weights_.size(); ++k) g[k] *= gasConstants_[k] * T;
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
  return dot(Y.data(), work_.data(), weights_.size());
}

double Thermo::enthalpyMass(double T, std::span<const double> Y) const {
  speciesEnthalpies(T, work_);
  return dot(Y.data(), work_.data(), weights_.size());
}

double Thermo::cvMass(double T, std::span<const double> Y) const {
  return cpMass(T, Y) - constants::gasConstant / meanMolecularWeight(Y);
}

double Thermo::internalEnergyMass(double T, std::span<const double> Y) const {
  return enthalpyMass(T, Y) - constants::gasConstant * T / meanMolecularWeight(Y);
}

double Thermo::entropyMass(double T, double p, std::span<const double> Y) const {
  speciesEntropies(T, work_);
  const double molesToFraction = meanMolecularWeight(Y);
  const double lnp = std::log(p / constants::oneAtmosphere);
  double s = 0;
  for (std::size_t k = 0; k < weights_.size(); ++k) {
    const double X = Y[k] * inverseWeights_[k] * molesToFraction;
    s += Y[k] * (work_[k] - gasConstants_[k] * lnp);
    if (X > 0) s -= Y[k] * gasConstants_[k] * std::log(X);
  }
  return s;
}

// Newton's method in a bracket that only shrinks.
template <class Value, class Slope>
double Thermo::invert(const Value& value, const Slope& slope, double target, double guess, const char* what) const {
  double low = minTemperature, high = maxTemperature;
  double T = guess > low && guess < high ? guess : 1000.0;
  bool lowChecked = false, highChecked = false;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const double difference = value(T) - target;
    if (!std::isfinite(difference)) break;
    if (difference > 0) {
      high = T;
      highChecked = true;
    } else {
      low = T;
      lowChecked = true;
    }
    const double byT = slope(T);
    double next = T - difference / byT;
    if (!(byT > 0) || !(next > low && next < high)) {
      // A step out of the bracket: see first whether the bracket's end really is one, then halve it.
      if (!lowChecked && value(low) > target) break;
      if (!highChecked && value(high) < target) break;
      lowChecked = highChecked = true;
      if (std::abs(next - T) <= 1e-13 * T) return T;
      next = 0.5 * (low + high);
    }
    if (std::abs(next - T) <= 1e-13 * T || high - low <= 1e-13 * T) return next;
    T = next;
  }
  throw NumericsError(fmt::format("no temperature between {} and {} K gives the {} {:.6g} J/kg (guess {:.6g} K)",
                                  minTemperature, maxTemperature, what, target, guess));
}

double Thermo::temperatureFromEnthalpy(double h, std::span<const double> Y, double guess) const {
  if (table_.hasMixtures()) {
    for (std::size_t k = 0; k < weights_.size(); ++k) work_[k] = Y[k] * gasConstants_[k];
    MixturePolynomial mixture;
    const auto around = [&](double T) -> const MixturePolynomial& {
      if (!mixture.holds(T)) mixture = table_.mixture(T, work_.data());
      return mixture;
    };
    const double T = invert([&](double at) { return around(at).enthalpy(at); },
                            [&](double at) { return around(at).heatCapacity(at); }, h, guess, "enthalpy");
    // Where polynomials jump, on the side that was found to have this enthalpy, whatever round-off adds.
    return T > mixture.upTo && T - mixture.upTo <= 1e-12 * T ? mixture.upTo : T;
  }
  return invert([&](double T) { return enthalpyMass(T, Y); }, [&](double T) { return cpMass(T, Y); }, h, guess,
                "enthalpy");
}

double Thermo::temperatureFromInternalEnergy(double u, std::span<const double> Y, double guess) const {
  return invert([&](double T) { return internalEnergyMass(T, Y); }, [&](double T) { return cvMass(T, Y); }, u, guess,
                "internal energy");
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

}  // namespace lampblack::chemistry
