// The part alpha, in (0, 1], of the real particles of the smaller of two weights that takes part in a coagulation of
// two weighted particles (Jiang and Chan 2021). The pair then coagulates at max(w_i, w_j) / alpha times the kernel
// (Wang 2025, eqs. 4-5, 5-5), and alpha min(w_i, w_j) of each do.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/population/monte_carlo_options.hpp"

namespace lampblack::particles {

class FractionLaw {
 public:
  // Throws InputError for a constant outside (0, 1].
  FractionLaw(FractionFunction function, FractionOf of, double constant)
      : function_(function), of_(of), constant_(constant) {
    if (function == FractionFunction::constant && !(constant > 0 && constant <= 1)) {
      throw InputError("the constant of the fraction function has to be above 0 and at most 1");
    }
  }

  // Wang (2025), eqs. 4-11 to 4-14, 5-4; of the volumes or the weights.
  [[nodiscard]] double operator()(double vi, double vj, double wi, double wj) const {
    if (function_ == FractionFunction::one) return 1;
    if (function_ == FractionFunction::constant) return constant_;
    const double a = of_ == FractionOf::volumes ? vi : wi, b = of_ == FractionOf::volumes ? vj : wj;
    const double smaller = std::min(a, b), larger = std::max(a, b);
    switch (function_) {
      case FractionFunction::hyperbolic:
        return larger / (larger + smaller);
      case FractionFunction::exponential:
        return 1 - std::exp2(-larger / smaller);
      default:
        return larger <= 2 * smaller ? 0.5 : 1;
    }
  }

  // max(w_i, w_j) / alpha, the factor of the kernel.
  [[nodiscard]] double rate(double vi, double vj, double wi, double wj) const {
    // One division less, and the sum to the last bit of its bound.
    if (function_ == FractionFunction::hyperbolic && of_ == FractionOf::weights) return wi + wj;
    return std::max(wi, wj) / (*this)(vi, vj, wi, wj);
  }

  // The least F with rate <= F (w_i + w_j). With x = max/min >= 1 of the weights, F bounds x / (alpha (1 + x)):
  // hyperbolic 1 + 1/x over 1 + 1/x; exponential x / ((1 - 2^-x) (1 + x)) <= 1 as 1 + x <= 2^x; stepwise 2x / (1 + x)
  // up to x = 2. Where alpha knows only volumes, x is arbitrary and 1/alpha at most 2.
  [[nodiscard]] double bound() const {
    switch (function_) {
      case FractionFunction::one:
        return 1;
      case FractionFunction::constant:
        return 1 / constant_;
      case FractionFunction::stepwise:
        return of_ == FractionOf::weights ? 4.0 / 3 : 2;
      default:
        return of_ == FractionOf::weights ? 1 : 2;
    }
  }

 private:
  FractionFunction function_;
  FractionOf of_;
  double constant_;
};

}  // namespace lampblack::particles
