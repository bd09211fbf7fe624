#include "chemistry/transport/collision_integrals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "chemistry/transport/monchick_mason_tables.hpp"
#include "chemistry/transport/polynomial_fit.hpp"

namespace lampblack::chemistry {

namespace {

using monchickMason::Table;
using Column = std::array<double, monchickMason::temperatures.size()>;
using Row = std::array<double, monchickMason::dipoles.size()>;

Column logarithms(const Column& values) {
  Column result;
  std::transform(values.begin(), values.end(), result.begin(), [](double value) { return std::log(value); });
  return result;
}

// What every entry of a row contributes to the value at one dipole moment: a spline is linear in its values.
Row weightsAt(double dipole) {
  Row weights;
  for (std::size_t j = 0; j < weights.size(); ++j) {
    Row unit{};
    unit[j] = 1.0;
    weights[j] = CubicSpline(monchickMason::dipoles, unit, CubicSpline::Start::Flat)(dipole);
  }
  return weights;
}

Column columnAt(const Table& table, double dipole) {
  const Row weights = weightsAt(dipole);
  Column column{};
  for (std::size_t i = 0; i < column.size(); ++i)
    for (std::size_t j = 0; j < weights.size(); ++j) column[i] += weights[j] * table[i][j];
  return column;
}

const Column kLogTemperatures = logarithms(monchickMason::temperatures);
const double kColdest = kLogTemperatures.front();
const double kHottest = kLogTemperatures.back();

// The same with the entries from T* = 0.5 up replaced by a polynomial through them.
Column smoothed(Column column) {
  constexpr std::size_t first = 4, count = column.size() - first, terms = 9;
  static_assert(monchickMason::temperatures[first] == 0.5);
  std::array<double, count> s;
  const double coldest = kLogTemperatures[first];
  for (std::size_t i = 0; i < count; ++i)
    s[i] = (2.0 * kLogTemperatures[first + i] - coldest - kHottest) / (kHottest - coldest);
  std::array<double, terms> a;
  PolynomialFit(s, terms).solve(std::span(column).subspan(first), a);
  for (std::size_t i = 0; i < count; ++i) {
    double sum = 0;
    for (std::size_t m = terms; m-- > 0;) sum = sum * s[i] + a[m];
    column[first + i] = sum;
  }
  return column;
}

CubicSpline splineOf(const Column& column) {
  return {kLogTemperatures, column};
}

double wangFit(const std::array<double, 6>& a, double logT, double dipole) {
  const double T = std::exp(logT);
  const double nonpolar = a[0] * std::exp(-a[1] * logT) + std::pow(T + a[2], -a[3]);
  const double polar = (std::exp(a[4] / T) - std::exp(-a[5] / T)) * dipole * dipole / (2.0 + 2.5 * dipole);
  return nonpolar * (1.0 + polar);
}

}  // namespace

ReducedIntegrals::ReducedIntegrals(double reducedDipole, CollisionIntegrals source)
    : dipole_(std::min(std::abs(reducedDipole), largestDipole)),
      source_(source),
      logOmega22_(splineOf(logarithms(columnAt(monchickMason::omega22, dipole_)))),
      ratioA_(splineOf(smoothed(columnAt(monchickMason::ratioA, dipole_)))),
      ratioB_(splineOf(smoothed(columnAt(monchickMason::ratioB, dipole_)))),
      ratioC_(splineOf(smoothed(columnAt(monchickMason::ratioC, dipole_)))) {}

double ReducedIntegrals::omega11(double logT) const {
  if (source_ == CollisionIntegrals::WangFits)
    return wangFit({1.0548, 0.15504, 0.55909, 2.1705, 0.093193, 1.5}, logT, dipole_);
  return std::exp(logOmega22_(logT)) / ratioA_(std::max(logT, kColdest));
}

double ReducedIntegrals::omega22(double logT) const {
  if (source_ == CollisionIntegrals::WangFits)
    return wangFit({1.0413, 0.11930, 0.43628, 1.6041, 0.095661, 2.0}, logT, dipole_);
  return std::exp(logOmega22_(logT));
}

double ReducedIntegrals::ratioA(double logT) const {
  if (source_ == CollisionIntegrals::WangFits) return omega22(logT) / omega11(logT);
  return ratioA_(std::max(logT, kColdest));
}

double ReducedIntegrals::ratioB(double logT) const {
  return ratioB_(std::clamp(logT, kColdest, kHottest));
}

double ReducedIntegrals::ratioC(double logT) const {
  return ratioC_(std::clamp(logT, kColdest, kHottest));
}

ReducedIntegrals::All ReducedIntegrals::all(double logT) const {
  if (source_ == CollisionIntegrals::WangFits || !(logT >= kColdest && logT <= kHottest))
    return {omega11(logT), ratioA(logT), ratioB(logT), ratioC(logT)};
  const auto place = logOmega22_.placeOf(logT);
  const double A = ratioA_(place);
  return {std::exp(logOmega22_(place)) / A, A, ratioB_(place), ratioC_(place)};
}

}  // namespace lampblack::chemistry
