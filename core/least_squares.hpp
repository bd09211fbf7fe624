// A gradient from the differences to values around a place, by least squares weighted with the inverse third power of
// the distance: the gradient is the sum of weight(d) times the difference over d. With that power two values on a line
// with the place give the slope of the parabola through all three, whatever their distances, so that a graded box has
// gradients of second order.
//
// Distances count by how far the values lie in their direction altogether: as if the cells around were drawn out or
// pressed to be as wide as long. Else a long cell's slope along it would come from the near values across it, which lie
// a little to its sides, with an error as many times larger as the cell is longer than that little.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/vector3.hpp"

namespace lampblack {

class LeastSquares {
 public:
  static constexpr std::size_t mostValues = 6;

  void add(const Vector3& d) { differences_[count_++] = d; }
  // Before the first weight. In directions in which there is no value the gradient is zero.
  void finish(int dimension);
  [[nodiscard]] Vector3 weight(const Vector3& d) const { return scaled(times(inverse_, d), share(d)); }

 private:
  using Matrix = std::array<Vector3, 3>;
  static Vector3 times(const Matrix& m, const Vector3& d) { return {dot(m[0], d), dot(m[1], d), dot(m[2], d)}; }
  [[nodiscard]] double share(const Vector3& d) const {
    const double square = dot(d, times(metric_, d));
    return 1.0 / (square * std::sqrt(square));
  }

  std::array<Vector3, mostValues> differences_{};
  std::size_t count_ = 0;
  Matrix metric_{};
  Matrix inverse_{};
};

}  // namespace lampblack
