#include "numerics/monotone_cubic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack::numerics {
namespace {

// Slope at the end of three points whose neighbouring slopes are a (at the end) and b, of intervals ha and hb: that of
// the parabola through them.
double endSlope(double ha, double hb, double a, double b) {
  return ((2 * ha + hb) * a - ha * b) / (ha + hb);
}

}  // namespace

void monotoneSlopes(std::span<const double> x, std::span<const double> values, std::span<double> slopes) {
  const std::size_t n = x.size();
  const auto h = [&](std::size_t i) { return x[i + 1] - x[i]; };
  const auto secant = [&](std::size_t i) { return (values[i + 1] - values[i]) / h(i); };
  if (n == 2) {
    slopes[0] = slopes[1] = secant(0);
    return;
  }
  slopes[0] = endSlope(h(0), h(1), secant(0), secant(1));
  slopes[n - 1] = endSlope(h(n - 2), h(n - 3), secant(n - 2), secant(n - 3));
  for (std::size_t i = 1; i + 1 < n; ++i) slopes[i] = (h(i) * secant(i - 1) + h(i - 1) * secant(i)) / (h(i - 1) + h(i));
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double s = secant(i);
    // Against the secant (or flat): none. At a maximum or minimum this makes the slope zero from one side or the other.
    if (slopes[i] * s <= 0) slopes[i] = 0;
    if (slopes[i + 1] * s <= 0) slopes[i + 1] = 0;
    if (s == 0) continue;
    const double radius = std::hypot(slopes[i] / s, slopes[i + 1] / s);
    if (radius <= 3) continue;
    slopes[i] *= 3 / radius;
    slopes[i + 1] *= 3 / radius;
  }
}

MonotoneCubic::MonotoneCubic(std::vector<double> x, std::vector<double> values)
    : x_(std::move(x)), values_(std::move(values)), slopes_(x_.size()) {
  if (x_.size() < 2 || x_.size() != values_.size())
    throw InputError(fmt::format("a table needs two points or more and a value for each, found {} points and {} values",
                                 x_.size(), values_.size()));
  for (std::size_t i = 0; i < x_.size(); ++i) {
    if (!std::isfinite(x_[i]) || !std::isfinite(values_[i]))
      throw InputError(fmt::format("point {} of a table is not a finite number", i + 1));
    if (i > 0 && !(x_[i] > x_[i - 1]))
      throw InputError(fmt::format("the points of a table have to rise; {:.10g} follows {:.10g}", x_[i], x_[i - 1]));
  }
  monotoneSlopes(x_, values_, slopes_);
}

MonotoneCubic::Point MonotoneCubic::at(double x) const {
  if (x <= x_.front()) return {values_.front(), x < x_.front() ? 0.0 : slopes_.front()};
  if (x >= x_.back()) return {values_.back(), 0.0};
  const auto i = static_cast<std::size_t>(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin()) - 1;
  const double h = x_[i + 1] - x_[i], t = (x - x_[i]) / h, s = 1 - t;
  const double rise = values_[i + 1] - values_[i];
  return {values_[i] + rise * t * t * (3 - 2 * t) + h * t * s * (s * slopes_[i] - t * slopes_[i + 1]),
          6 * rise / h * t * s + slopes_[i] * s * (1 - 3 * t) + slopes_[i + 1] * t * (1 - 3 * s)};
}

}  // namespace lampblack::numerics
