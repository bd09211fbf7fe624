#include "chemistry/kinetics/kinetics_falloff.hpp"

#include <algorithm>
#include <numbers>

#include "numerics/vector_math.hpp"

namespace lampblack::chemistry {

namespace {

constexpr double kTiny = 1e-300;  // keeps logarithms of vanishing pressures and broadenings finite

// One array each, so that the compiler sees that it may vectorise.
void expInPlace(double* x, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) x[i] = vectormath::expOne(x[i]);
}

void logInPlace(double* x, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) x[i] = vectormath::logOne(x[i]);
}

}  // namespace

FalloffFactors::FalloffFactors(const KineticsTables& tables) {
  const std::size_t n = tables.falloff.reaction.size();
  terms_.assign(3 * n, 0.0);
  for (auto* array : {&ratio_, &lnFcent_, &shift_, &width_, &lnScale_, &pr_, &u_, &values_, &byM_, &byT_})
    array->assign(n, 0.0);
}

void FalloffFactors::setTemperature(const KineticsTables& tables, double T, double lnT, const double* lnBase) {
  T_ = T;
  const auto& f = tables.falloff;
  const std::size_t n = ratio_.size();
  const double inverseT = 1.0 / T;
  double* __restrict ratio = ratio_.data();
  double* __restrict terms = terms_.data();
  for (std::size_t i = 0; i < n; ++i) {
    ratio[i] = f.direction[i] * (f.lnA[i] + f.b[i] * lnT - f.Ta[i] * inverseT - lnBase[f.reaction[i]]);
    terms[i] = -T * f.inverseT3[i];
    terms[n + i] = -T * f.inverseT1[i];
    terms[2 * n + i] = -f.T2[i] * inverseT;
  }
  expInPlace(ratio, n);
  expInPlace(terms, 3 * n);
  double* __restrict lnFcent = lnFcent_.data();
  for (std::size_t i = 0; i < n; ++i) {
    const double centre = f.w3[i] * terms[i] + f.w1[i] * terms[n + i] + f.w2[i] * terms[2 * n + i] + f.byT[i] * T;
    lnFcent[i] = centre > kTiny ? centre : kTiny;
  }
  logInPlace(lnFcent, n);
  for (std::size_t i = 0; i < n; ++i) {
    const double log10Fcent = lnFcent[i] * (1.0 / std::numbers::ln10);
    shift_[i] = f.shift0[i] + f.shift1[i] * log10Fcent;
    width_[i] = f.width0[i] + f.width1[i] * log10Fcent;
    lnScale_[i] = f.lnScale[i] + f.scaleExponent[i] * lnT;
  }
}

std::span<const double> FalloffFactors::evaluate(const KineticsTables& tables, const double* M) {
  const auto& f = tables.falloff;
  const std::size_t n = ratio_.size();
  double* __restrict pr = pr_.data();
  for (std::size_t i = 0; i < n; ++i) {
    const double reduced = ratio_[i] * M[f.set[i]];
    pr[i] = reduced > kTiny ? reduced : kTiny;
  }
  const double *__restrict lnFcent = lnFcent_.data(), *__restrict shift = shift_.data(),
                           *__restrict width = width_.data(), *__restrict slope = f.slope.data(),
                           *__restrict lnScale = lnScale_.data(), *__restrict direction = f.direction.data();
  double* __restrict u = u_.data();
  double* __restrict values = values_.data();
  std::copy_n(pr, n, u);
  logInPlace(u, n);
  for (std::size_t i = 0; i < n; ++i) {
    u[i] = u[i] * (1.0 / std::numbers::ln10) + shift[i];
    const double h = u[i] / (width[i] - slope[i] * u[i]);
    values[i] = lnScale[i] + lnFcent[i] / (1.0 + h * h);
  }
  expInPlace(values, n);
  for (std::size_t i = 0; i < n; ++i) values[i] *= (direction[i] > 0 ? pr[i] : 1.0) / (1.0 + pr[i]);
  return values_;
}

// By the chain rule through u and log10 Fcent. Pr/[M] is the ratio; where Pr has vanished, fall-off is proportional to
// it and an activated reaction does not change.
void FalloffFactors::evaluateSlopes(const KineticsTables& tables) {
  const auto& f = tables.falloff;
  const std::size_t n = ratio_.size();
  const double inverseT = 1.0 / T_, T2Scale = inverseT * inverseT;
  double* __restrict byM = byM_.data();
  double* __restrict byT = byT_.data();
  for (std::size_t i = 0; i < n; ++i) {
    const auto r = f.reaction[i];
    byM[i] = f.b[i] - tables.b[r];
    byT[i] = f.Ta[i] - tables.Ta[r];
  }
  const double *__restrict pr = pr_.data(), *__restrict u = u_.data(), *__restrict values = values_.data(),
                           *__restrict ratio = ratio_.data(), *__restrict terms = terms_.data();
  const double* __restrict lnFcent = lnFcent_.data(), * __restrict width = width_.data();
  const double *__restrict direction = f.direction.data(), *__restrict slope = f.slope.data(),
                           *__restrict shift1 = f.shift1.data(), *__restrict width1 = f.width1.data(),
                           *__restrict scaleExponent = f.scaleExponent.data();
  const double *__restrict w3 = f.w3.data(), *__restrict w1 = f.w1.data(), *__restrict w2 = f.w2.data(),
                           *__restrict inverseT3 = f.inverseT3.data(), *__restrict inverseT1 = f.inverseT1.data(),
                           *__restrict T2 = f.T2.data(), *__restrict centreSlope = f.byT.data();
  for (std::size_t i = 0; i < n; ++i) {
    const double d = width[i] - slope[i] * u[i], inverseD = 1.0 / d;
    const double h = u[i] * inverseD, spread = 1.0 / (1.0 + h * h);
    const double lnFByH = -2.0 * lnFcent[i] * h * spread * spread;
    const double lnFByLnPr = lnFByH * width[i] * inverseD * inverseD * (1.0 / std::numbers::ln10);
    const double hByLog10Fcent = (shift1[i] * d - u[i] * (width1[i] - slope[i] * shift1[i])) * inverseD * inverseD;
    const double lnFByLnFcent = spread + lnFByH * hByLog10Fcent * (1.0 / std::numbers::ln10);
    const double term3 = w3[i] * terms[i], term1 = w1[i] * terms[n + i], term2 = w2[i] * terms[2 * n + i];
    const double centre = term3 + term1 + term2 + centreSlope[i] * T_;
    const double centreByT = -inverseT3[i] * term3 - inverseT1[i] * term1 + T2[i] * T2Scale * term2 + centreSlope[i];
    const double lnFcentByT = centre > kTiny ? centreByT / (centre > kTiny ? centre : 1.0) : 0.0;
    const double lnPrByT = direction[i] * (byM[i] + byT[i] * inverseT) * inverseT;
    const double lnValueByLnPr = (direction[i] > 0 ? 1.0 : -pr[i]) / (1.0 + pr[i]) + lnFByLnPr;
    const double vanished = direction[i] > 0 ? 1.0 : 0.0;
    byM[i] = values[i] / pr[i] * ratio[i] * (pr[i] > kTiny ? lnValueByLnPr : vanished);
    byT[i] = values[i] * (lnValueByLnPr * lnPrByT + lnFByLnFcent * lnFcentByT + scaleExponent[i] * inverseT);
  }
}

}  // namespace lampblack::chemistry
