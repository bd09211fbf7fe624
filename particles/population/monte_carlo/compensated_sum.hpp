// A running sum without loss: what rounding takes from it is kept in a second number (Neumaier 1974).
#pragma once

#include <cmath>

#include "core/modules.hpp"

namespace lampblack::particles {

class CompensatedSum {
 public:
  explicit CompensatedSum(double value = 0) : sum_(value) {}
  void add(double x) {
    const double sum = sum_ + x;
    rest_ += std::abs(sum_) >= std::abs(x) ? (sum_ - sum) + x : (x - sum) + sum_;
    sum_ = sum;
  }
  [[nodiscard]] double value() const { return sum_ + rest_; }

 private:
  double sum_, rest_ = 0;
};

}  // namespace lampblack::particles
