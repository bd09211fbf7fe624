// What the tests of fields at vertices and of paths share: meshes of all kinds with any sides, and a flow in them whose
// paths are known.
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "flow_fixture.hpp"

namespace lampblack::test {

struct MeshKind {
  std::string name;
  int dimension = 2;
  std::optional<Split> split;
};
inline std::vector<MeshKind> meshKinds() {
  return {{"box", 2, {}},
          {"quadrilaterals", 2, Split{Cells::Quadrilaterals}},
          {"triangles", 2, Split{Cells::Triangles}},
          {"mixed", 2, Split{Cells::MixedPlane}},
          {"box in space", 3, {}},
          {"hexahedra", 3, Split{Cells::Hexahedra}},
          {"tetrahedra", 3, Split{Cells::Tetrahedra}},
          {"mixed in space", 3, Split{Cells::MixedSpace}}};
}

// The unit square or cube with the same on every side.
inline Box unitBox(const MeshKind& kind, int cells, BoundaryKind sides, MPI_Comm comm = MPI_COMM_WORLD) {
  MeshSpec spec;
  std::vector<BoundaryCondition> conditions;
  for (int axis = 0; axis < kind.dimension; ++axis) {
    spec.vertices[at(axis)] = uniformAxis(1.0, cells);
    for (const bool atMax : {false, true}) {
      const Side s = opening(sides, axis, atMax, 0.0, 300.0, Gas::hydrogen().massFractions("N2: 1"));
      spec.patches.push_back(s.patch);
      conditions.push_back(s.condition);
    }
  }
  return {spec, conditions, kind.split, comm};
}

// A vortex in the unit square, through no side; in space it drifts upwards, nowhere through a side either. Its paths
// turn about the middle.
inline Vector3 vortex(const Vector3& x, int dimension) {
  using std::numbers::pi;
  return {std::sin(pi * x[0]) * std::cos(pi * x[1]), -std::cos(pi * x[0]) * std::sin(pi * x[1]),
          dimension == 3 ? 0.3 * std::sin(pi * x[2]) : 0.0};
}
// Where a path of it is after a time, by Kutta's rule of fourth order with steps so small that only round-off is left.
inline Vector3 vortexPath(Vector3 x, int dimension, double time) {
  constexpr int steps = 4000;
  const double h = time / steps;
  for (int i = 0; i < steps; ++i) {
    const Vector3 a = vortex(x, dimension);
    const Vector3 b = vortex(sum(x, scaled(a, 0.5 * h)), dimension);
    const Vector3 c = vortex(sum(x, scaled(b, 0.5 * h)), dimension);
    const Vector3 d = vortex(sum(x, scaled(c, h)), dimension);
    x = sum(x, scaled(sum(sum(a, scaled(sum(b, c), 2.0)), d), h / 6.0));
  }
  return x;
}

}  // namespace lampblack::test
