// Rates of a mechanism by the plain formulas, reaction by reaction with std::pow and std::exp, for any number type:
// with complex numbers of a tiny imaginary part they give derivatives exact to round-off (Squire and Trapp 1998).
#pragma once

#include <cmath>
#include <complex>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/constants.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

template <class Number>
struct PlainRates {
  std::vector<Number> kf, kr;  // of three-body reactions without [M], else effective
  std::vector<Number> q, wdot;
};

inline double realPart(double x) {
  return x;
}
inline long double realPart(long double x) {
  return x;
}
inline double realPart(const std::complex<double>& x) {
  return x.real();
}

template <class Number>
Number plainArrhenius(const Arrhenius& rate, Number T) {
  using std::exp, std::pow;
  using Real = decltype(realPart(T));
  return Real(rate.A) * pow(T, Real(rate.b)) * exp(-Real(rate.activationTemperature) / T);
}

template <class Number>
Number plainBroadening(const Reaction& reaction, Number T, Number Pr) {
  using std::exp, std::log10, std::pow;
  using Real = decltype(realPart(T));
  const Real one = 1, ten = 10;
  if (reaction.sri) {
    const auto& s = *reaction.sri;
    Number bracket = Real(s.a) * exp(-Real(s.b) / T);
    if (s.c != 0) bracket += exp(-T / Real(s.c));
    const Number X = one / (one + log10(Pr) * log10(Pr));
    return Real(s.d) * pow(T, Real(s.e)) * pow(bracket, X);
  }
  if (reaction.troe || reaction.tsang) {
    Number centre = 0;
    if (reaction.troe) {
      const auto& t = *reaction.troe;
      if (t.T3 != 0) centre += (one - Real(t.A)) * exp(-T / Real(t.T3));
      if (t.T1 != 0) centre += Real(t.A) * exp(-T / Real(t.T1));
      if (t.T2.value_or(0) != 0) centre += exp(-Real(*t.T2) / T);
    } else {
      centre = Real(reaction.tsang->A) + Real(reaction.tsang->B) * T;
    }
    const Number logCentre = log10(centre);
    const Number c = Real(-0.4L) - Real(0.67L) * logCentre, n = Real(0.75L) - Real(1.27L) * logCentre;
    const Number x = log10(Pr) + c, f = x / (n - Real(0.14L) * x);
    return pow(ten, logCentre / (one + f * f));
  }
  return Number(one);
}

template <class Number>
Number plainPressureLog(const Reaction& reaction, Number T, Number p) {
  using std::exp, std::log;
  using Real = decltype(realPart(T));
  std::vector<Real> pressures;
  std::vector<Number> k;
  for (const auto& entry : reaction.pressureRates) {
    if (pressures.empty() || pressures.back() != Real(entry.pressure)) {
      pressures.push_back(entry.pressure);
      k.push_back(0);
    }
    k.back() += plainArrhenius(entry.rate, T);
  }
  if (realPart(p) <= pressures.front()) return k.front();
  if (realPart(p) >= pressures.back()) return k.back();
  std::size_t i = 0;
  while (pressures[i + 1] < realPart(p)) ++i;
  const Number part = (log(p) - log(pressures[i])) / (log(pressures[i + 1]) - log(pressures[i]));
  return exp(log(k[i]) + (log(k[i + 1]) - log(k[i])) * part);
}

template <class Number>
Number plainPolynomial(std::size_t n, Number x) {
  if (n == 0) return 1;
  if (n == 1) return x;
  using Real = decltype(realPart(x));
  return Real(2) * x * plainPolynomial(n - 1, x) - plainPolynomial(n - 2, x);
}

template <class Number>
Number plainChebyshev(const ChebyshevRate& rate, Number T, Number p) {
  using std::log10, std::pow;
  using Real = decltype(realPart(T));
  const Real one = 1, two = 2, ten = 10, Tmin = rate.minTemperature, Tmax = rate.maxTemperature;
  const Real logMin = log10(Real(rate.minPressure)), logMax = log10(Real(rate.maxPressure));
  const Number Tr = (two / T - one / Tmin - one / Tmax) / (one / Tmax - one / Tmin);
  const Number Pr = (two * log10(p) - logMin - logMax) / (logMax - logMin);
  Number sum = 0;
  for (std::size_t i = 0; i < rate.numTemperature; ++i)
    for (std::size_t j = 0; j < rate.numPressure; ++j)
      sum += Real(rate.coefficients[i * rate.numPressure + j]) * plainPolynomial(i, Tr) * plainPolynomial(j, Pr);
  return pow(ten, sum);
}

// Whole powers by multiplication; the rule for others stands in kinetics_powers.hpp.
template <class Number>
Number plainPower(Number c, double n) {
  using std::pow;
  using Real = decltype(realPart(c));
  if (n >= 0 && n <= 4 && n == std::floor(n)) {
    Number value = 1;
    for (int i = 0; i < static_cast<int>(n); ++i) value *= c;
    return value;
  }
  if (n < 1 && realPart(c) < Real(1e-10)) return c * pow(Real(1e-10), Real(n) - Real(1));
  return realPart(c) > 0 ? pow(c, Real(n)) : Number(0);
}

template <class Number>
Number plainEnthalpyOverRT(const Species& species, Number T) {
  using Real = decltype(realPart(T));
  const auto& a = realPart(T) <= Real(species.thermo.midTemperature) ? species.thermo.low : species.thermo.high;
  const auto r = [&](std::size_t i) { return Real(a[i]); };
  return r(0) + T * (r(1) / Real(2) + T * (r(2) / Real(3) + T * (r(3) / Real(4) + T * r(4) / Real(5)))) + r(5) / T;
}

template <class Number>
Number plainGibbsOverRT(const Species& species, Number T) {
  using std::log;
  using Real = decltype(realPart(T));
  const auto& a = realPart(T) <= Real(species.thermo.midTemperature) ? species.thermo.low : species.thermo.high;
  const auto r = [&](std::size_t i) { return Real(a[i]); };
  const Number h = plainEnthalpyOverRT(species, T);
  const Number s = r(0) * log(T) + T * (r(1) + T * (r(2) / Real(2) + T * (r(3) / Real(3) + T * r(4) / Real(4)))) + r(6);
  return h - s;
}

// Blowers and Masel (2000), as printed.
template <class Number>
Number plainBlowersMasel(const Mechanism& mechanism, const Reaction& reaction, Number T) {
  using std::exp, std::pow;
  using Real = decltype(realPart(T));
  const Real E0 = reaction.rate.activationTemperature, w = reaction.blowersMasel->bondEnergy, two = 2, four = 4;
  Number H = 0;
  for (const auto& t : reaction.products)
    H += Real(t.coefficient) * T * plainEnthalpyOverRT(mechanism.species(t.species), T);
  for (const auto& t : reaction.reactants)
    H -= Real(t.coefficient) * T * plainEnthalpyOverRT(mechanism.species(t.species), T);
  const Real V = two * w * (w + E0) / (w - E0);
  Number Ea = (w + H / two) * (V - two * w + H) * (V - two * w + H) / (V * V - four * w * w + H * H);
  if (realPart(H) < -four * E0) Ea = 0;
  if (realPart(H) > four * E0) Ea = H;
  return Real(reaction.rate.A) * pow(T, Real(reaction.rate.b)) * exp(-Ea / T);
}

// The rate constant of a reaction that depends on pressure p (or [M] for fall-off).
template <class Number>
Number plainDependingOnPressure(const Reaction& reaction, Number T, Number p, Number M) {
  if (reaction.type == Reaction::Type::PressureLog) return plainPressureLog(reaction, T, p);
  if (reaction.type == Reaction::Type::Chebyshev) return plainChebyshev(*reaction.chebyshev, T, p);
  using Real = decltype(realPart(T));
  const Number one = Real(1), high = plainArrhenius(reaction.rate, T),
               low = plainArrhenius(reaction.lowPressureRate, T);
  const Number Pr = low * M / high, F = plainBroadening(reaction, T, Pr);
  return reaction.type == Reaction::Type::Falloff ? high * (Pr / (one + Pr)) * F : low / (one + Pr) * F;
}

// Singal et al. (2024, eq. 8): the sum over species of X_j e_j/(sum X e) k_j(T, p sum X e/e_j).
template <class Number>
Number plainLinearBurke(const Reaction& reaction, Number T, const std::vector<Number>& c) {
  using Real = decltype(realPart(T));
  const Real R = constants::gasConstant;
  const auto& M = reaction.colliders[0];
  std::vector<const Collider*> colliders(c.size(), &M);
  for (const auto& collider : reaction.colliders)
    if (collider.species) colliders[*collider.species] = &collider;
  Number total = 0, mix = 0, k = 0;
  for (const auto& value : c) total += value;
  for (std::size_t j = 0; j < c.size(); ++j) mix += c[j] / total * plainArrhenius(colliders[j]->efficiency, T);
  for (std::size_t j = 0; j < c.size(); ++j) {
    const Number efficiency = plainArrhenius(colliders[j]->efficiency, T);
    const Number reduced = colliders[j]->ownRate ? mix / efficiency : mix;
    const auto& rate = colliders[j]->ownRate ? colliders[j]->rate : M.rate;
    k += c[j] / total * efficiency / mix * plainDependingOnPressure(rate, T, R * T * total * reduced, total * reduced);
  }
  return k;
}

template <class Number>
PlainRates<Number> plainRates(const Mechanism& mechanism, Number T, const std::vector<Number>& c) {
  using std::exp, std::log;
  using Real = decltype(realPart(T));
  const Real R = constants::gasConstant, p0 = constants::oneAtmosphere, one = 1;
  Number total = 0;
  for (const auto& value : c) total += value;
  const Number p = R * T * total;
  std::vector<Number> g;
  for (const auto& species : mechanism.allSpecies()) g.push_back(plainGibbsOverRT(species, T));
  PlainRates<Number> rates;
  rates.wdot.assign(mechanism.numSpecies(), Number(0));
  for (const auto& reaction : mechanism.reactions()) {
    Number M = 0;
    if (reaction.thirdBody)
      for (std::size_t k = 0; k < c.size(); ++k) {
        Real efficiency = reaction.thirdBody->defaultEfficiency;
        for (const auto& e : reaction.thirdBody->efficiencies)
          if (e.species == k) efficiency = e.coefficient;
        M += efficiency * c[k];
      }
    Number kf = 0;
    if (reaction.blowersMasel)
      kf = plainBlowersMasel(mechanism, reaction, T);
    else if (reaction.type == Reaction::Type::Elementary || reaction.type == Reaction::Type::ThreeBody)
      kf = plainArrhenius(reaction.rate, T);
    else if (reaction.type == Reaction::Type::LinearBurke)
      kf = plainLinearBurke(reaction, T, c);
    else
      kf = plainDependingOnPressure(reaction, T, p, M);
    Number lnKc = 0, nuSum = 0;
    const auto side = [&](const std::vector<StoichiometricTerm>& terms, Real sign) {
      for (const auto& t : terms) {
        lnKc -= sign * Real(t.coefficient) * g[t.species];
        nuSum += sign * Real(t.coefficient);
      }
    };
    side(reaction.reactants, -one);
    side(reaction.products, one);
    lnKc += nuSum * log(p0 / (R * T));
    const Number kr = reaction.reversible ? kf * exp(-lnKc) : Number(0);
    Number forward = kf, reverse = kr;
    for (const auto& t : reaction.reactants) {
      double n = t.coefficient;
      for (const auto& o : reaction.orders)
        if (o.species == t.species) n = o.coefficient;
      forward *= plainPower(c[t.species], n);
    }
    for (const auto& o : reaction.orders) {
      bool reactant = false;
      for (const auto& t : reaction.reactants) reactant = reactant || t.species == o.species;
      if (!reactant) forward *= plainPower(c[o.species], o.coefficient);
    }
    for (const auto& t : reaction.products) reverse *= plainPower(c[t.species], t.coefficient);
    Number q = forward - reverse;
    if (reaction.type == Reaction::Type::ThreeBody) q *= M;
    for (const auto& t : reaction.reactants) rates.wdot[t.species] -= Real(t.coefficient) * q;
    for (const auto& t : reaction.products) rates.wdot[t.species] += Real(t.coefficient) * q;
    rates.kf.push_back(kf);
    rates.kr.push_back(kr);
    rates.q.push_back(q);
  }
  return rates;
}

}  // namespace lampblack::test
