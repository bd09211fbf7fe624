#include "chemistry/reactor/plug_flow.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lampblack {

namespace {

// The carried temperature of a given profile must not steer the steps.
constexpr double kIgnored = 1e30;

}  // namespace

PlugFlow::PlugFlow(const Mechanism& mechanism, const GasState& inlet, double massFlux, double length,
                   std::optional<TemperatureProfile> profile)
    : mechanism_(mechanism),
      inlet_(inlet),
      massFlux_(massFlux),
      profile_(std::move(profile)),
      species_(mechanism.numSpecies()),
      thermo_(mechanism),
      system_(mechanism),
      y_(species_ + 1),
      f_(species_ + 1) {
  if (profile_) inlet_.temperature = profile_->value(0.0);
  timeScale_ = length * density(initialState().data()) / massFlux_;
  ReactorSystem::Conditions conditions;
  conditions.value = inlet_.pressure;
  if (profile_) conditions.energy = ReactorSystem::Energy::GivenTemperature;
  system_.setConditions(conditions);
}

std::vector<double> PlugFlow::initialState() const {
  std::vector<double> y = inlet_.Y;
  y.push_back(inlet_.temperature);
  y.push_back(0.0);
  return y;
}

double PlugFlow::density(const double* y) const {
  return thermo_.density(y[species_], inlet_.pressure, {y, species_});
}

void PlugFlow::takeState(double z, const double* y) {
  std::copy_n(y, species_ + 1, y_.begin());
  if (profile_) y_[species_] = profile_->value(z);
}

bool PlugFlow::rates(double z, const double* y, double* f) {
  takeState(z, y);
  if (!system_.rates(y_.data(), f)) return false;
  const double timePerLength = system_.density() / massFlux_;
  for (std::size_t i = 0; i <= species_; ++i) f[i] *= timePerLength;
  if (profile_) f[species_] = profile_->slope(z);
  f[species_ + 1] = timePerLength;
  return true;
}

// With d ln rho/dY_j = -Wbar/W_j, d ln rho/dT = -1/T: d((rho/G) f_i)/dy_j = (rho/G)(d f_i/dy_j + f_i d ln rho/dy_j).
bool PlugFlow::jacobian(double z, const double* y, double* f, double* J, std::size_t ld) {
  takeState(z, y);
  if (!system_.jacobian(y_.data(), f_.data(), J, ld)) return false;
  const std::size_t n = species_;
  const double timePerLength = system_.density() / massFlux_;
  const double Wbar = thermo_.meanMolecularWeight({y_.data(), n});
  for (std::size_t j = 0; j <= n; ++j) {
    double* column = J + j * ld;
    const double slope = j < n ? -Wbar / mechanism_.molecularWeights()[j] : -1.0 / y_[n];
    for (std::size_t i = 0; i <= n; ++i) column[i] = timePerLength * (column[i] + f_[i] * slope);
    column[n + 1] = timePerLength * slope;
  }
  std::fill_n(J + (n + 1) * ld, n + 2, 0.0);
  if (profile_) {
    std::fill_n(J + n * ld, n + 2, 0.0);
    for (std::size_t j = 0; j <= n; ++j) J[n + j * ld] = 0.0;
  }
  for (std::size_t i = 0; i <= n; ++i) f[i] = timePerLength * f_[i];
  if (profile_) f[n] = profile_->slope(z);
  f[n + 1] = timePerLength;
  return true;
}

void PlugFlow::prescribe(double z, double* y) const {
  if (profile_) y[species_] = profile_->value(z);
}

double PlugFlow::toleranceScale(std::size_t i) const {
  if (i == species_ + 1) return 1e6 * timeScale_;
  return profile_ && i == species_ ? kIgnored : 1.0;
}

std::string PlugFlow::describe(double z, const double* y) const {
  return fmt::format("z = {:.6g} m, T = {:.6g} K, p = {:.6g} Pa, mass fractions {{{}}}", z, y[species_],
                     inlet_.pressure, compositionText(mechanism_, {y, species_}));
}

}  // namespace lampblack
