// A square of cells between four walls.
#pragma once

#include <vector>

#include "tests/every_module.hpp"
#include "tests/flow/flow_fixture.hpp"

namespace lampblack::test {

inline std::vector<BoundaryCondition> fourWalls() {
  std::vector<BoundaryCondition> conditions;
  for (const int axis : {0, 1})
    for (const bool atMax : {false, true}) conditions.push_back(side(BoundaryKind::Wall, axis, atMax).condition);
  return conditions;
}

// `length` in m, cells along both axes.
inline MeshSpec closedBox(double length, int nx, int ny) {
  MeshSpec spec;
  spec.vertices = {uniformAxis(length, nx), uniformAxis(length, ny), {}};
  for (const BoundaryCondition& wall : fourWalls())
    spec.patches.push_back({wall.name, wall.name[0] == 'x' ? 0 : 1, wall.name.ends_with("max")});
  return spec;
}

}  // namespace lampblack::test
