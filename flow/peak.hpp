// The largest value over the cells of a mesh, and where it is.
#pragma once

#include <functional>

#include "core/mesh.hpp"
#include "core/modules.hpp"

namespace lampblack::flow {

struct Peak {
  double value = 0.0;
  Vector3 place{};  // m, the cell's centre
};

// Collective. Of values that are not negative, one for each owned cell.
[[nodiscard]] Peak peakOf(const Mesh& mesh, const std::function<double(int cell)>& value);

}  // namespace lampblack::flow
