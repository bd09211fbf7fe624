#include "chemistry/kinetics/kinetics_pressure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack::chemistry {

namespace {

// The two points around lnP and the weight of the second; beyond the ends both are the same point.
struct Interval {
  std::size_t lower = 0, upper = 0;
  double weight = 0;
};

Interval findInterval(const KineticsTables::PressureLog& table, std::size_t i, double lnP) {
  const auto first = table.lnPressure.begin() + static_cast<std::ptrdiff_t>(table.points[i]);
  const auto last = table.lnPressure.begin() + static_cast<std::ptrdiff_t>(table.points[i + 1]);
  const auto above = std::upper_bound(first, last, lnP);
  if (above == first) return {table.points[i], table.points[i], 0};
  const auto upper = static_cast<std::size_t>(above - table.lnPressure.begin());
  if (above == last) return {upper - 1, upper - 1, 0};
  return {upper - 1, upper, (lnP - *(above - 1)) / (*above - *(above - 1))};
}

}  // namespace

PressureRates::PressureRates(const KineticsTables& tables)
    : lnRates_(tables.pressureLog.lnA.size()), lnPoints_(tables.pressureLog.lnPressure.size()) {
  std::size_t sums = 0;
  for (const auto numP : tables.chebyshev.numP) {
    chebyFirst_.push_back(sums);
    sums += numP;
  }
  chebySums_.assign(sums, 0.0);
  chebySlopes_.assign(sums, 0.0);
}

void PressureRates::setTemperature(const KineticsTables& tables, double T, double lnT) {
  T_ = T;
  const double inverseT = 1.0 / T;
  const auto& p = tables.pressureLog;
  for (std::size_t e = 0; e < lnRates_.size(); ++e) lnRates_[e] = p.lnA[e] + p.b[e] * lnT - p.Ta[e] * inverseT;
  for (std::size_t i = 0; i < p.reaction.size(); ++i)
    for (std::size_t j = p.points[i]; j < p.points[i + 1]; ++j) {
      const std::size_t begin = p.rates[j], end = p.rates[j + 1];
      if (end == begin + 1) {
        lnPoints_[j] = lnRates_[begin];
        continue;
      }
      const double largest = *std::max_element(lnRates_.begin() + static_cast<std::ptrdiff_t>(begin),
                                               lnRates_.begin() + static_cast<std::ptrdiff_t>(end));
      double sum = 0;
      for (std::size_t e = begin; e < end; ++e) sum += p.sign[e] * std::exp(lnRates_[e] - largest);
      if (!(sum > 0))
        throw NumericsError(
            fmt::format("{}: the rate constants at {:.6g} Pa add up to {:.4g} at {} K; expected a "
                        "positive sum",
                        p.where[i], std::exp(p.lnPressure[j]), sum * std::exp(largest), T));
      lnPoints_[j] = largest + std::log(sum);
    }
  const auto& c = tables.chebyshev;
  for (std::size_t i = 0; i < c.reaction.size(); ++i) {
    const double x = c.scaleT[i] * inverseT + c.shiftT[i], xByT = -c.scaleT[i] * inverseT * inverseT;
    double* sums = chebySums_.data() + chebyFirst_[i];
    double* slopes = chebySlopes_.data() + chebyFirst_[i];
    const double* a = c.coefficients.data() + c.first[i];
    std::fill_n(sums, c.numP[i], 0.0);
    std::fill_n(slopes, c.numP[i], 0.0);
    // First kind T_n and second kind U_n: dT_n/dx = n U_(n-1).
    double t = 1, tNext = x, u = 0, uNext = 1;
    for (std::size_t n = 0; n < c.numT[i]; ++n, a += c.numP[i]) {
      const double slope = static_cast<double>(n) * u * xByT;
      for (std::size_t j = 0; j < c.numP[i]; ++j) {
        sums[j] += a[j] * t;
        slopes[j] += a[j] * slope;
      }
      const double tAfter = 2 * x * tNext - t, uAfter = 2 * x * uNext - u;
      t = tNext;
      tNext = tAfter;
      u = uNext;
      uNext = uAfter;
    }
  }
}

double PressureRates::logarithmic(const KineticsTables& tables, std::size_t i, double lnP) const {
  const auto at = findInterval(tables.pressureLog, i, lnP);
  return lnPoints_[at.lower] + at.weight * (lnPoints_[at.upper] - lnPoints_[at.lower]);
}

double PressureRates::chebyshev(const KineticsTables& tables, std::size_t i, double lnP) const {
  const auto& c = tables.chebyshev;
  const double x = c.scaleP[i] * lnP + c.shiftP[i];
  const double* sums = chebySums_.data() + chebyFirst_[i];
  double value = 0, t = 1, next = x;
  for (std::size_t j = 0; j < c.numP[i]; ++j) {
    value += sums[j] * t;
    const double after = 2 * x * next - t;
    t = next;
    next = after;
  }
  return value;
}

double PressureRates::pointSlope(const KineticsTables::PressureLog& table, std::size_t point) const {
  double sum = 0;
  for (std::size_t e = table.rates[point]; e < table.rates[point + 1]; ++e)
    sum += table.sign[e] * std::exp(lnRates_[e] - lnPoints_[point]) * (table.b[e] + table.Ta[e] / T_) / T_;
  return sum;
}

PressureRates::Slope PressureRates::logarithmicSlope(const KineticsTables& tables, std::size_t i, double lnP) const {
  const auto& p = tables.pressureLog;
  const auto at = findInterval(p, i, lnP);
  Slope slope;
  slope.byT = pointSlope(p, at.lower);
  if (at.upper == at.lower) return slope;
  slope.byLnP = (lnPoints_[at.upper] - lnPoints_[at.lower]) / (p.lnPressure[at.upper] - p.lnPressure[at.lower]);
  slope.byT += at.weight * (pointSlope(p, at.upper) - slope.byT);
  return slope;
}

PressureRates::Slope PressureRates::chebyshevSlope(const KineticsTables& tables, std::size_t i, double lnP) const {
  const auto& c = tables.chebyshev;
  const double x = c.scaleP[i] * lnP + c.shiftP[i];
  const double* sums = chebySums_.data() + chebyFirst_[i];
  const double* slopes = chebySlopes_.data() + chebyFirst_[i];
  Slope slope;
  double t = 1, tNext = x, u = 0, uNext = 1;
  for (std::size_t j = 0; j < c.numP[i]; ++j) {
    slope.byT += slopes[j] * t;
    slope.byLnP += sums[j] * static_cast<double>(j) * u * c.scaleP[i];
    const double tAfter = 2 * x * tNext - t, uAfter = 2 * x * uNext - u;
    t = tNext;
    tNext = tAfter;
    u = uNext;
    uNext = uAfter;
  }
  return slope;
}

}  // namespace lampblack::chemistry
