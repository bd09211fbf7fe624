// Paths of particles along walls, into them, along symmetries, through periodic sides and beside solids.
#include <gtest/gtest.h>

#include "paths_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

// Beside a wall without slip the velocity is that of a shear flow all the way down to the wall.
TEST(Paths, BesideAWallThatHoldsTheGas) {
  for (const MeshKind& kind : {meshKinds()[0], meshKinds()[2], meshKinds()[6]}) {
    MeshSpec spec;
    std::vector<BoundaryCondition> conditions;
    for (int axis = 0; axis < kind.dimension; ++axis) {
      spec.vertices[at(axis)] = uniformAxis(1.0, 8);
      for (const bool atMax : {false, true}) {
        Side s = axis == 1   ? side(BoundaryKind::Wall, axis, atMax)
                 : axis == 0 ? opening(BoundaryKind::Outlet, axis, atMax, 0.0, 300.0, nitrogen())
                             : side(BoundaryKind::Symmetry, axis, atMax);
        s.condition.slip = false;
        if (axis == 1 && atMax) s.condition.tangential = 1.0;
        spec.patches.push_back(s.patch);
        conditions.push_back(s.condition);
      }
    }
    if (kind.dimension == 3) conditions[3] = opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, nitrogen()).condition;
    Box box(spec, conditions, kind.split);
    const Flow flow = Flow::of(box, [](const Vector3& x) { return Vector3{x[1], 0.0, 0.0}; });
    const double z = kind.dimension == 3 ? 0.4 : 0.0;
    const Paths paths = flow.traceAll({{0.1, 0.01, z}, {0.1, 0.0, z}, {0.11, 0.3, z}}, 0.1, 50.0);
    ASSERT_EQ(paths.path[0].size(), 501U) << kind.name;
    EXPECT_NEAR(paths.path[0].back().position[0], 0.1 + 0.01 * 50.0, 1e-11) << kind.name;
    EXPECT_NEAR(paths.path[0].back().position[1], 0.01, 1e-12) << kind.name;
    ASSERT_EQ(paths.path[1].size(), 501U) << kind.name;  // on the wall itself
    EXPECT_NEAR(paths.path[1].back().position[0], 0.1, 1e-11) << kind.name;
    EXPECT_EQ(paths.path[2].size(), 30U) << kind.name;  // 0.89 m at 0.3 m/s
    EXPECT_EQ(paths.ends[2].patch, 1) << kind.name;
  }
}

// Still gas between a hot and a cold wall: particles go to the cold one, and end there.
TEST(Paths, EndAtACoolWall) {
  std::vector<Side> sides{side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true),
                          side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)};
  for (const std::size_t i : {0U, 1U}) {
    sides[i].condition.slip = false;
    sides[i].condition.isothermal = true;
    sides[i].condition.temperature = i == 0 ? 300.0 : 900.0;
  }
  const double size = 1e-3;
  Box box(Geometry::Planar, {uniformAxis(size, 9), uniformAxis(size, 5), {}}, sides);
  const Flow flow(
      box,
      [=](const Vector3& x) {
        return Box::Local{{}, 300.0 + 600.0 * x[0] / size, nitrogen()};
      },
      0.55);
  const Paths paths = flow.traceAll({{0.5 * size, 0.45 * size}}, 1e-4, 10.0);
  EXPECT_EQ(paths.ends[0].patch, 0);
  EXPECT_NEAR(paths.ends[0].place[0], 0.0, 1e-12 * size);
  EXPECT_NEAR(paths.ends[0].place[1], 0.45 * size, 1e-9 * size);
  // dx/dt = -K nu/T dT/dx, nu/T ~ T^0.7 beside the wall's 300 K and the start's 600 K; nu of nitrogen at 300 K is
  // 1.58e-5 m^2/s: between 0.5 mm at 0.0173 m/s and at 0.029.
  const double time = 1e-4 * static_cast<double>(paths.ends[0].points - 1);
  EXPECT_GT(time, 0.0005 / 0.030);
  EXPECT_LT(time, 0.0005 / 0.0165);
}

// A step that would go through a plane of symmetry goes along it instead.
TEST(Paths, SlideAlongASymmetry) {
  Box box = unitBox(meshKinds()[2], 6, BoundaryKind::Symmetry);
  const Flow flow = Flow::of(box, [](const Vector3&) { return Vector3{0.3, -1.0, 0.0}; });
  const Path path = flow.trace({0.2, 0.9, 0.0}, 1.0, 2.0);
  ASSERT_EQ(path.size(), 3U);
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_NEAR(path[i].position[0], 0.2 + 0.3 * static_cast<double>(i), 1e-12);
    EXPECT_NEAR(path[i].position[1], 0.0, 1e-12);
  }
}

// A flow through both pairs of sides of a periodic box, and across its corner: the path is in the box all the time.
TEST(Paths, GoThroughPeriodicSides) {
  for (const bool isInSpace : {false, true}) {
    MeshSpec spec;
    spec.vertices = {uniformAxis(1.0, 6), uniformAxis(0.8, 5), isInSpace ? uniformAxis(0.5, 4) : std::vector<double>{}};
    spec.periodic = {true, true, isInSpace};
    const std::array<double, 3> size{1.0, 0.8, 0.5};
    Box box(spec, {});
    const Vector3 velocity{0.9, -0.37, isInSpace ? 0.21 : 0.0}, start{0.5, 0.3, isInSpace ? 0.2 : 0.0};
    const Flow flow = Flow::of(box, [&](const Vector3&) { return velocity; });
    const Path path = flow.trace(start, 0.05, 10.0);
    ASSERT_EQ(path.size(), 201U);
    for (std::size_t i = 0; i < path.size(); ++i)
      for (std::size_t axis = 0; axis < (isInSpace ? 3U : 2U); ++axis) {
        const double exact = start[axis] + 0.05 * static_cast<double>(i) * velocity[axis];
        const double off = (path[i].position[axis] - exact) / size[axis];
        EXPECT_NEAR(off, std::round(off), 1e-11);
        EXPECT_GE(path[i].position[axis], -1e-12);
        EXPECT_LE(path[i].position[axis], size[axis] * (1.0 + 1e-12));
      }
  }
}

// Through the ends, and not back through the box, where a solid stands in the way.
TEST(Paths, GoThroughPeriodicSidesTheShortWay) {
  MeshSpec spec;
  spec.vertices = {uniformAxis(1.0, 10), uniformAxis(1.0, 4), {}};
  spec.periodic = {true, false, false};
  std::vector<BoundaryCondition> conditions;
  for (const bool atMax : {false, true}) {
    const Side s = side(BoundaryKind::Symmetry, 1, atMax);
    spec.patches.push_back(s.patch);
    conditions.push_back(s.condition);
  }
  spec.leftOut.push_back({{0.4, 0.0, -1.0}, {0.6, 1.0, 1.0}});
  spec.patches.push_back({"solid", 0, false, -1e300, 1e300, 0});
  conditions.push_back(side(BoundaryKind::Wall, 0, false).condition);
  Box box(spec, conditions);
  const Flow flow = Flow::of(box, [](const Vector3&) { return Vector3{1.0, 0.0, 0.0}; });
  for (const double dt : {0.02, 0.05, 0.1}) {
    const Paths paths = flow.traceAll({{0.87, 0.4, 0.0}}, dt, 0.3);
    EXPECT_EQ(paths.ends[0].patch, -1);
    EXPECT_NEAR(paths.path[0].back().position[0], 0.17, 1e-12);
  }
}

// Waves in a periodic box, where paths cross the sides, are as exact there as in its middle.
TEST(Paths, ThroughPeriodicSidesAreOfSecondOrder) {
  using std::numbers::pi;
  const auto wave = [](const Vector3& x) {
    return Vector3{1.0 + 0.3 * std::sin(2.0 * pi * x[0]), 0.2 * std::cos(2.0 * pi * x[0]), 0.0};
  };
  // dt = dx / (1 + 0.3 sin 2 pi x): a turn takes 1/sqrt(1 - 0.09); y comes back to where it was, as cos/(1 + 0.3 sin)
  // is odd about a crest.
  const double turn = 1.0 / std::sqrt(1.0 - 0.09);
  std::vector<double> errors;
  for (const int cells : {8, 16, 32}) {
    MeshSpec spec;
    spec.vertices = {uniformAxis(1.0, cells), uniformAxis(1.0, cells), {}};
    spec.periodic = {true, true, false};
    Box box(spec, {});
    const Path path = Flow::of(box, wave).trace({0.97, 0.4, 0.0}, turn / 400.0, turn);
    errors.push_back(std::hypot(path.back().position[0] - 0.97, path.back().position[1] - 0.4));
  }
  report(fmt::format("through periodic sides: {:.2e}, {:.2e}, {:.2e}", errors[0], errors[1], errors[2]));
  EXPECT_GT(errors[0] / errors[2], 10.0);
  EXPECT_LT(errors[2], 2e-3);
}

// Around a solid in the corner of a box, and on a box that is bent: linear velocities are exact on both.
TEST(Paths, OnBoxesWithSolidsAndBends) {
  MeshSpec spec;
  spec.vertices = {uniformAxis(1.0, 10), uniformAxis(1.0, 8), {}};
  std::vector<BoundaryCondition> conditions;
  for (int axis = 0; axis < 2; ++axis)
    for (const bool atMax : {false, true}) {
      const Side s = opening(BoundaryKind::Outlet, axis, atMax, 0.0, 300.0, nitrogen());
      spec.patches.push_back(s.patch);
      conditions.push_back(s.condition);
    }
  MeshSpec bent = spec, withSolid = spec;
  bent.map = [](const std::array<double, 3>& x) {
    return std::array{x[0], x[1] * (1.0 + 0.3 * x[0]) - 0.2 * x[0], 0.0};
  };
  withSolid.leftOut.push_back({{0.0, 0.0, -1.0}, {0.3, 0.25, 1.0}});
  Side solid = side(BoundaryKind::Wall, 0, false);
  withSolid.patches.push_back({"solid", 0, false, -1e300, 1e300, 0});
  std::vector<BoundaryCondition> withWall = conditions;
  withWall.push_back(solid.condition);
  const auto hyperbola = [](const Vector3& x) { return Vector3{x[0], -x[1], 0.0}; };
  Box first(bent, conditions), second(withSolid, withWall);
  for (Box* box : {&first, &second}) {
    const Path path = Flow::of(*box, hyperbola).trace({0.35, 0.9, 0.0}, 0.01, 0.8);
    ASSERT_EQ(path.size(), 81U);
    const double q = 0.01;
    EXPECT_NEAR(path.back().position[0], 0.35 * std::pow(1.0 + q + 0.5 * q * q, 80), 1e-10);
    EXPECT_NEAR(path.back().position[1], 0.9 * std::pow(1.0 - q + 0.5 * q * q, 80), 1e-10);
  }
  // Into the solid's side from the right.
  const Paths into = Flow::of(second, [](const Vector3&) {
                       return Vector3{-1.0, 0.0, 0.0};
                     }).traceAll({{0.8, 0.12, 0.0}}, 0.3, 3.0);
  EXPECT_EQ(into.ends[0].patch, 4);
  EXPECT_NEAR(into.ends[0].place[0], 0.3, 1e-12);
}

}  // namespace
}  // namespace lampblack::test
