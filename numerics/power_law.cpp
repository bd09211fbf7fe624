#include "numerics/power_law.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace lampblack::numerics {

FittedLine fitPowerLaw(std::span<const double> x, std::span<const double> y) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> a, b;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!(x[i] > 0) || !(y[i] > 0) || !std::isfinite(y[i])) continue;
    a.push_back(std::log(x[i]));
    b.push_back(std::log(y[i]));
  }
  const auto n = static_cast<double>(a.size());
  if (a.size() < 2) return {nan, nan};
  double meanA = 0, meanB = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    meanA += a[i] / n;
    meanB += b[i] / n;
  }
  double aa = 0, ab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - meanA) * (a[i] - meanA);
    ab += (a[i] - meanA) * (b[i] - meanB);
  }
  if (!(aa > 0)) return {nan, nan};
  FittedLine line{ab / aa, nan};
  if (a.size() < 3) return line;
  double residual = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double away = b[i] - meanB - line.slope * (a[i] - meanA);
    residual += away * away;
  }
  line.slopeError = std::sqrt(residual / (n - 2) / aa);
  return line;
}

}  // namespace lampblack::numerics
