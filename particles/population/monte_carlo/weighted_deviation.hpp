// Standard deviation of a weighted sample in one pass: running mean and sum of squared deviations (West 1979).
#pragma once

#include <cmath>

#include "core/rooms.hpp"

namespace lampblack::particles {

class WeightedDeviation {
 public:
  void add(double x, double weight) {
    weight_ += weight;
    const double step = x - mean_;
    mean_ += step * weight / weight_;
    square_ += weight * step * (x - mean_);
  }
  // exp of the deviation, where x are logarithms; 1 of nothing. Of equal x rounding may leave squares below zero.
  [[nodiscard]] double geometric() const {
    return weight_ > 0 && square_ > 0 ? std::exp(std::sqrt(square_ / weight_)) : 1.0;
  }

 private:
  double weight_ = 0, mean_ = 0, square_ = 0;
};

}  // namespace lampblack::particles
