#include "chemistry/thermo/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {
namespace {

using constants::gasConstant;
using constants::oneAtmosphere;

constexpr double firstTemperature = 2500.0;  // K, of a search: dissociated enough to start easily
constexpr double largestChange = 0.3;        // of temperature in one step of it
constexpr double smallestChange = 1e-11;     // that which ends it
constexpr int mostTemperatures = 200;
constexpr double whole = HUGE_VAL;  // atoms: no molecule is cut
constexpr double firstSize = 16;    // of the largest parts of molecules, where they are cut, atoms
constexpr double leastSize = 4;
constexpr double growth = 4;  // of the parts from one equilibrium to the next

}  // namespace

Equilibrium::Equilibrium(const Mechanism& mechanism)
    : mechanism_(mechanism), thermo_(mechanism.allSpecies()), amounts_(mechanism.numSpecies()), all_(amounts_.size()) {}

std::string Equilibrium::state(double T) const {
  std::string text = fmt::format("{:.9g} K, {:.9g} {}, mass fractions", T, pressureOrDensity_,
                                 constant_ == Constant::Pressure ? "Pa" : "kg/m3");
  for (std::size_t k = 0; k < given_.size(); ++k)
    if (given_[k] != 0) text += fmt::format(" {}: {:.9g}", mechanism_.speciesName(k), given_[k]);
  return text;
}

// Takes over the elements of Y.
void Equilibrium::begin(Constant constant, double pressureOrDensity, std::span<const double> Y) {
  constant_ = constant;
  pressureOrDensity_ = pressureOrDensity;
  given_.assign(Y.begin(), Y.end());
  const auto W = mechanism_.molecularWeights();
  double moles = 0;
  for (std::size_t k = 0; k < amounts_.size(); ++k) {
    amounts_[k] = std::isfinite(Y[k]) ? std::max(Y[k], 0.0) / W[k] : NAN;
    moles += amounts_[k];
  }
  if (!(pressureOrDensity > 0 && moles > 0 && std::isfinite(pressureOrDensity + moles)))
    throw NumericsError("no gas to bring to equilibrium: " + state(NAN));
  mass_ = 0;
  for (std::size_t k = 0; k < amounts_.size(); ++k) {
    amounts_[k] /= moles;
    mass_ += amounts_[k] * W[k];
  }
  allowed_.assign(amounts_.size(), true);
  forbidAbsentElements();
  setActiveSpecies(whole);
}

void Equilibrium::forbidAbsentElements() {
  for (std::size_t e = 0; e < mechanism_.numElements(); ++e) {
    // Ions have negative numbers of electrons: none in sum is no lack of them.
    bool present = false;
    for (std::size_t k = 0; k < amounts_.size(); ++k)
      present = present || mechanism_.atoms(k, e) < 0 || mechanism_.atoms(k, e) * amounts_[k] > 0;
    if (present) continue;
    for (std::size_t k = 0; k < amounts_.size(); ++k)
      if (mechanism_.atoms(k, e) > 0) allowed_[k] = false;
  }
}

// Hands the allowed species to the path, molecules of no more than `size` atoms (setMixture). It starts from a mixture
// in which each has the share of its scarcest element, divided by their number: not more than there is of any element,
// and positive for all.
void Equilibrium::setActiveSpecies(double size) {
  active_.clear();
  for (std::size_t k = 0; k < amounts_.size(); ++k)
    if (allowed_[k]) active_.push_back(k);
  const std::size_t n = active_.size(), elements = mechanism_.numElements();
  for (auto* array : {&g_, &start_, &h_, &byTemperature_, &part_}) array->resize(n);
  size_.assign(n, 0.0);
  atoms_.resize(elements * n);
  for (std::size_t e = 0; e < elements; ++e)
    for (std::size_t j = 0; j < n; ++j) {
      const double a = atoms_[e * n + j] = mechanism_.atoms(active_[j], e);
      size_[j] += std::max(a, 0.0);
    }
  for (std::size_t j = 0; j < n; ++j) part_[j] = std::min(1.0, size / size_[j]);
  std::fill(start_.begin(), start_.end(), 1.0);
  for (std::size_t e = 0; e < elements; ++e) {
    const double* row = &atoms_[e * n];
    double total = 0;
    for (std::size_t j = 0; j < n; ++j) total += row[j] * amounts_[active_[j]];
    if (std::any_of(row, row + n, [](double a) { return a < 0; })) continue;
    for (std::size_t j = 0; j < n; ++j)
      if (row[j] > 0) start_[j] = std::min(start_[j], total / (part_[j] * row[j]));
  }
  for (std::size_t j = 0; j < n; ++j) start_[j] = std::log(start_[j] / static_cast<double>(n));
  setMixture(size);
}

// The mixture in which molecules of more than `size` atoms are cut into parts of this size, each with its part of the
// potential. start_ is where the path begins.
void Equilibrium::setMixture(double size) {
  const std::size_t n = active_.size(), elements = mechanism_.numElements();
  auto atoms = atoms_;
  for (std::size_t j = 0; j < n; ++j) {
    part_[j] = std::min(1.0, size / size_[j]);
    g_[j] = amounts_[active_[j]];
    if (part_[j] == 1) continue;
    g_[j] /= part_[j];
    for (std::size_t e = 0; e < elements; ++e) atoms[e * n + j] *= part_[j];
  }
  path_.setMixture(constant_, elements, std::move(atoms), g_);
  path_.startFrom(start_);
}

// The next mixture, from the equilibrium of smaller molecules: each species with the atoms that it has there.
void Equilibrium::growTo(double size) {
  for (std::size_t j = 0; j < active_.size(); ++j)
    start_[j] = path_.lnAmounts()[j] + std::log(part_[j] / std::min(1.0, size / size_[j]));
  setMixture(size);
}

// Brings the mixture to equilibrium at T. The amount of a species of 1e5 atoms changes by 1e5 e-folds where those of
// its elements change by one: it is there or not, as a condensed phase is. So equilibria of ever larger parts of it are
// found one from the other, in which it comes and goes gently at first; so they are too where the path is lost without.
void Equilibrium::moveTo(double T) {
  if (!(T > 0 && std::isfinite(T))) throw NumericsError("no equilibrium at the temperature of " + state(T));
  const double shift = constant_ == Constant::Pressure
                           ? std::log(pressureOrDensity_ / oneAtmosphere)
                           : -std::log(oneAtmosphere * mass_ / (pressureOrDensity_ * gasConstant * T));
  thermo_.gibbsOverRT(T, std::log(T), all_.data());
  const bool hasHeavy = std::ranges::max(size_) > EquilibriumComponents::mostLightAtoms;
  double first = hasHeavy ? firstSize : whole, size = first;
  if (hasHeavy) setActiveSpecies(size);
  for (;;) {
    for (std::size_t j = 0; j < active_.size(); ++j) g_[j] = part_[j] * all_[active_[j]] + shift;
    switch (path_.follow(g_)) {
      case EquilibriumPath::Outcome::Found:
        if (std::ranges::min(part_) == 1) return;
        growTo(size *= growth);
        break;
      case EquilibriumPath::Outcome::SpeciesExcluded:
        for (const std::size_t j : path_.excluded()) allowed_[active_[j]] = false;
        setActiveSpecies(size = first);
        break;
      case EquilibriumPath::Outcome::Lost:
        if (first == leastSize)
          throw NumericsError(
              fmt::format("the equilibrium was not found in {} iterations: {}", path_.iterations(), state(T)));
        first = std::max(leastSize, std::min(firstSize, first / 2));
        setActiveSpecies(size = first);
        break;
    }
  }
}

// In J/kg or J/kg/K, of the present composition.
double Equilibrium::evaluate(Property property, double T) {
  if (property == Property::Entropy) {
    thermo_.entropyOverR(T, std::log(T), all_.data());
    double total = 0, sum = 0;
    for (const double ln : path_.lnAmounts()) total += std::exp(ln);
    const double lnPartial = std::log(pressureOrDensity_ / oneAtmosphere / total);
    for (std::size_t j = 0; j < active_.size(); ++j)
      sum += std::exp(path_.lnAmounts()[j]) * (all_[active_[j]] - path_.lnAmounts()[j] - lnPartial);
    return sum * gasConstant / mass_;
  }
  thermo_.enthalpyOverRT(T, all_.data());
  const double expansion = property == Property::Energy ? 1.0 : 0.0;
  double sum = 0;
  for (std::size_t j = 0; j < active_.size(); ++j)
    sum += std::exp(path_.lnAmounts()[j]) * (all_[active_[j]] - expansion);
  return sum * gasConstant * T / mass_;
}

// Of the same by temperature along equilibria. d(G/RT)/d ln T = -H/RT; T ds = dh at constant pressure.
double Equilibrium::slope(Property property, double T) {
  const double expansion = constant_ == Constant::Volume ? 1.0 : 0.0;
  thermo_.enthalpyOverRT(T, all_.data());
  for (std::size_t j = 0; j < active_.size(); ++j) {
    h_[j] = all_[active_[j]] - expansion;
    g_[j] = -h_[j];
  }
  path_.sensitivity(g_, byTemperature_);
  thermo_.cpOverR(T, all_.data());
  double sum = 0;
  for (std::size_t j = 0; j < active_.size(); ++j)
    sum += std::exp(path_.lnAmounts()[j]) * (all_[active_[j]] - expansion + h_[j] * byTemperature_[j]);
  return sum * gasConstant / mass_ / (property == Property::Entropy ? T : 1.0);
}

// Newton's method in a bracket that shrinks: the three properties rise with temperature.
double Equilibrium::search(Property property, double value, std::span<double> Y) {
  double low = Thermo::minTemperature, high = Thermo::maxTemperature, T = firstTemperature;
  bool lowTried = false, highTried = false;
  for (int iteration = 0; iteration < mostTemperatures; ++iteration) {
    moveTo(T);
    const double difference = evaluate(property, T) - value;
    const bool above = difference > 0;
    if (!std::isfinite(difference) || (above && T == low) || (!above && T == high && difference != 0)) break;
    (above ? high : low) = T;
    (above ? highTried : lowTried) = true;
    const double change = std::clamp(-difference / slope(property, T), -largestChange * T, largestChange * T);
    double next = std::clamp(T + change, low, high);
    // Back at an end of the bracket.
    if (std::abs(change) > smallestChange * T && (next == low ? lowTried : next == high && highTried))
      next = 0.5 * (low + high);
    const bool settled = std::abs(change) <= smallestChange * T || high - low <= smallestChange * T;
    T = next;
    if (settled) {
      moveTo(T);
      writeMassFractions(Y);
      return T;
    }
  }
  constexpr const char* names[] = {"enthalpy", "entropy", "internal energy"};
  throw NumericsError(
      fmt::format("no temperature between {} and {} K gives an equilibrium of the {} {:.9g} (SI, per kg): {}",
                  Thermo::minTemperature, Thermo::maxTemperature, names[static_cast<int>(property)], value, state(T)));
}

void Equilibrium::writeMassFractions(std::span<double> Y) const {
  constexpr double leastLn = -700;  // below it the amounts are no longer numbers
  std::fill(Y.begin(), Y.end(), 0.0);
  double sum = 0;
  for (std::size_t j = 0; j < active_.size(); ++j) {
    const std::size_t k = active_[j];
    const double ln = path_.lnAmounts()[j];
    if (ln > leastLn) Y[k] = std::exp(ln) * mechanism_.molecularWeights()[k];
    sum += Y[k];
  }
  for (double& y : Y) y /= sum;
}

void Equilibrium::atTemperatureAndPressure(double T, double p, std::span<double> Y) {
  begin(Constant::Pressure, p, Y);
  moveTo(T);
  writeMassFractions(Y);
}

void Equilibrium::atTemperatureAndDensity(double T, double density, std::span<double> Y) {
  begin(Constant::Volume, density, Y);
  moveTo(T);
  writeMassFractions(Y);
}

double Equilibrium::atEnthalpyAndPressure(double h, double p, std::span<double> Y) {
  begin(Constant::Pressure, p, Y);
  return search(Property::Enthalpy, h, Y);
}

double Equilibrium::atEntropyAndPressure(double s, double p, std::span<double> Y) {
  begin(Constant::Pressure, p, Y);
  return search(Property::Entropy, s, Y);
}

double Equilibrium::atEnergyAndDensity(double u, double density, std::span<double> Y) {
  begin(Constant::Volume, density, Y);
  return search(Property::Energy, u, Y);
}

}  // namespace lampblack::chemistry
