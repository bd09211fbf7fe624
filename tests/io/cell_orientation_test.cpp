// Every shape: as it should be, turned about itself, mirrored, folded.
#include "io/cell_orientation.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "tests/every_module.hpp"

namespace lampblack::io {
namespace {

using Place = std::array<double, 3>;

struct Sample {
  CellShape shape;
  std::vector<Place> corners;
};

// Thin in one direction, away from the origin.
std::vector<Sample> samples() {
  const std::vector<Place> cube{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  std::vector<Sample> all{
      {CellShape::Triangle, {cube[0], cube[1], cube[3]}},
      {CellShape::Quadrilateral, {cube[0], cube[1], cube[2], cube[3]}},
      {CellShape::Tetrahedron, {cube[0], cube[1], cube[3], cube[4]}},
      {CellShape::Pyramid, {cube[0], cube[1], cube[2], cube[3], {0.5, 0.5, 1}}},
      {CellShape::Prism, {cube[0], cube[1], cube[3], cube[4], cube[5], cube[7]}},
      {CellShape::Hexahedron, cube},
  };
  for (Sample& sample : all)
    for (Place& x : sample.corners) x = {100 + x[0], 1e-4 * x[1] + 0.3 * x[0], x[2]};
  return all;
}

CellOrientation orientationOfOrder(const Sample& sample, const std::vector<std::int64_t>& order) {
  std::vector<Place> places;
  for (const std::int64_t corner : order) places.push_back(sample.corners[static_cast<std::size_t>(corner)]);
  return orientationOf(sample.shape, places);
}

TEST(CellOrientation, MirroredCellsAreFoundAndMended) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(nameOf(sample.shape));
    std::vector<std::int64_t> order(sample.corners.size());
    std::iota(order.begin(), order.end(), 0);
    EXPECT_EQ(orientationOfOrder(sample, order), CellOrientation::Right);
    mirror(sample.shape, order);
    EXPECT_EQ(orientationOfOrder(sample, order), CellOrientation::Mirrored);
    mirror(sample.shape, order);
    EXPECT_EQ(orientationOfOrder(sample, order), CellOrientation::Right);
  }
}

TEST(CellOrientation, CellsWithoutContentAreFolded) {
  for (Sample sample : samples()) {
    SCOPED_TRACE(nameOf(sample.shape));
    for (Place& x : sample.corners) x[1] = 0.3 * x[0];
    EXPECT_EQ(orientationOf(sample.shape, sample.corners), CellOrientation::Folded);
    for (Place& x : sample.corners) x = {1, 2, 3};
    EXPECT_EQ(orientationOf(sample.shape, sample.corners), CellOrientation::Folded);
  }
}

TEST(CellOrientation, CornersInAnOrderOfAnotherKindAreFolded) {
  const std::vector<Sample> all = samples();
  EXPECT_EQ(orientationOfOrder(all[1], {0, 2, 1, 3}), CellOrientation::Folded);
  EXPECT_EQ(orientationOfOrder(all[3], {0, 2, 1, 3, 4}), CellOrientation::Folded);
  EXPECT_EQ(orientationOfOrder(all[4], {0, 1, 2, 4, 3, 5}), CellOrientation::Folded);
  EXPECT_EQ(orientationOfOrder(all[5], {0, 1, 3, 2, 4, 5, 7, 6}), CellOrientation::Folded);
  EXPECT_EQ(orientationOfOrder(all[5], {0, 1, 2, 3, 4, 5, 7, 6}), CellOrientation::Folded);
}

TEST(CellOrientation, ACrossedQuadrilateralOfUnequalPartsIsFolded) {
  EXPECT_EQ(orientationOf(CellShape::Quadrilateral, std::vector<Place>{{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {1, -0.1, 0}}),
            CellOrientation::Folded);
  // One corner turned inwards is no fold.
  EXPECT_EQ(orientationOf(CellShape::Quadrilateral, std::vector<Place>{{0, 0, 0}, {2, 0, 0}, {0.8, 0.8, 0}, {0, 2, 0}}),
            CellOrientation::Right);
}

}  // namespace
}  // namespace lampblack::io
