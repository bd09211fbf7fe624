// Mean and scatter of numbers that come one by one (Welford 1962), and of the ratio of two.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace lampblack {

class RunningMean {
 public:
  void add(double value) {
    ++count_;
    const double away = value - mean_;
    mean_ += away / static_cast<double>(count_);
    squares_ += away * (value - mean_);
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] double mean() const {  // NaN of nothing
    return count_ > 0 ? mean_ : std::numeric_limits<double>::quiet_NaN();
  }
  [[nodiscard]] double standardError() const {  // NaN of fewer than two
    if (count_ < 2) return std::numeric_limits<double>::quiet_NaN();
    const auto n = static_cast<double>(count_);
    return std::sqrt(squares_ / (n - 1) / n);
  }

 private:
  std::size_t count_ = 0;
  double mean_ = 0, squares_ = 0;
};

// The ratio of the sum of x to that of n, with the standard error of its linearisation (Cochran 1977, section 6.4).
class RunningRatio {
 public:
  void add(double n, double x) {
    ++count_;
    const auto count = static_cast<double>(count_);
    const double awayN = n - meanN_, awayX = x - meanX_;
    meanN_ += awayN / count;
    meanX_ += awayX / count;
    nn_ += awayN * (n - meanN_);
    xx_ += awayX * (x - meanX_);
    nx_ += awayN * (x - meanX_);
  }
  [[nodiscard]] double ratio() const {  // NaN where the sum of n is zero
    return meanN_ != 0 ? meanX_ / meanN_ : std::numeric_limits<double>::quiet_NaN();
  }
  [[nodiscard]] double standardError() const {  // NaN of fewer than two
    if (count_ < 2 || meanN_ == 0) return std::numeric_limits<double>::quiet_NaN();
    const double r = ratio(), n = static_cast<double>(count_);
    const double squares = std::max(0.0, xx_ - 2 * r * nx_ + r * r * nn_);
    return std::sqrt(squares / (n - 1) / n) / std::abs(meanN_);
  }

 private:
  std::size_t count_ = 0;
  double meanN_ = 0, meanX_ = 0, nn_ = 0, xx_ = 0, nx_ = 0;
};

}  // namespace lampblack
