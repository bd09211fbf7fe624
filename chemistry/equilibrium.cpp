#include "chemistry/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chemistry/thermo.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack {
namespace {

constexpr double firstTemperature = 2500.0;  // K, of the search for an enthalpy: dissociated enough to start easily
constexpr double largestChange = 0.3;        // of temperature in one step of that search
constexpr double smallestChange = 1e-11;

}  // namespace

Equilibrium::Equilibrium(const Mechanism& mechanism)
    : mechanism_(mechanism), thermo_(mechanism.allSpecies()), amounts_(mechanism.numSpecies()) {
  for (auto* array : {&gibbs_, &enthalpies_, &cp_}) array->resize(mechanism.numSpecies());
}

std::string Equilibrium::state(double T, std::span<const double> Y) const {
  std::string text =
      fmt::format("{:.6g} K, {:.6g} Pa, mass fractions", T, constants::oneAtmosphere * std::exp(lnPressure_));
  for (std::size_t k = 0; k < Y.size(); ++k)
    if (Y[k] != 0) text += fmt::format(" {}: {:.9g}", mechanism_.speciesName(k), Y[k]);
  return text;
}

// Takes over the elements of Y and allows the species that can be made of them.
void Equilibrium::begin(double T, double p, std::span<const double> Y) {
  lnPressure_ = std::log(p / constants::oneAtmosphere);
  given_.assign(Y.begin(), Y.end());
  const auto W = mechanism_.molecularWeights();
  double moles = 0;
  mass_ = 0;
  for (std::size_t k = 0; k < amounts_.size(); ++k) {
    amounts_[k] = std::isfinite(Y[k]) ? std::max(Y[k], 0.0) / W[k] : NAN;
    moles += amounts_[k];
  }
  if (!(T > 0 && p > 0 && moles > 0 && std::isfinite(T + p + moles)))
    throw NumericsError("no equilibrium of the state " + state(T, Y));
  for (std::size_t k = 0; k < amounts_.size(); ++k) {
    amounts_[k] /= moles;
    mass_ += amounts_[k] * W[k];
  }
  allowed_.assign(amounts_.size(), true);
  for (std::size_t e = 0; e < mechanism_.numElements(); ++e) {
    // An element of which there is none; ions have negative numbers of electrons, and none in sum is no lack of them.
    bool present = false;
    for (std::size_t k = 0; k < amounts_.size(); ++k)
      present = present || mechanism_.atoms(k, e) < 0 || mechanism_.atoms(k, e) * amounts_[k] > 0;
    if (present) continue;
    for (std::size_t k = 0; k < amounts_.size(); ++k)
      if (mechanism_.atoms(k, e) > 0) allowed_[k] = false;
  }
  setActiveSpecies();
}

// Hands the allowed species to the path. It starts from a mixture in which each has the share of its scarcest element,
// divided by their number: not more than there is of any element, and positive for all.
void Equilibrium::setActiveSpecies() {
  active_.clear();
  for (std::size_t k = 0; k < amounts_.size(); ++k)
    if (allowed_[k]) active_.push_back(k);
  const std::size_t n = active_.size(), elements = mechanism_.numElements();
  std::vector<double> atoms(elements * n);
  for (std::size_t e = 0; e < elements; ++e)
    for (std::size_t j = 0; j < n; ++j) atoms[e * n + j] = mechanism_.atoms(active_[j], e);
  start_.assign(n, 1.0);
  for (std::size_t e = 0; e < elements; ++e) {
    double total = 0;
    bool counted = true;
    for (std::size_t j = 0; j < n; ++j) {
      total += atoms[e * n + j] * amounts_[active_[j]];
      counted = counted && atoms[e * n + j] >= 0;
    }
    if (!counted) continue;
    for (std::size_t j = 0; j < n; ++j)
      if (atoms[e * n + j] > 0) start_[j] = std::min(start_[j], total / atoms[e * n + j]);
  }
  for (double& v : start_) v = std::log(v / static_cast<double>(n));
  g_.resize(n);
  for (std::size_t j = 0; j < n; ++j) g_[j] = amounts_[active_[j]];
  path_.setMixture(elements, std::move(atoms), g_);
  path_.startFrom(start_);
  h_.resize(n);
  derivative_.resize(n);
}

void Equilibrium::excludeSpecies() {
  for (const std::size_t j : path_.excluded()) allowed_[active_[j]] = false;
  setActiveSpecies();
}

// Brings the mixture to equilibrium at T and the pressure.
void Equilibrium::moveTo(double T) {
  thermo_.gibbsOverRT(T, std::log(T), gibbs_.data());
  for (;;) {
    for (std::size_t j = 0; j < active_.size(); ++j) g_[j] = gibbs_[active_[j]] + lnPressure_;
    switch (path_.follow(g_)) {
      case EquilibriumPath::Outcome::Found:
        return;
      case EquilibriumPath::Outcome::SpeciesExcluded:
        excludeSpecies();
        break;
      case EquilibriumPath::Outcome::Lost:
        throw NumericsError(
            fmt::format("the equilibrium was not found in {} iterations: {}", path_.iterations(), state(T, given_)));
    }
  }
}

double Equilibrium::enthalpyMass(double T) {
  thermo_.enthalpyOverRT(T, enthalpies_.data());
  double sum = 0;
  for (std::size_t j = 0; j < active_.size(); ++j) {
    h_[j] = enthalpies_[active_[j]];
    sum += std::exp(path_.lnAmounts()[j]) * h_[j];
  }
  return sum * constants::gasConstant * T / mass_;
}

// Of the mixture that stays in equilibrium, at constant pressure; after enthalpyMass. d(G/RT)/dT = -H/(R T^2).
double Equilibrium::heatCapacityMass(double T) {
  thermo_.cpOverR(T, cp_.data());
  for (std::size_t j = 0; j < active_.size(); ++j) g_[j] = -h_[j];
  path_.sensitivity(g_, derivative_);
  double sum = 0;
  for (std::size_t j = 0; j < active_.size(); ++j)
    sum += std::exp(path_.lnAmounts()[j]) * (cp_[active_[j]] + h_[j] * derivative_[j]);
  return sum * constants::gasConstant / mass_;
}

void Equilibrium::writeMassFractions(std::span<double> Y) const {
  constexpr double leastLn = -700;  // below it the amounts are no longer numbers
  std::fill(Y.begin(), Y.end(), 0.0);
  double sum = 0;
  for (std::size_t j = 0; j < active_.size(); ++j) {
    const std::size_t k = active_[j];
    if (path_.lnAmounts()[j] > leastLn) Y[k] = std::exp(path_.lnAmounts()[j]) * mechanism_.molecularWeights()[k];
    sum += Y[k];
  }
  for (double& y : Y) y /= sum;
}

void Equilibrium::atTemperature(double T, double p, std::span<double> Y) {
  begin(T, p, Y);
  moveTo(T);
  writeMassFractions(Y);
}

double Equilibrium::atEnthalpy(double h, double p, std::span<double> Y) {
  // Newton's method in a bracket that shrinks: the enthalpy of equilibrium rises with temperature.
  double low = Thermo::minTemperature, high = Thermo::maxTemperature, T = firstTemperature;
  begin(T, p, Y);
  for (int iteration = 0; iteration < 200; ++iteration) {
    moveTo(T);
    const double difference = enthalpyMass(T) - h;
    if (!std::isfinite(difference)) break;
    if (difference > 0) {
      if (T == low) break;
      high = T;
    } else {
      if (T == high && difference < 0) break;
      low = T;
    }
    const double cp = heatCapacityMass(T);
    double next = std::clamp(T - difference / cp, T * (1 - largestChange), T * (1 + largestChange));
    const bool settled = std::abs(next - T) <= smallestChange * T || high - low <= smallestChange * T;
    if (!(cp > 0)) next = 0.5 * (low + high);
    next = std::clamp(next, low, high);
    if (next == T) next = settled ? T : 0.5 * (low + high);
    T = next;
    if (settled) {
      moveTo(T);
      writeMassFractions(Y);
      return T;
    }
  }
  throw NumericsError(
      fmt::format("no temperature between {} and {} K gives an equilibrium of the enthalpy {:.6g} J/kg: {}",
                  Thermo::minTemperature, Thermo::maxTemperature, h, state(T, given_)));
}

}  // namespace lampblack
