// Standard deviation of a weighted sample in one pass: running mean and sum of squared deviations (West 1979).
#pragma once

#include <cmath>
#include <cstddef>

#include "core/modules.hpp"
#include "numerics/lanes.hpp"

namespace lampblack::particles {

class WeightedDeviation {
 public:
  void add(double x, double weight) {
    weight_ += weight;
    const double step = x - mean_;
    mean_ += step * weight / weight_;
    square_ += weight * step * (x - mean_);
  }
  // Many at a time: their own mean and squares, put together with those so far (Chan, Golub, LeVeque 1983).
  void add(const double* x, const double* weights, std::size_t n) {
    const double weight = numerics::sumOf(weights, n);
    if (!(weight > 0)) return;
    double mean = 0, square = 0;
    for (std::size_t k = 0; k < n; ++k) mean += weights[k] * (x[k] - x[0]);
    mean = x[0] + mean / weight;
    for (std::size_t k = 0; k < n; ++k) square += weights[k] * (x[k] - mean) * (x[k] - mean);
    const double step = mean - mean_, share = weight / (weight_ + weight);
    mean_ += step * share;
    square_ += square + weight_ * share * step * step;
    weight_ += weight;
  }
  // exp of the deviation, where x are logarithms; 1 of nothing. Of equal x rounding may leave squares below zero.
  [[nodiscard]] double geometric() const {
    return weight_ > 0 && square_ > 0 ? std::exp(std::sqrt(square_ / weight_)) : 1.0;
  }

 private:
  double weight_ = 0, mean_ = 0, square_ = 0;
};

}  // namespace lampblack::particles
