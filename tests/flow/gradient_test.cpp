// Cell gradients and the limited interpolation to faces.
#include "flow/gradient.hpp"

#include <gtest/gtest.h>

#include <random>

#include "flow/limiter.hpp"
#include "flow_fixture.hpp"
#include "tests/every_room.hpp"

namespace lampblack::test {
namespace {

using Function = std::function<double(double, double)>;

std::vector<Side> fourSides() {
  return {side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true), side(BoundaryKind::Wall, 1, false),
          side(BoundaryKind::Outlet, 1, true)};
}

// Smooth gradings whose ratio of neighbouring cells tends to one under refinement.
Box gradedBox(int refinement) {
  return {Geometry::Planar,
          {gradedAxis(0.0, {{0.4, 6, 3.0}, {1.0, 5, 0.5}}, refinement), gradedAxis(-0.5, {{0.5, 8, 0.25}}, refinement)},
          fourSides()};
}

// Largest error of both components of the gradient of `f`, whose exact derivatives are dx and dy. Boundary values are
// exact, or left out (`skip`).
double gradientError(Box& box, const Function& f, const Function& dx, const Function& dy, bool skip = false) {
  const Mesh& m = box.mesh;
  std::vector<double> values(at(m.cells));
  std::vector<double> boundary(at(m.boundaryFaces()));
  std::vector<double> gradient(at(2 * m.cells));
  for (int c = 0; c < m.cells; ++c) values[at(c)] = f(m.centre[at(c)][0], m.centre[at(c)][1]);
  for (int b = 0; b < m.boundaryFaces(); ++b) {
    const auto& x = m.faceCentre[at(m.interiorFaces + b)];
    boundary[at(b)] = skip ? std::numeric_limits<double>::quiet_NaN() : f(x[0], x[1]);
  }
  const std::vector<char> flags(at(m.boundaryFaces()), 1);
  Gradient(m).compute(values, boundary, 1, gradient, skip ? std::span<const char>(flags) : std::span<const char>{});
  return largest(m, [&](int c) {
    const auto& x = m.centre[at(c)];
    return std::max(std::abs(gradient[at(2 * c)] - dx(x[0], x[1])), std::abs(gradient[at(2 * c + 1)] - dy(x[0], x[1])));
  });
}

TEST(Gradient, LinearFieldIsExactOnGradedMesh) {
  Box box = gradedBox(1);
  const auto f = [](double x, double y) { return 3.0 - 2.0 * x + 5.0 * y; };
  const auto dx = [](double, double) { return -2.0; };
  const auto dy = [](double, double) { return 5.0; };
  // Differences of values below 8 over distances above 0.02: round-off is 8/0.02 epsilons, twice for both ends.
  const double tolerance = 1000.0 * epsilon;
  EXPECT_LT(gradientError(box, f, dx, dy), tolerance);
  EXPECT_LT(gradientError(box, f, dx, dy, true), tolerance) << "without the boundary's values";
}

TEST(Gradient, ParabolaIsExactOnGradedMesh) {
  Box box = gradedBox(1);
  EXPECT_LT(gradientError(
                box, [](double x, double y) { return x * x - 3.0 * y * y; }, [](double x, double) { return 2.0 * x; },
                [](double, double y) { return -6.0 * y; }),
            1000.0 * epsilon);
}

TEST(Gradient, SmoothFieldConvergesAtSecondOrder) {
  double error[3];
  for (int i = 0; i < 3; ++i) {
    Box box = gradedBox(1 << i);
    error[i] = gradientError(
        box, [](double x, double y) { return std::sin(3.0 * x) * std::exp(y); },
        [](double x, double y) { return 3.0 * std::cos(3.0 * x) * std::exp(y); },
        [](double x, double y) { return std::sin(3.0 * x) * std::exp(y); });
  }
  // Halving h divides a second-order error by 4, a first-order one by 2; half-way (in the order) lies 2.83.
  EXPECT_GT(error[0] / error[1], 2.83);
  EXPECT_GT(error[1] / error[2], 3.4);
}

TEST(LimitedFaceValue, LinearDataIsExact) {
  for (double slope : {-3.0, 0.0, 0.7})
    for (double fraction : {0.2, 0.5, 0.8})
      EXPECT_NEAR(limitedFaceValue(1.0, 1.0 + slope, slope, fraction), 1.0 + slope * fraction, 8.0 * epsilon);
}

TEST(LimitedFaceValue, LiesBetweenTheNeighboursForAnyData) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  std::uniform_real_distribution<double> fraction(0.0, 0.5);
  int sloped = 0;
  for (int i = 0; i < 100000; ++i) {
    const double up = value(random);
    const double down = value(random);
    const double slope = 3.0 * value(random);
    const double face = limitedFaceValue(up, down, slope, fraction(random));
    ASSERT_GE(face, std::min(up, down) - epsilon) << up << ' ' << down << ' ' << slope;
    ASSERT_LE(face, std::max(up, down) + epsilon) << up << ' ' << down << ' ' << slope;
    sloped += face != up;
  }
  EXPECT_GT(sloped, 10000);  // it is not the upwind scheme
}

TEST(LimitedFaceValue, IsUpwindAtExtrema) {
  // Uniform mesh, upup = 2 up - ... : the central slope (down - upup)/2 of a peak and of a trough at `up`.
  EXPECT_EQ(limitedFaceValue(1.0, 0.4, 0.5 * (0.4 - 0.2), 0.5), 1.0);
  EXPECT_EQ(limitedFaceValue(-1.0, 0.4, 0.5 * (0.4 - 0.2), 0.5), -1.0);
  EXPECT_EQ(limitedFaceValue(1.0, 1.0, 0.3, 0.5), 1.0);
}

}  // namespace
}  // namespace lampblack::test
