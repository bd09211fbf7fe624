// Cubic splines through a few values, continued by straight lines beyond their ends.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::chemistry {

class CubicSpline {
 public:
  // How the spline starts; it always ends without curvature.
  enum class Start { Straight, Flat };  // no curvature, no slope

  // Knots ascend; as many values as knots, at least two.
  CubicSpline(std::span<const double> knots, std::span<const double> values, Start start = Start::Straight)
      : x_(knots.begin(), knots.end()), y_(values.begin(), values.end()), curvature_(knots.size(), 0.0) {
    // Continuous slopes: a tridiagonal system for the second derivatives, eliminated downwards, then substituted back.
    const std::size_t last = x_.size() - 1;
    std::vector<double> factor(x_.size(), 0.0);
    if (start == Start::Flat) {
      const double h = x_[1] - x_[0];
      factor[0] = 0.5;
      curvature_[0] = 3.0 * (y_[1] - y_[0]) / (h * h);
    }
    for (std::size_t i = 1; i < last; ++i) {
      const double below = x_[i] - x_[i - 1], above = x_[i + 1] - x_[i];
      const double kink = 6.0 * ((y_[i + 1] - y_[i]) / above - (y_[i] - y_[i - 1]) / below);
      const double pivot = 2.0 * (below + above) - below * factor[i - 1];
      factor[i] = above / pivot;
      curvature_[i] = (kink - below * curvature_[i - 1]) / pivot;
    }
    curvature_[last] = 0.0;
    for (std::size_t i = last; i-- > 0;) curvature_[i] -= factor[i] * curvature_[i + 1];
  }

  double operator()(double x) const {
    if (x < x_.front()) return y_.front() + (x - x_.front()) * slopeAtStart();
    if (x > x_.back()) return y_.back() + (x - x_.back()) * slopeAtEnd();
    return (*this)(placeOf(x));
  }

  // A place between the first and the last knot, good for all splines with the same knots.
  struct Place {
    std::size_t lower;
    double a, b, c, d;  // weights of values and curvatures
  };
  Place placeOf(double x) const {
    const auto upper = static_cast<std::size_t>(std::upper_bound(x_.begin() + 1, x_.end() - 1, x) - x_.begin());
    const std::size_t lower = upper - 1;
    const double h = x_[upper] - x_[lower], a = (x_[upper] - x) / h, b = 1.0 - a;
    return {lower, a, b, h * h / 6.0 * (a * (a * a - 1.0)), h * h / 6.0 * (b * (b * b - 1.0))};
  }
  double operator()(const Place& p) const {
    return p.a * y_[p.lower] + p.b * y_[p.lower + 1] + p.c * curvature_[p.lower] + p.d * curvature_[p.lower + 1];
  }

 private:
  double slopeAtStart() const {
    const double h = x_[1] - x_[0];
    return (y_[1] - y_[0]) / h - h / 6.0 * (2.0 * curvature_[0] + curvature_[1]);
  }
  double slopeAtEnd() const {
    const std::size_t last = x_.size() - 1;
    const double h = x_[last] - x_[last - 1];
    return (y_[last] - y_[last - 1]) / h + h / 6.0 * (curvature_[last - 1] + 2.0 * curvature_[last]);
  }

  std::vector<double> x_, y_, curvature_;
};

}  // namespace lampblack::chemistry
