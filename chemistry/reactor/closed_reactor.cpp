#include "chemistry/reactor/closed_reactor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/constants.hpp"

namespace lampblack::chemistry {

namespace {

std::vector<StoichiometricTerm> netStoichiometry(const Reaction& reaction) {
  std::map<std::size_t, double> net;
  for (const auto& term : reaction.products) net[term.species] += term.coefficient;
  for (const auto& term : reaction.reactants) net[term.species] -= term.coefficient;
  std::vector<StoichiometricTerm> terms;
  for (const auto& [species, coefficient] : net)
    if (coefficient != 0) terms.push_back({species, coefficient});
  return terms;
}

}  // namespace

ClosedReactor::ClosedReactor(const Mechanism& mechanism, const GasState& initial, ReactorSystem::Held held,
                             std::optional<TemperatureProfile> profile, CarriedPhase* carried,
                             std::optional<VolumeLaw> volume)
    : mechanism_(mechanism),
      profile_(std::move(profile)),
      volume_(std::move(volume)),
      thermo_(mechanism),
      system_(mechanism, carried),
      kinetics_(mechanism),
      y_(system_.size()),
      rates_(system_.size()),
      concentrations_(mechanism.numSpecies()),
      progress_(mechanism.numReactions()),
      reverse_(mechanism.numReactions()),
      energy_(mechanism.numSpecies()) {
  conditions_.held = held;
  if (profile_) conditions_.energy = ReactorSystem::Energy::GivenTemperature;
  startFrom(initial);
}

void ClosedReactor::startFrom(const GasState& initial) {
  initial_ = initial;
  if (profile_) initial_.temperature = profile_->value(0.0);
  startDensity_ = thermo_.density(initial_.temperature, initial_.pressure, initial_.Y);
  conditions_.value = conditions_.held == ReactorSystem::Held::Pressure ? initial_.pressure : startDensity_;
  system_.setConditions(conditions_);
}

std::vector<double> ClosedReactor::initialState() const {
  return unknownsOf(initial_, system_.numCarried());
}

std::vector<double> unknownsOf(const GasState& state, std::size_t carried) {
  std::vector<double> y = state.Y;
  y.push_back(state.temperature);
  y.insert(y.end(), state.carried.begin(), state.carried.end());
  y.resize(state.Y.size() + 1 + carried, 0.0);
  return y;
}

double ClosedReactor::density(double t, const double* y) const {
  if (conditions_.held == ReactorSystem::Held::Density) return heldDensity(t);
  const std::size_t n = mechanism_.numSpecies();
  return thermo_.density(y[n], conditions_.value, {y, n});
}

double ClosedReactor::pressure(double t, const double* y) const {
  if (conditions_.held == ReactorSystem::Held::Pressure) return conditions_.value;
  double moles = 0;
  const auto W = mechanism_.molecularWeights();
  for (std::size_t k = 0; k < W.size(); ++k) moles += y[k] / W[k];
  return heldDensity(t) * moles * constants::gasConstant * y[W.size()];
}

double ClosedReactor::heatRelease(double t, const double* y) {
  const std::size_t n = mechanism_.numSpecies();
  y = at(t, y);
  if (!system_.chemicalRates(y, rates_.data())) return std::nan("");
  thermo_.speciesEnthalpies(y[n], energy_);
  double heat = 0;
  for (std::size_t k = 0; k < n; ++k) heat -= energy_[k] * rates_[k];
  return heat * system_.density();
}

// With a profile the temperature in y is carried along only; the rates take the given one.
const double* ClosedReactor::at(double t, const double* y) {
  if (!profile_ && !volume_) return y;
  if (volume_) {
    conditions_.value = heldDensity(t);
    conditions_.expansion = volume_->expansion(t);
  }
  if (profile_) conditions_.temperatureRate = profile_->slope(t);
  system_.setConditions(conditions_);
  if (!profile_) return y;
  std::copy_n(y, y_.size(), y_.begin());
  y_[mechanism_.numSpecies()] = profile_->value(t);
  return y_.data();
}

bool ClosedReactor::rates(double t, const double* y, double* f) {
  return system_.rates(at(t, y), f);
}

bool ClosedReactor::jacobian(double t, const double* y, double* f, double* J, std::size_t ld) {
  if (!system_.jacobian(at(t, y), f, J, ld)) return false;
  if (profile_) std::fill_n(J + mechanism_.numSpecies() * ld, size(), 0.0);
  return true;
}

void ClosedReactor::prescribe(double t, double* y) const {
  if (profile_) y[mechanism_.numSpecies()] = profile_->value(t);
}

double ClosedReactor::toleranceScale(std::size_t i) const {
  return reactorToleranceScale(i, mechanism_.numSpecies(), profile_.has_value());
}

std::string ClosedReactor::describe(double t, const double* y) const {
  const std::size_t n = mechanism_.numSpecies();
  return fmt::format("t = {:.6g} s, T = {:.6g} K, p = {:.6g} Pa, mass fractions {{{}}}", t, y[n], pressure(t, y),
                     compositionText(mechanism_, {y, n}));
}

void ClosedReactor::setParameters(std::vector<std::size_t> reactions) {
  parameters_.clear();
  for (const std::size_t r : reactions) parameters_.push_back({r, netStoichiometry(mechanism_.reaction(r))});
}

bool ClosedReactor::prepareParameters(double t, const double* y) {
  y = at(t, y);
  const std::size_t n = mechanism_.numSpecies();
  const double T = y[n];
  const auto W = mechanism_.molecularWeights();
  density_ = density(t, y);
  for (std::size_t k = 0; k < n; ++k) concentrations_[k] = y[k] * density_ / W[k];
  kinetics_.ratesOfProgress(T, concentrations_, progress_, reverse_);
  for (std::size_t r = 0; r < progress_.size(); ++r) progress_[r] -= reverse_[r];
  thermo_.speciesEnthalpies(T, energy_);
  capacity_ = thermo_.cpMass(T, {y, n});
  if (conditions_.held == ReactorSystem::Held::Density)
    for (std::size_t k = 0; k < n; ++k) {
      energy_[k] -= constants::gasConstant / W[k] * T;
      capacity_ -= constants::gasConstant / W[k] * y[k];
    }
  return std::isfinite(capacity_);
}

// d(dY_k/dt)/d ln k_r = W_k nu_kr q_r / rho, and what it does to dT/dt at constant enthalpy or energy.
void ClosedReactor::addByParameter(std::size_t parameter, double* f) const {
  const auto W = mechanism_.molecularWeights();
  const double q = progress_[parameters_[parameter].reaction] / density_;
  double heat = 0;
  for (const auto& term : parameters_[parameter].net) {
    const double change = W[term.species] * term.coefficient * q;
    f[term.species] += change;
    heat += energy_[term.species] * change;
  }
  if (!profile_) f[W.size()] -= heat / capacity_;
}

std::string compositionText(const Mechanism& mechanism, std::span<const double> Y) {
  std::string text;
  for (std::size_t k = 0; k < Y.size(); ++k)
    if (!(std::abs(Y[k]) <= 1e-6))
      text += fmt::format("{}{}: {:.6g}", text.empty() ? "" : ", ", mechanism.speciesName(k), Y[k]);
  return text;
}

}  // namespace lampblack::chemistry
