// A plane of equal cells of 1 mm.
#pragma once

#include <mpi.h>

#include "core/mesh.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

inline MeshSpec plainBox(int nx, int ny) {
  MeshSpec spec;
  for (int i = 0; i <= nx; ++i) spec.vertices[0].push_back(1e-3 * i);
  for (int j = 0; j <= ny; ++j) spec.vertices[1].push_back(1e-3 * j);
  for (int axis = 0; axis < 2; ++axis)
    for (const bool atMax : {false, true}) spec.patches.push_back({"side", axis, atMax});
  return spec;
}

}  // namespace lampblack::test
