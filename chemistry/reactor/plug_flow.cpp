#include "chemistry/reactor/plug_flow.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lampblack::chemistry {

PlugFlow::PlugFlow(const Mechanism& mechanism, const GasState& inlet, double massFlux, double length,
                   std::optional<TemperatureProfile> profile, CarriedPhase* carried)
    : mechanism_(mechanism),
      inlet_(inlet),
      massFlux_(massFlux),
      profile_(std::move(profile)),
      species_(mechanism.numSpecies()),
      thermo_(mechanism),
      system_(mechanism, carried),
      y_(system_.size()),
      f_(system_.size()) {
  if (profile_) inlet_.temperature = profile_->value(0.0);
  timeScale_ = length * density(initialState().data()) / massFlux_;
  ReactorSystem::Conditions conditions;
  conditions.value = inlet_.pressure;
  if (profile_) conditions.energy = ReactorSystem::Energy::GivenTemperature;
  system_.setConditions(conditions);
}

std::vector<double> PlugFlow::initialState() const {
  std::vector<double> y = unknownsOf(inlet_, system_.numCarried());
  y.push_back(0.0);
  return y;
}

double PlugFlow::density(const double* y) const {
  return thermo_.density(y[species_], inlet_.pressure, {y, species_});
}

void PlugFlow::takeState(double z, const double* y) {
  std::copy_n(y, system_.size(), y_.begin());
  if (profile_) y_[species_] = profile_->value(z);
}

bool PlugFlow::rates(double z, const double* y, double* f) {
  takeState(z, y);
  if (!system_.rates(y_.data(), f)) return false;
  const double timePerLength = system_.density() / massFlux_;
  for (std::size_t i = 0; i < system_.size(); ++i) f[i] *= timePerLength;
  if (profile_) f[species_] = profile_->slope(z);
  f[system_.size()] = timePerLength;
  return true;
}

// With d ln rho/dY_j = -Wbar/W_j, d ln rho/dT = -1/T: d((rho/G) f_i)/dy_j = (rho/G)(d f_i/dy_j + f_i d ln rho/dy_j).
bool PlugFlow::jacobian(double z, const double* y, double* f, double* J, std::size_t ld) {
  takeState(z, y);
  if (!system_.jacobian(y_.data(), f_.data(), J, ld)) return false;
  const std::size_t n = species_, m = system_.size();
  const double timePerLength = system_.density() / massFlux_;
  const double Wbar = thermo_.meanMolecularWeight({y_.data(), n});
  for (std::size_t j = 0; j < m; ++j) {
    double* column = J + j * ld;
    const double slope = j > n ? 0.0 : j < n ? -Wbar / mechanism_.molecularWeights()[j] : -1.0 / y_[n];
    for (std::size_t i = 0; i < m; ++i) column[i] = timePerLength * (column[i] + f_[i] * slope);
    column[m] = timePerLength * slope;
  }
  std::fill_n(J + m * ld, m + 1, 0.0);
  if (profile_) {
    std::fill_n(J + n * ld, m + 1, 0.0);
    for (std::size_t j = 0; j < m; ++j) J[n + j * ld] = 0.0;
  }
  for (std::size_t i = 0; i < m; ++i) f[i] = timePerLength * f_[i];
  if (profile_) f[n] = profile_->slope(z);
  f[m] = timePerLength;
  return true;
}

void PlugFlow::prescribe(double z, double* y) const {
  if (profile_) y[species_] = profile_->value(z);
}

double PlugFlow::toleranceScale(std::size_t i) const {
  if (i == system_.size()) return 1e6 * timeScale_;
  return reactorToleranceScale(i, species_, profile_.has_value());
}

std::string PlugFlow::describe(double z, const double* y) const {
  return fmt::format("z = {:.6g} m, T = {:.6g} K, p = {:.6g} Pa, mass fractions {{{}}}", z, y[species_],
                     inlet_.pressure, compositionText(mechanism_, {y, species_}));
}

}  // namespace lampblack::chemistry
