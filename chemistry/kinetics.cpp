#include "chemistry/kinetics.hpp"

#include <algorithm>
#include <cmath>

#include "chemistry/vector_math.hpp"
#include "core/constants.hpp"

namespace lampblack {

namespace {

constexpr double kLn10 = 2.30258509299404568402;
constexpr double kTiny = 1e-300;  // keeps logarithms of vanishing pressures and broadenings finite

}  // namespace

// Everything that depends on temperature alone; nothing to do if it has not changed.
void Kinetics::updateTemperature(double T) {
  if (T == temperature_) return;
  temperature_ = T;
  const double lnT = std::log(T), inverseT = 1.0 / T;
  {
    const double* __restrict lnA = tables_.lnA.data();
    const double* __restrict b = tables_.b.data();
    const double* __restrict Ta = tables_.Ta.data();
    double* __restrict lnk = lnkf_.data();
    double* __restrict k = kf_.data();
    for (std::size_t i = 0; i < tables_.numReactions; ++i) {
      lnk[i] = lnA[i] + b[i] * lnT - Ta[i] * inverseT;
      k[i] = vectormath::expOne(lnk[i]);
    }
  }
  thermo_.gibbsOverRT(T, lnT, gibbs_.data());
  // ln Kc = -sum nu g/RT + sum nu ln(p0/RT); kr = kf/Kc
  const double lnStandard = std::log(constants::oneAtmosphere / constants::gasConstant) - lnT;
  {
    const double* __restrict g = gibbs_.data();
    const double* __restrict lnk = lnkf_.data();
    const double* __restrict nuSum = tables_.nuSum.data();
    double* __restrict lnkr = lnkr_.data();
    double* __restrict k = kr_.data();
    const std::int32_t *__restrict r0 = tables_.reactant[0].data(), *__restrict r1 = tables_.reactant[1].data(),
                       *__restrict r2 = tables_.reactant[2].data(), *__restrict p0 = tables_.product[0].data(),
                       *__restrict p1 = tables_.product[1].data(), *__restrict p2 = tables_.product[2].data();
    for (std::size_t i = 0; i < tables_.numReversible; ++i) {
      const double gibbsChange = (g[p0[i]] + g[p1[i]] + g[p2[i]]) - (g[r0[i]] + g[r1[i]] + g[r2[i]]);
      lnkr[i] = lnk[i] + gibbsChange - nuSum[i] * lnStandard;
    }
    for (const auto& general : tables_.general)
      if (general.reaction < tables_.numReversible)
        for (const auto& term : tables_.netTerms[general.reaction])
          lnkr[general.reaction] += term.coefficient * g[term.species];
    for (std::size_t i = 0; i < tables_.numReversible; ++i) k[i] = vectormath::expOne(lnkr[i]);
  }
  if (tables_.anyNegative)
    for (std::size_t i = 0; i < tables_.numReactions; ++i) {
      kf_[i] *= tables_.sign[i];
      kr_[i] *= tables_.sign[i];
    }
  updateFalloffLimits(T, lnT);
}

void Kinetics::updateFalloffLimits(double T, double lnT) {
  const auto& f = tables_.falloff;
  const std::size_t n = f.reaction.size();
  const double inverseT = 1.0 / T;
  double* terms = troeTerms_.data();
  for (std::size_t i = 0; i < n; ++i) {
    lowOverHigh_[i] = f.lnA[i] + f.b[i] * lnT - f.Ta[i] * inverseT - lnkf_[f.reaction[i]];
    terms[i] = -T * f.inverseT3[i];
    terms[n + i] = -T * f.inverseT1[i];
    terms[2 * n + i] = -f.T2[i] * inverseT;
  }
  vectormath::exp(lowOverHigh_.data(), lowOverHigh_.data(), n);
  vectormath::exp(terms, terms, 3 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const double centre = f.w3[i] * terms[i] + f.w1[i] * terms[n + i] + f.w2[i] * terms[2 * n + i];
    lnFcent_[i] = centre > kTiny ? centre : kTiny;
  }
  vectormath::log(lnFcent_.data(), lnFcent_.data(), n);
}

void Kinetics::updateConcentrations(std::span<const double> concentrations) {
  double total = 0;
  for (std::size_t k = 0; k < tables_.numSpecies; ++k) {
    c_[k] = concentrations[k];
    total += concentrations[k];
  }
  for (std::size_t s = 0; s < tables_.sets.size(); ++s) {
    double M = tables_.sets[s].base * total;
    for (const auto& e : tables_.sets[s].excess) M += e.coefficient * c_[e.species];
    M_[s] = M;
  }
}

// [M] of three-body reactions; Pr/(1+Pr) F of fall-off reactions with F of Gilbert, Luther, Troe (1983):
// log F = log Fcent / (1 + f^2), f = (x + c)/(n - 0.14 (x + c)), x = log Pr, c = -0.4 - 0.67 log Fcent,
// n = 0.75 - 1.27 log Fcent (logarithms to base 10).
void Kinetics::updateFactors() {
  for (const auto& use : tables_.threeBody) factor_[use.reaction] = M_[use.set];
  const auto& f = tables_.falloff;
  const std::size_t n = f.reaction.size();
  double* __restrict Pr = falloffWork_.data();
  double* __restrict lnF = falloffWork_.data() + n;
  for (std::size_t i = 0; i < n; ++i) {
    const double reduced = lowOverHigh_[i] * M_[f.set[i]];
    Pr[i] = reduced > kTiny ? reduced : kTiny;
  }
  const double* __restrict lnFcent = lnFcent_.data();
  for (std::size_t i = 0; i < n; ++i) {
    const double lnPr = vectormath::logOne(Pr[i]);
    const double logFcent = lnFcent[i] * (1.0 / kLn10);
    const double u = lnPr * (1.0 / kLn10) - 0.4 - 0.67 * logFcent;
    const double shape = u / (0.75 - 1.27 * logFcent - 0.14 * u);
    lnF[i] = vectormath::expOne(lnFcent[i] / (1.0 + shape * shape)) * Pr[i] / (1.0 + Pr[i]);
  }
  for (std::size_t i = 0; i < n; ++i) factor_[f.reaction[i]] = lnF[i];
}

double Kinetics::power(double concentration, double exponent) {
  if (exponent == std::floor(exponent) && exponent >= 0 && exponent <= 4) {
    double value = 1;
    for (int i = 0; i < static_cast<int>(exponent); ++i) value *= concentration;
    return value;
  }
  return std::pow(std::max(concentration, 0.0), exponent);
}

void Kinetics::updateProgress() {
  const double* __restrict c = c_.data();
  {
    const std::int32_t *__restrict r0 = tables_.reactant[0].data(), *__restrict r1 = tables_.reactant[1].data(),
                       *__restrict r2 = tables_.reactant[2].data();
    const double* __restrict k = kf_.data();
    double* __restrict forward = forward_.data();
    for (std::size_t i = 0; i < tables_.numReactions; ++i) forward[i] = k[i] * c[r0[i]] * c[r1[i]] * c[r2[i]];
  }
  {
    const std::int32_t *__restrict p0 = tables_.product[0].data(), *__restrict p1 = tables_.product[1].data(),
                       *__restrict p2 = tables_.product[2].data();
    const double* __restrict k = kr_.data();
    double* __restrict reverse = reverse_.data();
    for (std::size_t i = 0; i < tables_.numReversible; ++i) reverse[i] = k[i] * c[p0[i]] * c[p1[i]] * c[p2[i]];
  }
  for (const auto& general : tables_.general) {
    for (const auto& t : general.forwardOrders) forward_[general.reaction] *= power(c[t.species], t.coefficient);
    for (const auto& t : general.reverseOrders) reverse_[general.reaction] *= power(c[t.species], t.coefficient);
  }
  const double* __restrict factor = factor_.data();
  const double* __restrict forward = forward_.data();
  const double* __restrict reverse = reverse_.data();
  double* __restrict progress = progress_.data();
  for (std::size_t i = 0; i < tables_.numReactions; ++i) progress[i] = factor[i] * (forward[i] - reverse[i]);
}

void Kinetics::sumProduction(const double* progress, double* out) const {
  const std::int32_t* __restrict reaction = tables_.rowReaction.data();
  const double* __restrict nu = tables_.rowNu.data();
  for (std::size_t k = 0; k < tables_.numSpecies; ++k) {
    double a = 0, b = 0, c = 0, d = 0;
    for (std::size_t e = tables_.rows[k]; e < tables_.rows[k + 1]; e += 4) {
      a += nu[e] * progress[reaction[e]];
      b += nu[e + 1] * progress[reaction[e + 1]];
      c += nu[e + 2] * progress[reaction[e + 2]];
      d += nu[e + 3] * progress[reaction[e + 3]];
    }
    out[k] = (a + b) + (c + d);
  }
}

void Kinetics::netProductionRates(double T, std::span<const double> concentrations, std::span<double> wdot) {
  updateTemperature(T);
  updateConcentrations(concentrations);
  updateFactors();
  updateProgress();
  sumProduction(progress_.data(), wdot.data());
}

void Kinetics::ratesOfProgress(double T, std::span<const double> concentrations, std::span<double> forward,
                               std::span<double> reverse) {
  updateTemperature(T);
  updateConcentrations(concentrations);
  updateFactors();
  updateProgress();
  for (std::size_t i = 0; i < tables_.numReactions; ++i) {
    forward[tables_.original[i]] = factor_[i] * forward_[i];
    reverse[tables_.original[i]] = factor_[i] * reverse_[i];
  }
}

void Kinetics::rateConstants(double T, std::span<const double> concentrations, std::span<double> forward,
                             std::span<double> reverse) {
  updateTemperature(T);
  updateConcentrations(concentrations);
  updateFactors();
  for (std::size_t i = 0; i < tables_.numReactions; ++i) {
    forward[tables_.original[i]] = kf_[i];
    reverse[tables_.original[i]] = kr_[i];
  }
  for (const auto i : tables_.falloff.reaction) {
    forward[tables_.original[i]] *= factor_[i];
    reverse[tables_.original[i]] *= factor_[i];
  }
}

void Kinetics::equilibriumConstants(double T, std::span<double> Kc) {
  updateTemperature(T);
  const double lnStandard = std::log(constants::oneAtmosphere / (constants::gasConstant * T));
  for (std::size_t i = 0; i < tables_.numReactions; ++i) {
    double lnK = tables_.nuSum[i] * lnStandard;
    for (const auto& term : tables_.netTerms[i]) lnK -= term.coefficient * gibbs_[term.species];
    Kc[tables_.original[i]] = std::exp(lnK);
  }
}

}  // namespace lampblack
