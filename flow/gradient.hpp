// Cell gradients by a parabola through the neighbouring values along each axis: second order on graded meshes.
#pragma once

#include <span>
#include <vector>

#include "core/mesh.hpp"
#include "core/rooms.hpp"

namespace lampblack::flow {

class Gradient {
 public:
  explicit Gradient(const Mesh& mesh);

  // Gradient of `components` values a cell (halo filled) in the owned cells: gradient[(cell * components + k) * 2 +
  // axis]. `boundary` holds the value at each boundary face (components a face); boundary faces in `skip` (empty: none;
  // else one flag a boundary face) are left out, which makes the slope there one-sided.
  void compute(std::span<const double> values, std::span<const double> boundary, int components,
               std::span<double> gradient, std::span<const char> skip = {}) const;

 private:
  const Mesh& mesh_;
};

}  // namespace lampblack::flow
