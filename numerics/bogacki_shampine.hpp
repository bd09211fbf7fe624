// One step of y' = f(y) by the explicit pair of orders 3 and 2 of Bogacki and Shampine (1989), for systems that are not
// stiff over the time asked for: four evaluations, no matrix. Whether the step can be trusted is judged from its error
// and from the largest eigenvalue that its own stages show (Hairer and Wanner, IV.2); where it cannot, an implicit
// method has to take it. Linear invariants of f, as elements, are kept to round-off.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::numerics {

class BogackiShampine {
 public:
  // Whether y has been advanced over h, its error being below `relative` times (|y| + smallest) in the root mean square
  // over the unknowns; else y is as it was.
  template <typename Rates>
  bool step(const Rates& rates, double h, std::span<double> y, double relative, std::span<const double> smallest) {
    const std::size_t n = y.size();
    for (std::vector<double>* v : {&k1_, &k2_, &k3_, &k4_, &late_, &end_}) v->resize(n);
    rates(y, k1_);
    for (std::size_t i = 0; i < n; ++i) late_[i] = y[i] + 0.5 * h * k1_[i];
    rates(late_, k2_);
    for (std::size_t i = 0; i < n; ++i) late_[i] = y[i] + 0.75 * h * k2_[i];
    rates(late_, k3_);
    for (std::size_t i = 0; i < n; ++i) end_[i] = y[i] + h * (2 * k1_[i] + 3 * k2_[i] + 4 * k3_[i]) / 9;
    rates(end_, k4_);
    double error = 0, moved = 0, answered = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double scale = 1 / (relative * (std::max(std::abs(y[i]), std::abs(end_[i])) + smallest[i]));
      const auto square = [scale](double x) { return x * scale * (x * scale); };
      error += square(h * (-5 * k1_[i] / 72 + k2_[i] / 12 + k3_[i] / 9 - k4_[i] / 8));
      moved += square(end_[i] - late_[i]);
      answered += square(h * (k4_[i] - k3_[i]));
    }
    const auto count = static_cast<double>(n);
    // Not finite is not below.
    if (!(error <= count) || !(answered <= stable * stable * moved + roundOff * count)) return false;
    std::copy(end_.begin(), end_.end(), y.begin());
    return true;
  }

 private:
  static constexpr double stable = 1.5;     // h times the largest eigenvalue; the method's limit is 2.5
  static constexpr double roundOff = 1e-6;  // squared changes, over those allowed, too small to tell an eigenvalue from

  std::vector<double> k1_, k2_, k3_, k4_, late_, end_;
};

}  // namespace lampblack::numerics
