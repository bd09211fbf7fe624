// What the tests of fields at vertices and of paths share: meshes of all kinds with any sides, and a flow in them whose
// paths are known.
#pragma once

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "flow/paths/streamline.hpp"
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

inline const std::vector<double>& nitrogen() {
  static const std::vector<double> Y = Gas::hydrogen().massFractions("N2: 1");
  return Y;
}

// A point of a path as all ranks know it.
struct Sample {
  Vector3 position{};
  double divergence = 0.0;
  friend bool operator==(const Sample&, const Sample&) = default;
};
using Path = std::vector<Sample>;
struct Paths {
  std::vector<Path> path;
  std::vector<PathEnd> ends;
};

class Flow {
 public:
  Flow(Box& box, const std::function<Box::Local(const Vector3&)>& local, double thermophoresis = 0.0)
      : box_(box), state_(box.state(local)) {
    properties.update(box.context, state_);
    lines.emplace(box.context, state_, properties, thermophoresis);
  }
  // Of a velocity in nitrogen at 300 K.
  static Flow of(Box& box, const std::function<Vector3(const Vector3&)>& velocity) {
    return {box, [&](const Vector3& x) { return Box::Local{velocity(x), 300.0, nitrogen()}; }};
  }

  Paths traceAll(const std::vector<Vector3>& starts, double dt, double duration) const {
    const TracedPaths traced = lines->trace(starts, dt, duration);
    Paths all{{}, traced.ends};
    for (const PathEnd& end : traced.ends) all.path.emplace_back(at(end.points));
    for (const PathPoint& p : traced.points) {
      EXPECT_LT(p.place.cell, box_.mesh.owned);
      all.path[at(p.path)].at(at(p.step)) = {p.position, p.divergence};
    }
    // What no other rank has is zero there.
    for (Path& path : all.path)
      MPI_Allreduce(MPI_IN_PLACE, path.data(), static_cast<int>(4 * path.size()), MPI_DOUBLE, MPI_SUM, box_.mesh.comm);
    return all;
  }
  Path trace(const Vector3& start, double dt, double duration) const {
    return traceAll({start}, dt, duration).path.front();
  }

  GasProperties properties;
  std::optional<Streamlines> lines;

 private:
  Box& box_;
  State state_;
};

}  // namespace lampblack::test
