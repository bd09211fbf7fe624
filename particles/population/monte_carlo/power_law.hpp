// rate * v^exponent, as breakage and deposition have it, without a power where the exponent is 0, 1 or 2.
#pragma once

#include <cmath>

#include "core/modules.hpp"

namespace lampblack::particles {

class PowerLaw {
 public:
  PowerLaw() = default;
  PowerLaw(double rate, double exponent) : rate_(rate), exponent_(exponent) {}
  [[nodiscard, gnu::always_inline]] double operator()(double v) const {
    if (exponent_ == 0) return rate_;
    if (exponent_ == 1) return rate_ * v;
    if (exponent_ == 2) return rate_ * v * v;
    return rate_ * std::pow(v, exponent_);
  }

 private:
  double rate_ = 0, exponent_ = 0;
};

}  // namespace lampblack::particles
