#include "chemistry/kinetics_falloff.hpp"

#include <cmath>

#include "chemistry/vector_math.hpp"

namespace lampblack {

namespace {

constexpr double kLn10 = 2.30258509299404568402;
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
  for (auto* array : {&ratio_, &lnFcent_, &shift_, &width_, &lnScale_, &pr_, &values_}) array->assign(n, 0.0);
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
    const double centre = f.w3[i] * terms[i] + f.w1[i] * terms[n + i] + f.w2[i] * terms[2 * n + i];
    lnFcent[i] = centre > kTiny ? centre : kTiny;
  }
  logInPlace(lnFcent, n);
  for (std::size_t i = 0; i < n; ++i) {
    const double log10Fcent = lnFcent[i] * (1.0 / kLn10);
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
  double* __restrict values = values_.data();
  for (std::size_t i = 0; i < n; ++i) {
    const double u = vectormath::logOne(pr[i]) * (1.0 / kLn10) + shift[i];
    const double h = u / (width[i] - slope[i] * u);
    const double F = vectormath::expOne(lnScale[i] + lnFcent[i] / (1.0 + h * h));
    values[i] = F * (direction[i] > 0 ? pr[i] : 1.0) / (1.0 + pr[i]);
  }
  return values_;
}

FalloffFactors::Slope FalloffFactors::slope(const KineticsTables& tables, std::size_t i, double M) const {
  const auto& f = tables.falloff;
  const std::size_t n = ratio_.size(), r = f.reaction[i];
  const bool activated = f.direction[i] < 0;
  const double pr = pr_[i], lnFcent = lnFcent_[i];
  const double u = vectormath::logOne(pr) / kLn10 + shift_[i];
  const double d = width_[i] - f.slope[i] * u;
  const double h = u / d, spread = 1.0 + h * h;
  const double lnFByH = -2.0 * lnFcent * h / (spread * spread);
  const double lnFByLnPr = lnFByH * width_[i] / (d * d) / kLn10;
  const double hByLog10Fcent = (f.shift1[i] * d - u * (f.width1[i] - f.slope[i] * f.shift1[i])) / (d * d);
  const double lnFByLnFcent = 1.0 / spread + lnFByH * hByLog10Fcent / kLn10;
  const double centre = f.w3[i] * terms_[i] + f.w1[i] * terms_[n + i] + f.w2[i] * terms_[2 * n + i];
  const double centreByT = -f.w3[i] * f.inverseT3[i] * terms_[i] - f.w1[i] * f.inverseT1[i] * terms_[n + i] +
                           f.w2[i] * f.T2[i] / (T_ * T_) * terms_[2 * n + i];
  const double lnFcentByT = centre > kTiny ? centreByT / centre : 0.0;
  const double lnPrByT = f.direction[i] * ((f.b[i] - tables.b[r]) / T_ + (f.Ta[i] - tables.Ta[r]) / (T_ * T_));
  const double lnValueByLnPr = (activated ? -pr : 1.0) / (1.0 + pr) + lnFByLnPr;
  Slope slope;
  slope.byT = values_[i] * (lnValueByLnPr * lnPrByT + lnFByLnFcent * lnFcentByT + f.scaleExponent[i] / T_);
  if (pr > kTiny)
    slope.byM = values_[i] * lnValueByLnPr / M;
  else if (!activated)
    slope.byM = values_[i] / pr * ratio_[i];
  return slope;
}

}  // namespace lampblack
