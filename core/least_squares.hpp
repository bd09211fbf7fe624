// A gradient from the differences to values around a place, by least squares weighted with the inverse third power of
// the distance: the gradient is the sum of weight(d) times the difference over d. With that power two values on a line
// with the place give the slope of the parabola through all three, whatever their distances, so that a graded box has
// gradients of second order.
#pragma once

#include <array>

#include "core/vector3.hpp"

namespace lampblack {

class LeastSquares {
 public:
  void add(const Vector3& d);
  // Before the first weight. In directions in which there is no value the gradient is zero.
  void finish(int dimension);
  [[nodiscard]] Vector3 weight(const Vector3& d) const {
    const double size = length(d), share = 1.0 / (size * size * size);
    Vector3 w{};
    for (std::size_t i = 0; i < 3; ++i) w[i] = share * dot(inverse_[i], d);
    return w;
  }

 private:
  using Matrix = std::array<Vector3, 3>;
  Matrix sum_{};
  Matrix inverse_{};
};

}  // namespace lampblack
