// Moments of broken order from those of whole order: ln M is interpolated by the Lagrange polynomial through ln M_0 ...
// ln M_(n-1) (Frenklach and Harris 1987; Frenklach 2002). Exact for log-normal distributions.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::particles {

// Lagrange's weights of the points 0 ... count-1 at x.
[[nodiscard]] std::vector<double> lagrangeWeights(std::size_t count, double x);

// Moments of the orders j/6.
struct BrokenMoments {
  static constexpr std::size_t most = 72;
  int lowest = 0;
  std::array<double, most> values;
  [[nodiscard]] double at(int sixths) const { return values[static_cast<std::size_t>(sixths - lowest)]; }
};

class MomentInterpolation {
 public:
  static constexpr std::size_t mostMoments = 8;

  // Orders from `lowest`/6 to `highest`/6, `count` whole moments.
  MomentInterpolation(std::size_t count, int lowest, int highest);

  [[nodiscard]] std::size_t count() const { return count_; }

  // Of these moments, all above zero.
  void interpolate(std::span<const double> moments, BrokenMoments& broken) const;

  // The same with what is known of the moments of any population of sizes above `smallest` (whose logarithm is given):
  // ln M is a convex function of the order, and its slope is at least ln(smallest). The polynomial knows neither and
  // may violate both where the distribution is far from log-normal; here it is put back to the nearest value that does
  // not. Logarithms that are not convex themselves are a caller's error, but stay bounded.
  void interpolateWithin(std::span<const double> logarithms, double logSmallest, BrokenMoments& broken) const;

 private:
  [[nodiscard]] double polynomial(std::size_t order, const double* logarithms) const;

  std::size_t count_;
  int lowest_;
  std::vector<std::array<double, mostMoments>> weights_;
};

}  // namespace lampblack::particles
