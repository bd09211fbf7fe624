// Pressure projection: the divergence asked for, on every cell, whatever the density.
#include "flow/equations/projection.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

std::vector<Side> sides(BoundaryKind top) {
  const auto air = Gas::hydrogen().massFractions("O2: 0.21, N2: 0.79");
  return {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true),
          opening(BoundaryKind::Inlet, 1, false, 0.3, 300.0, air), opening(top, 1, true, 0.0, 300.0, air)};
}

Axes graded() {
  return {gradedAxis(0.0, {{0.01, 14, 3.0}}), gradedAxis(0.0, {{0.03, 18, 0.4}})};
}

std::vector<BoundaryData> nothingKnown(const Box& box) {
  return std::vector<BoundaryData>(at(box.mesh.boundaryFaces()), BoundaryData::Nothing);
}

class ProjectionOn : public testing::TestWithParam<Geometry> {};

TEST_P(ProjectionOn, GivesTheDivergenceAskedForWithVariableDensity) {
  Box box(GetParam(), graded(), sides(BoundaryKind::Outlet));
  const Mesh& m = box.mesh;
  const double tolerance = 1e-9;
  Projection projection(box.context, nothingKnown(box), {.ofFlow = tolerance});
  std::vector<double> divergence(at(m.owned));
  std::vector<double> pressure(at(m.cells), 0.0);
  std::vector<double> velocity(at(m.faces), 0.0);
  std::vector<double> inverseDensity(at(m.faces));
  double smallest = 1e300;
  for (int c = 0; c < m.owned; ++c) {
    divergence[at(c)] = 50.0 * std::sin(300.0 * m.centre[at(c)][0] + 100.0 * m.centre[at(c)][1]);
    smallest = std::min(smallest, m.volume[at(c)]);
  }
  double flowScale = 0.0;
  for (int face = 0; face < m.faces; ++face) {
    const auto& x = m.faceCentre[at(face)];
    inverseDensity[at(face)] = x[1] > 0.015 ? 8.0 : 1.0;
    if (m.high[at(face)] >= 0) velocity[at(face)] = std::sin(1000.0 * x[0]) + std::cos(700.0 * x[1]);
    if (m.high[at(face)] < 0 && box.context.boundaryOf(face).kind == BoundaryKind::Inlet) velocity[at(face)] = -0.3;
    flowScale = std::max(flowScale, std::abs(m.area[at(face)] * velocity[at(face)]));
  }
  const std::vector<double> before = velocity;
  const auto result = projection.solve(1e-4, inverseDensity, divergence, velocity, pressure);
  // The solver's criterion is the 2-norm of all cells' flow errors, which bounds that of any cell.
  const double bound = 1.01 * tolerance * maxOverRanks(flowScale) / minOverRanks(smallest);
  EXPECT_LE(result.continuityError, bound);
  EXPECT_GT(result.iterations, 0);

  std::vector<double> net(at(m.owned), 0.0);
  for (int face = 0; face < m.faces; ++face) {
    const double flow = m.area[at(face)] * velocity[at(face)];
    if (m.low[at(face)] < m.owned) net[at(m.low[at(face)])] += flow;
    if (m.high[at(face)] >= 0 && m.high[at(face)] < m.owned) net[at(m.high[at(face)])] -= flow;
    // What is prescribed stays.
    if (m.high[at(face)] < 0 && box.context.boundaryOf(face).kind != BoundaryKind::Outlet) {
      EXPECT_EQ(velocity[at(face)], before[at(face)]);
    }
  }
  EXPECT_LE(largest(m, [&](int c) { return std::abs(net[at(c)] / m.volume[at(c)] - divergence[at(c)]); }), bound);

  // What has the divergence already is left alone.
  const std::vector<double> once = velocity;
  std::fill(pressure.begin(), pressure.end(), 0.0);
  EXPECT_EQ(projection.solve(1e-4, inverseDensity, divergence, velocity, pressure).iterations, 0);
  EXPECT_EQ(velocity, once);
}

INSTANTIATE_TEST_SUITE_P(Geometries, ProjectionOn, testing::Values(Geometry::Planar, Geometry::Axisymmetric));

// One that is to leave a share of what it was given leaves no more, and not much less.
TEST(Projection, LeavesAShareOfWhatThereWas) {
  Box box(Geometry::Planar, graded(), sides(BoundaryKind::Outlet));
  const Mesh& m = box.mesh;
  Projection projection(box.context, nothingKnown(box), {.ofLeft = 0.1});
  const std::vector<double> inverseDensity(at(m.faces), 1.0);
  std::vector<double> divergence(at(m.owned)), pressure(at(m.cells), 0.0), velocity(at(m.faces), 0.0);
  for (int c = 0; c < m.owned; ++c) divergence[at(c)] = 50.0 * std::sin(300.0 * m.centre[at(c)][0]);
  const auto left = [&] {
    std::vector<double> flows(at(m.owned));
    for (int c = 0; c < m.owned; ++c) flows[at(c)] = divergence[at(c)] * m.volume[at(c)];
    for (int face = 0; face < m.faces; ++face)
      for (const bool isLow : {true, false})
        if (const int c = isLow ? m.low[at(face)] : m.high[at(face)]; c >= 0 && c < m.owned)
          flows[at(c)] -= (isLow ? 1.0 : -1.0) * m.area[at(face)] * velocity[at(face)];
    double sum = 0.0;
    for (const double flow : flows) sum += flow * flow;
    return std::sqrt(sumOverRanks(sum));
  };
  const double before = left();
  projection.solve(1e-4, inverseDensity, divergence, velocity, pressure);
  EXPECT_LE(left(), 0.101 * before);
  EXPECT_GT(left(), 1e-5 * before);
}

// Velocities that a pressure without curvature has made are taken back, on cells without order, too: with its slopes
// along the steps alone they would not be.
class ProjectionOnSkewed : public testing::TestWithParam<Cells> {};

TEST_P(ProjectionOnSkewed, TakesBackWhatALinearPressureHasMade) {
  const auto air = Gas::hydrogen().massFractions("O2: 0.21, N2: 0.79");
  Box box(Geometry::Planar, {uniformAxis(0.01, 9), uniformAxis(0.015, 12), {}},
          {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Symmetry, 0, true),
           side(BoundaryKind::Wall, 1, false), opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)},
          Gas::hydrogen(), Split{GetParam()});
  const Mesh& m = box.mesh;
  ASSERT_TRUE(m.isOblique());
  std::vector<BoundaryData> known;
  std::vector<double> velocity(at(m.faces), 0.0), pressure(at(m.cells), 0.0);
  const std::vector<double> inverseDensity(at(m.faces), 0.8), divergence(at(m.owned), 0.0);
  constexpr double dt = 1e-4, slope = 250.0;
  for (int face = 0; face < m.faces; ++face) {
    const bool isInside = m.high[at(face)] >= 0;
    const BoundaryKind kind = isInside ? BoundaryKind::Wall : box.context.boundaryOf(face).kind;
    if (!isInside)
      known.push_back(kind == BoundaryKind::Outlet     ? BoundaryData::Value
                      : kind == BoundaryKind::Symmetry ? BoundaryData::ZeroSlope
                                                       : BoundaryData::Nothing);
    if (isInside || kind == BoundaryKind::Outlet) velocity[at(face)] = dt * 0.8 * slope * m.normal[at(face)][1];
  }
  Projection projection(box.context, known);
  const auto result = projection.solve(dt, inverseDensity, divergence, velocity, pressure);
  EXPECT_LT(result.continuityError, 1e-4);  // 1/s, of some 1e1
  for (const double u : velocity) EXPECT_NEAR(u, 0.0, 1e-7);
  for (int c = 0; c < m.owned; ++c) EXPECT_NEAR(pressure[at(c)], slope * (m.centre[at(c)][1] - 0.015), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ProjectionOnSkewed,
                         testing::Values(Cells::Quadrilaterals, Cells::Triangles, Cells::MixedPlane));

// Without an outlet the level of the pressure is free: the changes have the mean zero.
TEST(Projection, OfAClosedVesselHasThePressureItsDivergenceNeeds) {
  Box box(Geometry::Planar, graded(), sides(BoundaryKind::Wall));
  const Mesh& m = box.mesh;
  std::vector<double> velocity(at(m.faces), 0.0), pressure(at(m.cells), 0.0), divergence(at(m.owned), 0.0);
  const std::vector<double> inverseDensity(at(m.faces), 0.8);
  for (int face = 0; face < m.interiorFaces; ++face)
    velocity[at(face)] = std::sin(1e3 * m.centre[at(m.low[at(face)])][0]) + (axisOf(m, face) == 0 ? 0.1 : 0.3);
  const auto result =
      Projection(box.context, nothingKnown(box)).solve(1e-4, inverseDensity, divergence, velocity, pressure);
  EXPECT_GT(result.iterations, 0);
  EXPECT_LT(result.continuityError, 1e-4);  // 1/s, of some 1e3
  double sum = 0.0, magnitude = 0.0;
  for (int c = 0; c < m.owned; ++c) sum += pressure[at(c)], magnitude += std::abs(pressure[at(c)]);
  EXPECT_GT(sumOverRanks(magnitude), 0.0);
  EXPECT_LT(std::abs(sumOverRanks(sum)), 1e-9 * sumOverRanks(magnitude));
}

}  // namespace
}  // namespace lampblack::test
