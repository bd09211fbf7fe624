// Paths of particles through velocity fields whose paths are known, on meshes of all kinds.
#include "flow/streamline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "core/errors.hpp"
#include "paths_fixture.hpp"
#include "tests/every_room.hpp"

namespace lampblack::test {
namespace {

const std::vector<double>& nitrogen() {
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

constexpr double strain = 100.0;  // 1/s
constexpr double radius = 0.02;
constexpr double height = 0.01;

class Counterflow : public testing::Test {
 protected:
  // Graded, so that weights are not all halves.
  Box box{Geometry::Axisymmetric,
          {gradedAxis(0.0, {{radius, 20, 3.0}}), gradedAxis(-height, {{height, 30, 0.5}}), {}},
          {side(BoundaryKind::Symmetry, 0, false), opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, nitrogen()),
           opening(BoundaryKind::Outlet, 1, false, 0.0, 300.0, nitrogen()),
           opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, nitrogen())}};

  // u_r = a r / 2, u_z = -a z: free of divergence, linear, so that it is exact at every place.
  Flow flow(double temperatureSlope = 0.0, double thermophoresis = 0.0, double axial = strain) {
    return {box,
            [=](const Vector3& x) {
              return Box::Local{{0.5 * strain * x[0], -axial * x[1]}, 600.0 + temperatureSlope * x[1], nitrogen()};
            },
            thermophoresis};
  }
};

TEST_F(Counterflow, PathConvergesToTheExactOneAtSecondOrder) {
  const Flow lines = flow();
  const Vector3 start{0.001, 0.006};
  const double duration = 0.02;  // strain times duration: 2
  double error[3];
  for (int i = 0; i < 3; ++i) {
    const Path path = lines.trace(start, duration / (20 << i), duration);
    ASSERT_EQ(path.size(), at((20 << i) + 1));
    const double r = start[0] * std::exp(0.5 * strain * duration);
    const double z = start[1] * std::exp(-strain * duration);
    error[i] = std::max(std::abs(path.back().position[0] / r - 1.0), std::abs(path.back().position[1] / z - 1.0));
  }
  // Global error of the midpoint rule for u' = -a u: (a dt)^2/6 * a t, to leading order.
  EXPECT_NEAR(error[2], std::pow(strain * duration / 80, 2) / 6.0 * strain * duration, 0.1 * error[2]);
  EXPECT_GT(error[0] / error[1], 3.4);
  EXPECT_GT(error[1] / error[2], 3.6);
}

TEST_F(Counterflow, DivergenceOfAPathIsThatOfTheField) {
  // u_z = -2a z instead: divergence a/2 + a/2 - 2a = -a. Differences of a linear field are exact to round-off.
  for (const auto& [axial, exact] : {std::pair{strain, 0.0}, std::pair{2.0 * strain, -strain}})
    for (const Sample& point : flow(0.0, 0.0, axial).trace({0.0005, 0.008}, 1e-4, 0.01))
      EXPECT_NEAR(point.divergence, exact, 1e4 * epsilon * strain);
}

TEST_F(Counterflow, PathEndsAtTheOutflow) {
  // Leaves at r = R after ln(R/r0)/(a/2), up to a step and the rule's error, (a/2 dt)^2/6 of the time; the speed there
  // is a R/2.
  const double dt = 1e-4;
  const Paths paths = flow().traceAll({{0.002, 0.004}}, dt, 1.0);
  const Sample& last = paths.path[0].back();
  const double leaves = std::log(10.0) / (0.5 * strain), time = dt * static_cast<double>(paths.path[0].size() - 1);
  EXPECT_LT(last.position[0], radius);
  EXPECT_GT(last.position[0], radius - 1.1 * dt * 0.5 * strain * radius);
  EXPECT_LT(time, leaves + 1e-5 * leaves);
  EXPECT_GT(time, leaves - 1.01 * dt);
  EXPECT_GT(last.position[1], 0.0);  // the stagnation plane is never crossed
  EXPECT_EQ(paths.ends[0].patch, 1);
  EXPECT_NEAR(paths.ends[0].place[0], radius, 1e-12 * radius);
}

TEST_F(Counterflow, AxisIsAStreamline) {
  const Path path = flow().trace({0.0, 0.008}, 1e-4, 0.02);
  EXPECT_EQ(path.size(), 201U);
  for (const Sample& point : path) EXPECT_NEAR(point.position[0], 0.0, epsilon * radius);
}

// Close to the axis the radial velocity is in proportion to the radius: r grows by the same factor as anywhere.
TEST_F(Counterflow, BesideTheAxisTheRadiusGrowsAsElsewhere) {
  const double dt = 1e-4;
  const Path path = flow().trace({1e-6, 0.008}, dt, 0.01);
  const double q = 0.5 * strain * dt;
  for (std::size_t i = 0; i < path.size(); ++i)
    EXPECT_NEAR(path[i].position[0], 1e-6 * std::pow(1.0 + q + 0.5 * q * q, i), 1e-16);
}

TEST_F(Counterflow, ThermophoresisAddsItsDrift) {
  const double K = 0.55;
  const double slope = 1e4;  // K/m
  const Vector3 at{0.005, 0.001};
  const FoundCells found = findCells(box.mesh, std::vector{at});
  const Flow with = flow(slope, K), without = flow(slope, 0.0);
  if (found.cell[0] < 0) return;  // another rank's
  const PlaceInCell place = placeInCell(box.mesh, found.cell[0], at);
  const Vector3 drift = difference(with.lines->velocityAt(place), without.lines->velocityAt(place));
  const double T = 600.0 + slope * at[1];
  std::vector<double> X(nitrogen().size()), D(X.size());
  Gas& gas = Gas::hydrogen();
  gas.thermo.massToMole(nitrogen(), X);
  const double viscosity = gas.transport.mixture(T, 101325.0, X, D).viscosity;
  const double exact = -K * viscosity / gas.thermo.density(T, 101325.0, nitrogen()) * slope / T;
  // Linear between centres and vertices of cells of at most 1 mm: the curvature of nu/T ~ T^0.7, 0.7*0.3/2 (dT/T)^2 /
  // 4, below 1e-4.
  EXPECT_NEAR(drift[1] / exact, 1.0, 1e-4);
  EXPECT_NEAR(drift[0], 0.0, 1e-15);
}

TEST_F(Counterflow, AStartOutsideIsRefused) {
  const Flow lines = flow();
  EXPECT_THAT(
      [&] {
        static_cast<void>(lines.trace({0.5, 0.0}, 1e-4, 1e-2));
      },
      testing::ThrowsMessage<InputError>(testing::HasSubstr("a path cannot start at (0.5, 0) m")));
}

// Around the vortex's middle, for most of a turn, through many cells and ranks; the exact path is that of the field.
TEST(Paths, AreOfSecondOrderInTheWidthOfTheCells) {
  const Vector3 start{0.3, 0.62, 0.2};
  constexpr double time = 2.0;
  std::map<int, Vector3> exact;
  for (const int d : {2, 3}) exact[d] = vortexPath({start[0], start[1], d == 3 ? start[2] : 0.0}, d, time);
  for (const MeshKind& kind : meshKinds()) {
    const int d = kind.dimension;
    std::vector<double> errors;
    for (const int cells : d == 2 ? std::vector{8, 16, 32} : std::vector{6, 12}) {
      Box box = unitBox(kind, cells, BoundaryKind::Symmetry);
      const Flow flow = Flow::of(box, [d](const Vector3& x) { return vortex(x, d); });
      const Path path = flow.trace({start[0], start[1], d == 3 ? start[2] : 0.0}, 0.005, time);
      ASSERT_EQ(path.size(), 401U) << kind.name;
      errors.push_back(length(difference(path.back().position, exact[d])));
    }
    const double order = std::log2(errors.front() / errors.back()) / (static_cast<double>(errors.size()) - 1.0);
    report(fmt::format("{}: errors {:.2e} to {:.2e}, order {:.2f}", kind.name, errors.front(), errors.back(), order));
    EXPECT_GT(order, 1.6) << kind.name;
    EXPECT_LT(errors.back(), 0.03) << kind.name;
  }
}

// To the last bit: rounds through other ranks change nothing. With starts in all parts of the mesh, paths that turn
// about the middle several times.
TEST(Paths, AreTheSameOnAnyNumberOfRanks) {
  for (const MeshKind& kind : meshKinds()) {
    const int d = kind.dimension;
    std::vector<Vector3> starts;
    for (std::int64_t i = 0; i < 7; ++i)
      starts.push_back({0.5 + 0.45 * noise(i, 0), 0.5 + 0.45 * noise(i, 1), d == 3 ? 0.5 + 0.45 * noise(i, 2) : 0.0});
    const auto trace = [&](MPI_Comm comm) {
      Box box = unitBox(kind, 6, BoundaryKind::Symmetry, comm);
      return Flow(
                 box,
                 [d](const Vector3& x) {
                   return Box::Local{vortex(x, d), 400.0 + 100.0 * x[0] * x[1], nitrogen()};
                 },
                 0.55)
          .traceAll(starts, 0.01, 6.0);
    };
    const Paths all = trace(MPI_COMM_WORLD), one = trace(MPI_COMM_SELF);
    for (std::size_t i = 0; i < starts.size(); ++i) {
      EXPECT_EQ(all.path[i].size(), 601U) << kind.name;
      EXPECT_EQ(all.path[i], one.path[i]) << kind.name;
    }
  }
}

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
