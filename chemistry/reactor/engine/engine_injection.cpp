#include "chemistry/reactor/engine/engine_injection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/errors.hpp"

namespace lampblack::chemistry {
namespace {

struct OxygenBalance {
  double need = 0, have = 0;  // mol of atoms a mol
};

OxygenBalance oxygenBalance(const Mechanism& mechanism, std::size_t k) {
  const auto atoms = [&](const char* name) {
    const auto element = mechanism.findElement(name);
    return element ? mechanism.atoms(k, *element) : 0.0;
  };
  return {2 * atoms("C") + 0.5 * atoms("H"), atoms("O")};
}

// Standard deviation by equal weights; 1 where all are the same.
double spreadOf(const std::vector<double>& values) {
  double mean = 0, square = 0;
  for (const double x : values) mean += x / static_cast<double>(values.size());
  for (const double x : values) square += (x - mean) * (x - mean) / static_cast<double>(values.size());
  return square > 0 ? std::sqrt(square) : 1;
}

}  // namespace

std::vector<double> oxygenNeedOf(const Mechanism& mechanism) {
  std::vector<double> need(mechanism.numSpecies());
  for (std::size_t k = 0; k < need.size(); ++k) {
    const auto [needs, has] = oxygenBalance(mechanism, k);
    need[k] = (needs - has) / mechanism.species(k).molecularWeight;
  }
  return need;
}

double equivalenceRatioOf(const Mechanism& mechanism, std::span<const double> Y) {
  double need = 0, have = 0;
  for (std::size_t k = 0; k < Y.size(); ++k) {
    const auto [needs, has] = oxygenBalance(mechanism, k);
    need += Y[k] / mechanism.species(k).molecularWeight * needs;
    have += Y[k] / mechanism.species(k).molecularWeight * has;
  }
  return have > 0 ? need / have : std::numeric_limits<double>::infinity();
}

EngineInjection::EngineInjection(const Mechanism& mechanism, const Thermo& thermo, const Options& options)
    : thermo_(thermo), options_(options), need_(oxygenNeedOf(mechanism)) {}

EngineInjection::Work EngineInjection::inject(double mass, EngineGas& gas) const {
  if (!(mass > 0)) return {};
  Work done{mass, mass * options_.enthalpy, 0};
  const double before = volumeOf(thermo_, gas);
  const EngineTotals around = totalsOf(thermo_, gas);
  const double taken = options_.dilution * mass, share = taken / around.mass;
  if (!(share < 0.5))
    throw NumericsError(
        fmt::format("{:.3g} kg of fuel are to evaporate in {:.3g} kg of gas at once, of {:.3g} kg in the "
                    "cylinder: take shorter steps or less dilution",
                    mass, taken, around.mass));
  std::vector<double> Y(gas.species);
  for (std::size_t k = 0; k < Y.size(); ++k)
    Y[k] = (mass * options_.massFractions[k] + taken * around.massFractions[k]) / (mass + taken);
  const double enthalpy = (mass * options_.enthalpy + share * around.enthalpy) / (mass + taken);
  double T = 0;
  try {
    T = thermo_.temperatureFromEnthalpy(enthalpy, Y, 500);
  } catch (const NumericsError& error) {
    throw NumericsError(
        fmt::format("the fuel that evaporates has no temperature ({}): let it do so in more of the gas "
                    "(injection.dilution)",
                    error.what()));
  }
  std::vector<double> amounts(gas.scalars, 0);
  for (std::size_t p = 0; p < gas.count(); ++p)
    for (std::size_t s = 0; s < gas.scalars; ++s)
      amounts[s] += share * gas.mass[p] * gas.amounts(p)[s] / (mass + taken);
  for (double& m : gas.mass) m *= 1 - share;
  gas.add(mass + taken, T, Y);
  std::ranges::copy(amounts, gas.amounts(gas.count() - 1).begin());
  while (gas.count() > options_.mostParticles && gas.count() > 2) mergeNearest(gas);
  done.growth = volumeOf(thermo_, gas) - before;
  return done;
}

void EngineInjection::mergeNearest(EngineGas& gas) const {
  const std::size_t n = gas.count();
  std::vector<double> need(n, 0), enthalpy(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < gas.species; ++k) need[i] += need_[k] * gas.Y(i)[k];
    enthalpy[i] = thermo_.enthalpyMass(gas.temperature[i], gas.Y(i));
  }
  const double byNeed = spreadOf(need), byEnthalpy = spreadOf(enthalpy);
  std::pair<std::size_t, std::size_t> best{0, 1};
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      const double a = (need[i] - need[j]) / byNeed, b = (enthalpy[i] - enthalpy[j]) / byEnthalpy;
      // Light ones first.
      const double apart = (a * a + b * b) * (gas.mass[i] + gas.mass[j]);
      if (!(apart < nearest)) continue;
      nearest = apart;
      best = {i, j};
    }
  const auto [i, j] = best;
  const double both = gas.mass[i] + gas.mass[j], part = gas.mass[j] / both;
  for (std::size_t k = 0; k < gas.species; ++k) gas.Y(i)[k] += part * (gas.Y(j)[k] - gas.Y(i)[k]);
  for (std::size_t s = 0; s < gas.scalars; ++s) gas.amounts(i)[s] += part * (gas.amounts(j)[s] - gas.amounts(i)[s]);
  gas.temperature[i] =
      thermo_.temperatureFromEnthalpy(enthalpy[i] + part * (enthalpy[j] - enthalpy[i]), gas.Y(i), gas.temperature[i]);
  gas.mass[i] = both;
  gas.firstStep[i] = 0;
  gas.remove(j);
}

}  // namespace lampblack::chemistry
