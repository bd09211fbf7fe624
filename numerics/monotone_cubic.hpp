// The piecewise cubic that rises and falls with its data and has continuous slopes (Fritsch and Carlson, SIAM J. Numer.
// Anal. 17 (1980) 238-246).
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::numerics {

// Slopes of the cubic at its points: parabolas' slopes, made smaller where they leave the circle of radius 3 (their
// eq. 4.1 ff). At least two points x, rising; all of one length.
void monotoneSlopes(std::span<const double> x, std::span<const double> values, std::span<double> slopes);

class MonotoneCubic {
 public:
  struct Point {
    double value = 0, slope = 0;
  };

  MonotoneCubic() = default;
  // InputError where there are fewer than two points, they do not rise, or a number is not finite.
  MonotoneCubic(std::vector<double> x, std::vector<double> values);

  [[nodiscard]] Point at(double x) const;  // constant before the first point and after the last
  [[nodiscard]] const std::vector<double>& points() const { return x_; }
  [[nodiscard]] const std::vector<double>& values() const { return values_; }

 private:
  std::vector<double> x_, values_, slopes_;
};

}  // namespace lampblack::numerics
