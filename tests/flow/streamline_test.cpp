// Trajectories through analytic velocity fields.
#include "flow/streamline.hpp"

#include <gtest/gtest.h>

#include "flow_fixture.hpp"
#include "tests/every_room.hpp"

namespace lampblack::test {
namespace {

constexpr double strain = 100.0;  // 1/s
constexpr double radius = 0.02;
constexpr double height = 0.01;

class Counterflow : public testing::Test {
 protected:
  std::vector<double> n2 = Gas::hydrogen().massFractions("N2: 1");
  // Graded, so that bilinear weights are not all halves.
  Box box{
      Geometry::Axisymmetric,
      {gradedAxis(0.0, {{radius, 20, 3.0}}), gradedAxis(-height, {{height, 30, 0.5}})},
      {side(BoundaryKind::Symmetry, 0, false), opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, n2),
       opening(BoundaryKind::Inlet, 1, false, 0.1, 300.0, n2), opening(BoundaryKind::Inlet, 1, true, 0.1, 300.0, n2)}};

  // u_r = a r / 2, u_z = -a z: free of divergence, linear, so that bilinear interpolation is exact inside the outermost
  // cell centres.
  Streamlines lines(double temperatureSlope = 0.0, double thermophoresis = 0.0, double axial = strain) {
    const State state = box.state([&](const Vector3& x) {
      return Box::Local{{0.5 * strain * x[0], -axial * x[1]}, 600.0 + temperatureSlope * x[1], n2};
    });
    properties.update(box.context, state);
    return {box.mesh, state, properties, thermophoresis};
  }
  GasProperties properties;
};

TEST_F(Counterflow, PathConvergesToTheExactOneAtSecondOrder) {
  const Streamlines flow = lines();
  const std::array<double, 2> start{0.001, 0.006};
  const double duration = 0.02;  // strain times duration: 2
  double error[3];
  for (int i = 0; i < 3; ++i) {
    const double dt = duration / (20 << i);
    const auto path = flow.trace(start, dt, duration);
    ASSERT_EQ(path.size(), at((20 << i) + 1));
    EXPECT_NEAR(path.back().time, duration, 1e-12 * duration);
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
    for (const auto& point : lines(0.0, 0.0, axial).trace({0.0005, 0.008}, 1e-4, 0.01))
      EXPECT_NEAR(point.divergence, exact, 1e3 * epsilon * strain);
}

TEST_F(Counterflow, PathEndsAtTheOutflow) {
  // Leaves at r = R after ln(R/r0)/(a/2); the speed there is a R/2. Beyond the outermost centre the velocity is
  // constant, at most half a cell's worth slower.
  const double dt = 1e-4;
  const auto path = lines().trace({0.002, 0.004}, dt, 1.0);
  const double leaves = std::log(10.0) / (0.5 * strain);
  EXPECT_LT(path.back().position[0], radius);
  EXPECT_GT(path.back().position[0], radius - 1.1 * dt * 0.5 * strain * radius);
  EXPECT_NEAR(path.back().time, leaves, 0.02 * leaves);
  EXPECT_GT(path.back().position[1], 0.0);  // the stagnation plane is never crossed
}

TEST_F(Counterflow, AxisIsAStreamline) {
  const auto path = lines().trace({0.0, 0.008}, 1e-4, 0.02);
  EXPECT_EQ(path.size(), 201U);
  for (const auto& point : path) EXPECT_EQ(point.position[0], 0.0);
}

TEST_F(Counterflow, ThermophoresisAddsItsDrift) {
  const double K = 0.55;
  const double slope = 1e4;  // K/m
  const auto with = lines(slope, K);
  const auto without = lines(slope, 0.0);
  const auto place = with.locate({0.005, 0.001});
  const double nu = properties.viscosity[0];  // checked below through the field itself
  EXPECT_GT(nu, 0.0);
  const double drift = place.of(with.velocity(), 2, 1) - place.of(without.velocity(), 2, 1);
  const double T = 600.0 + slope * 0.001;
  std::vector<double> X(n2.size());
  std::vector<double> D(n2.size());
  Gas& gas = Gas::hydrogen();
  gas.thermo.massToMole(n2, X);
  const double viscosity = gas.transport.mixture(T, 101325.0, X, D).viscosity;
  const double exact = -K * viscosity / gas.thermo.density(T, 101325.0, n2) * slope / T;
  // Bilinear between cells of at most 1 mm: the curvature of nu/T ~ T^0.7, 0.7*0.3/2 (dT/T)^2 / 4, below 1e-4.
  EXPECT_NEAR(drift / exact, 1.0, 1e-4);
  EXPECT_EQ(place.of(with.velocity(), 2, 0), place.of(without.velocity(), 2, 0));
}

}  // namespace
}  // namespace lampblack::test
