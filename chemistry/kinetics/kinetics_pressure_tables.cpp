// The tables of rate constants that depend on pressure.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "chemistry/kinetics/kinetics_tables.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {

namespace {

constexpr double kLogOfZero = -1e4;  // its exponential vanishes beside any other rate

std::string place(const Mechanism& mechanism, const Reaction& reaction) {
  return fmt::format("{}: reaction '{}'", mechanism.placeOf(reaction), reaction.equation);
}

[[noreturn]] void refuse(const Mechanism& mechanism, const Reaction& reaction, const std::string& what) {
  throw InputError(fmt::format("{}: {}", place(mechanism, reaction), what));
}

void checkPressureLog(const Mechanism& mechanism, const Reaction& reaction) {
  const auto& entries = reaction.pressureRates;
  if (entries.empty()) refuse(mechanism, reaction, "expected rate constants at one pressure or more");
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (!(entries[i].pressure > 0) || (i > 0 && entries[i].pressure < entries[i - 1].pressure))
      refuse(mechanism, reaction, "expected positive pressures in rising order");
  for (std::size_t i = 0; i < entries.size();) {
    const double p = entries[i].pressure;
    const std::size_t first = i;
    while (i < entries.size() && entries[i].pressure == p) ++i;
    for (const double T : {300.0, 500.0, 1000.0, 2000.0, 3000.0}) {
      double sum = 0;
      for (std::size_t e = first; e < i; ++e) {
        const auto& rate = entries[e].rate;
        sum += rate.A * std::exp(rate.b * std::log(T) - rate.activationTemperature / T);
      }
      if (!(sum > 0))
        refuse(mechanism, reaction,
               fmt::format("the rate constant at {} Pa and {} K is {:.4g}; expected a positive one", p, T, sum));
    }
  }
}

void checkChebyshev(const Mechanism& mechanism, const Reaction& reaction) {
  if (!reaction.chebyshev) refuse(mechanism, reaction, "expected Chebyshev coefficients");
  const auto& rate = *reaction.chebyshev;
  if (rate.numTemperature == 0 || rate.numPressure == 0 ||
      rate.coefficients.size() != rate.numTemperature * rate.numPressure)
    refuse(mechanism, reaction, "expected a full matrix of Chebyshev coefficients");
  if (!(rate.minTemperature > 0 && rate.maxTemperature > rate.minTemperature))
    refuse(mechanism, reaction, "expected a range of positive, rising temperatures");
  if (!(rate.minPressure > 0 && rate.maxPressure > rate.minPressure))
    refuse(mechanism, reaction, "expected a range of positive, rising pressures");
}

void checkLinearBurke(const Mechanism& mechanism, const Reaction& reaction) {
  using enum Reaction::Type;
  if (reaction.colliders.empty() || reaction.colliders[0].species || !reaction.colliders[0].ownRate)
    refuse(mechanism, reaction, "expected a rate for colliders that are not named");
  for (std::size_t i = 0; i < reaction.colliders.size(); ++i) {
    const auto& collider = reaction.colliders[i];
    if ((i > 0) != collider.species.has_value() || !(collider.efficiency.A > 0))
      refuse(mechanism, reaction, "expected a species and a positive efficiency of every other collider");
    const auto type = collider.rate.type;
    if (!collider.ownRate) continue;
    if (type != Falloff && type != PressureLog && type != Chebyshev)
      refuse(mechanism, reaction, "expected fall-off, PLOG or Chebyshev rates of the colliders");
    if (type == Falloff && !(collider.rate.rate.A > 0)) refuse(mechanism, reaction, "expected positive rates");
  }
}

// The Arrhenius form through the values in the middle of the pressures, where Pr = 0, at both ends of the temperatures.
Arrhenius chebyshevBase(const ChebyshevRate& rate) {
  double log10Low = 0, log10High = 0;  // at Tr = -1 (minTemperature) and Tr = 1
  for (std::size_t i = 0; i < rate.numTemperature; ++i)
    for (std::size_t j = 0; j < rate.numPressure; j += 2) {
      const double value = (j % 4 == 0 ? 1.0 : -1.0) * rate.coefficients[i * rate.numPressure + j];
      log10Low += i % 2 == 0 ? value : -value;
      log10High += value;
    }
  Arrhenius base;
  base.activationTemperature =
      std::numbers::ln10 * (log10High - log10Low) / (1.0 / rate.minTemperature - 1.0 / rate.maxTemperature);
  base.A = std::exp(std::numbers::ln10 * log10High + base.activationTemperature / rate.maxTemperature);
  return base;
}

}  // namespace

double KineticsTables::lnMagnitude(double A) {
  return A == 0 ? kLogOfZero : std::log(std::abs(A));
}

Arrhenius KineticsTables::baseRate(const Mechanism& mechanism, const Reaction& reaction) {
  if (reaction.type == Reaction::Type::ChemicallyActivated) return reaction.lowPressureRate;
  if (reaction.type == Reaction::Type::PressureLog) {
    checkPressureLog(mechanism, reaction);
    const auto& entries = reaction.pressureRates;
    auto at = entries.begin() + static_cast<std::ptrdiff_t>(entries.size() / 2);
    if (at->rate.A <= 0) at = std::find_if(entries.begin(), entries.end(), [](const auto& e) { return e.rate.A > 0; });
    return at->rate;
  }
  if (reaction.type == Reaction::Type::Chebyshev) {
    checkChebyshev(mechanism, reaction);
    return chebyshevBase(*reaction.chebyshev);
  }
  if (reaction.type == Reaction::Type::LinearBurke) {
    checkLinearBurke(mechanism, reaction);
    return baseRate(mechanism, reaction.colliders[0].rate);
  }
  return reaction.rate;
}

void KineticsTables::addFalloff(std::size_t i, const Mechanism& mechanism, const Reaction& reaction) {
  if (!reaction.thirdBody) refuse(mechanism, reaction, "expected a third body");
  if (reaction.rate.A * reaction.lowPressureRate.A < 0)
    refuse(mechanism, reaction, "expected the same sign of the rate constants at low and at high pressure");
  const bool activated = reaction.type == Reaction::Type::ChemicallyActivated;
  const auto& other = activated ? reaction.rate : reaction.lowPressureRate;
  auto& f = falloff;
  f.reaction.push_back(i);
  f.set.push_back(thirdBodySet(*reaction.thirdBody));
  f.direction.push_back(activated ? -1.0 : 1.0);
  f.lnA.push_back(lnMagnitude(other.A));
  f.b.push_back(other.b);
  f.Ta.push_back(other.activationTemperature);
  const auto weights = [&](double w3, double T3, double w1, double T1, double w2, double T2) {
    f.w3.push_back(w3);
    f.w1.push_back(w1);
    f.w2.push_back(w2);
    f.inverseT3.push_back(T3 != 0 ? 1.0 / T3 : 0.0);
    f.inverseT1.push_back(T1 != 0 ? 1.0 / T1 : 0.0);
    f.T2.push_back(T2);
    f.byT.push_back(reaction.tsang ? reaction.tsang->B : 0.0);
  };
  const auto shape = [&](double shift0, double shift1, double width0, double width1, double slope) {
    f.shift0.push_back(shift0);
    f.shift1.push_back(shift1);
    f.width0.push_back(width0);
    f.width1.push_back(width1);
    f.slope.push_back(slope);
  };
  f.lnScale.push_back(reaction.sri ? std::log(reaction.sri->d) : 0.0);
  f.scaleExponent.push_back(reaction.sri ? reaction.sri->e : 0.0);
  if (reaction.sri) {
    const auto& sri = *reaction.sri;
    if (!(sri.d > 0)) refuse(mechanism, reaction, "expected a positive factor d of the SRI broadening");
    if (sri.c < 0) refuse(mechanism, reaction, "expected a temperature c of the SRI broadening that is not negative");
    weights(sri.c != 0 ? 1.0 : 0.0, sri.c, 0.0, 0.0, sri.a, sri.b);
    shape(0.0, 0.0, 1.0, 0.0, 0.0);
  } else if (reaction.troe) {
    const auto& troe = *reaction.troe;
    const double T2 = troe.T2.value_or(0);
    weights(troe.T3 != 0 ? 1.0 - troe.A : 0.0, troe.T3, troe.T1 != 0 ? troe.A : 0.0, troe.T1, T2 != 0 ? 1.0 : 0.0, T2);
    shape(-0.4, -0.67, 0.75, -1.27, 0.14);
  } else if (reaction.tsang) {
    weights(0.0, 0.0, reaction.tsang->A, 0.0, 0.0, 0.0);
    shape(-0.4, -0.67, 0.75, -1.27, 0.14);
  } else {
    weights(0.0, 0.0, 1.0, 0.0, 0.0, 0.0);
    shape(0.0, 0.0, 1.0, 0.0, 0.0);
  }
}

void KineticsTables::addPressureLog(std::size_t i, const Mechanism& mechanism, const Reaction& reaction) {
  auto& p = pressureLog;
  p.reaction.push_back(i);
  p.where.push_back(place(mechanism, reaction));
  double last = 0;
  for (const auto& entry : reaction.pressureRates) {
    if (entry.pressure != last) {
      p.lnPressure.push_back(std::log(entry.pressure));
      p.rates.push_back(p.rates.back());
    }
    last = entry.pressure;
    ++p.rates.back();
    p.lnA.push_back(lnMagnitude(entry.rate.A));
    p.b.push_back(entry.rate.b);
    p.Ta.push_back(entry.rate.activationTemperature);
    p.sign.push_back(entry.rate.A < 0 ? -1.0 : 1.0);
  }
  p.points.push_back(p.lnPressure.size());
}

void KineticsTables::addChebyshev(std::size_t i, const ChebyshevRate& rate) {
  auto& t = chebyshev;
  t.reaction.push_back(i);
  t.first.push_back(t.coefficients.size());
  t.numT.push_back(rate.numTemperature);
  t.numP.push_back(rate.numPressure);
  for (const double a : rate.coefficients) t.coefficients.push_back(std::numbers::ln10 * a);
  const double coldest = 1.0 / rate.minTemperature, hottest = 1.0 / rate.maxTemperature;
  t.scaleT.push_back(2.0 / (hottest - coldest));
  t.shiftT.push_back((coldest + hottest) / (coldest - hottest));
  const double lowest = std::log(rate.minPressure), highest = std::log(rate.maxPressure);
  t.scaleP.push_back(2.0 / (highest - lowest));
  t.shiftP.push_back(-(lowest + highest) / (highest - lowest));
}

void KineticsTables::addLinearBurke(std::size_t i, const Reaction& reaction) {
  linearBurke.push_back({i, {}});
  for (const auto& collider : reaction.colliders)
    if (collider.species) linearBurke.back().colliders.push_back(*collider.species);
}

}  // namespace lampblack::chemistry
