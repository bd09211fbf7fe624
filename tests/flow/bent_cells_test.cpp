// Thin cells around a bend: their steps miss the faces' centres by many times the cells' height.
#include <gtest/gtest.h>

#include "flow/discretisation/velocity_gradient.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

constexpr double bendRadius = 1e-2, layers = 2e-4;  // m

// Layers around a centre, `along` cells a radian, the last `ratio` times as long as the first.
Box ringOfLayers(int along, double ratio = 1.0) {
  MeshSpec spec;
  spec.vertices = {gradedAxis(0.0, {{1.0, along, ratio}}), uniformAxis(layers, 20), {}};
  std::vector<BoundaryCondition> conditions;
  for (int axis = 0; axis < 2; ++axis)
    for (const bool atMax : {false, true}) {
      const Side s = side(BoundaryKind::Symmetry, axis, atMax);
      spec.patches.push_back(s.patch);
      conditions.push_back(s.condition);
    }
  spec.map = [](const std::array<double, 3>& x) {
    const double r = bendRadius + x[1], angle = x[0] - 0.5;
    return std::array<double, 3>{r * std::sin(angle), r * std::cos(angle), 0.0};
  };
  return {spec, conditions};
}

// Of a velocity along the layers that grows from each to the next: the largest error of its first component at faces
// across the layers, over what it grows by. It grows with the distance from the centre, or cells of a layer, whose
// centres lie nearer to it than their sides, have the same.
template <typename Value>
double errorAtFaces(int along, bool isOfLayers, const Value& valueAt) {
  Box box = ringOfLayers(along);
  const Mesh& m = box.mesh;
  const auto alongLayer = [&](const Vector3& x, double speed) {
    return Vector3{speed * x[1] / length(x), -speed * x[0] / length(x), 0.0};
  };
  std::vector<double> velocity;
  for (int c = 0; c < m.cells; ++c) {
    const auto layer = static_cast<double>(m.naturalCell[at(c)] / along);
    const double height = (length(m.centre[at(c)]) - bendRadius) / layers;
    for (int i = 0; i < 2; ++i)
      velocity.push_back(alongLayer(m.centre[at(c)], isOfLayers ? (layer + 0.5) / 20 : height)[at(i)]);
  }
  VelocityGradient gradient(box.context);
  gradient.setBoundary(velocity);
  gradient.compute(velocity);
  gradient.updateHalo();
  double worst = 0.0;
  for (int face = 0; face < m.interiorFaces; ++face) {
    const Vector3& centre = m.faceCentre[at(face)];
    const double height = (length(centre) - bendRadius) / layers;
    const bool isAcross = std::abs(dot(m.normal[at(face)], centre)) < 0.5 * length(centre);
    if (!isAcross || std::abs(std::atan2(centre[0], centre[1])) > 0.3 || height < 0.1 || height > 0.9) continue;
    const double w = m.lowWeight[at(face)];
    const double between = w * velocity[at(2 * m.low[at(face)])] + (1.0 - w) * velocity[at(2 * m.high[at(face)])];
    worst = std::max(worst, std::abs(between + valueAt(m, face, gradient.values()) - alongLayer(centre, height)[0]));
  }
  return maxOverRanks(worst) * 20;
}

double slopeToCentre(const Mesh& m, int face, std::span<const double> gradient) {
  return faceSlope(m, face, m.offset[at(face)], gradient, 2, 0);
}
double rise(const Mesh& m, int face, std::span<const double> gradient) {
  return riseToCentre(m, face, gradient, 2, 0);
}

// Steps miss the centres by 1.25 of the faces' size on 10 cells a radian, by 0.31 on 20.
TEST(BentCells, VelocitiesAtFacesBelongToTheirLayer) {
  EXPECT_GT(errorAtFaces(10, true, slopeToCentre), 1.0);
  EXPECT_LT(errorAtFaces(10, true, rise), 0.04);
  EXPECT_GT(errorAtFaces(20, false, slopeToCentre), 0.2);
  EXPECT_LT(errorAtFaces(20, false, rise), 0.02);
}

// The slope across the layers is that from layer to layer, whatever lies beside the cell along them: with least squares
// it is 16 % less.
TEST(BentCells, SlopesAcrossLayersAreThoseBetweenThem) {
  const Box box = ringOfLayers(20, 4.0);
  const Mesh& m = box.mesh;
  std::vector<double> values, gradient(at(2 * m.owned));
  for (const std::int64_t number : m.naturalCell) values.push_back(static_cast<double>(number / 20));
  Gradient(m).compute(values, std::vector<double>(at(m.boundaryFaces()), 0.0), 1, gradient);
  for (int c = 0; c < m.owned; ++c) {
    if (m.gradientRow[at(c)] < 0) continue;
    const Vector3 outwards = scaled(m.centre[at(c)], 1.0 / length(m.centre[at(c)]));
    EXPECT_NEAR((gradient[at(2 * c)] * outwards[0] + gradient[at(2 * c + 1)] * outwards[1]) * layers / 20, 1.0, 2e-3);
    EXPECT_NEAR((gradient[at(2 * c)] * outwards[1] - gradient[at(2 * c + 1)] * outwards[0]) * layers / 20, 0.0, 2e-3);
  }
}

// A square's values are met on any cells within reach, as far as the gradients are those at the centres.
TEST(RiseToCentre, IsThatOfASquare) {
  std::vector<Side> sides;
  for (int axis = 0; axis < 2; ++axis)
    for (const bool atMax : {false, true}) sides.push_back(side(BoundaryKind::Wall, axis, atMax));
  const Box box(Geometry::Planar, {gradedAxis(0.0, {{1.0, 7, 3.0}}), uniformAxis(1.0, 6), {}}, sides, Gas::hydrogen(),
                Split{Cells::Quadrilaterals});
  const Mesh& m = box.mesh;
  const auto field = [](const Vector3& x) { return 3.0 * x[0] * x[0] - 2.0 * x[0] * x[1] + x[1] * x[1] + x[0]; };
  std::vector<double> gradient;
  for (const Vector3& x : m.centre) {
    gradient.push_back(6.0 * x[0] - 2.0 * x[1] + 1.0);
    gradient.push_back(-2.0 * x[0] + 2.0 * x[1]);
  }
  for (int face = 0; face < m.interiorFaces; ++face) {
    ASSERT_TRUE(isCentreInReach(m, face));
    const Vector3 &low = m.centre[at(m.low[at(face)])], &high = m.centre[at(m.high[at(face)])];
    const double w = m.lowWeight[at(face)];
    const double between = w * field(low) + (1.0 - w) * field(high);
    // Along the offset the gradient is that where the step meets the face.
    const Vector3 meets = sum(low, scaled(m.step[at(face)], 1.0 - w)), offset = m.offset[at(face)];
    const double along = (6.0 * meets[0] - 2.0 * meets[1] + 1.0) * offset[0] + 2.0 * (meets[1] - meets[0]) * offset[1];
    EXPECT_NEAR(between + riseToCentre(m, face, gradient), field(meets) + along, 1e-12);
  }
}

}  // namespace
}  // namespace lampblack::test
