// Paths of particles through velocity fields whose paths are known, on meshes of all kinds.
#include "flow/paths/streamline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "core/errors.hpp"
#include "paths_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

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

}  // namespace
}  // namespace lampblack::test
