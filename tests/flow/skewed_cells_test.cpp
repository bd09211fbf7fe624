// Cells without order: bounds of face values, and what is no number in a mesh of three axes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "flow/discretisation/limiter.hpp"
#include "flow/discretisation/neighbour_bounds.hpp"
#include "flow/equations/face_state.hpp"
#include "flow/stepping/finite_state.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"
#include "tests/messages.hpp"

namespace lampblack::test {
namespace {

Box skewedBox(Cells cells) {
  std::vector<Side> sides;
  Axes axes{uniformAxis(1e-3, 6), uniformAxis(1e-3, 5), {}};
  if (cells >= Cells::Hexahedra) axes[2] = uniformAxis(1e-3, 4);
  for (int axis = 0; axis < (axes[2].empty() ? 2 : 3); ++axis)
    for (const bool atMax : {false, true}) sides.push_back(side(BoundaryKind::Wall, axis, atMax));
  return {Geometry::Planar, axes, sides, Gas::hydrogen(), Split{cells}};
}

TEST(BoundedFaceValue, ReachesAsFarOnOneSideAsTheValuesDoOnTheOther) {
  EXPECT_EQ(boundedFaceValue(1.5, 1.0, 0.2, 3.0), 1.5);
  EXPECT_EQ(boundedFaceValue(2.5, 1.0, 0.2, 3.0), 1.8);   // 0.8 below, so 0.8 above
  EXPECT_EQ(boundedFaceValue(-1.0, 1.0, 0.2, 1.3), 0.7);  // 0.3 above, so 0.3 below
  EXPECT_EQ(boundedFaceValue(1.2, 1.0, 1.0, 3.0), 1.0);   // the smallest of all leaves as it is
}

TEST(NeighbourBounds, AreOfTheCellAndThoseAroundItOnAnyRank) {
  Box box = skewedBox(Cells::Triangles);
  const Mesh& m = box.mesh;
  // Two fields of the cells' numbers; what is known at boundaries is larger than all.
  std::vector<double> values(at(2 * m.cells)), boundary(at(2 * m.boundaryFaces()), 1e6);
  for (int c = 0; c < m.cells; ++c) {
    values[at(2 * c)] = static_cast<double>(m.naturalCell[at(c)]);
    values[at(2 * c + 1)] = -values[at(2 * c)];
  }
  std::vector<BoundaryData> known(at(m.boundaryFaces()), BoundaryData::ZeroSlope);
  NeighbourBounds bounds(box.context, 2);
  bounds.prepare(values, boundary, known);
  // The neighbours as one rank sees them all.
  MeshSpec spec;
  spec.vertices = {uniformAxis(1e-3, 6), uniformAxis(1e-3, 5), {}};
  for (int axis = 0; axis < 2; ++axis)
    for (const bool atMax : {false, true}) spec.patches.push_back({"wall", axis, atMax});
  const Mesh whole(MPI_COMM_SELF, SkewedMesh(MPI_COMM_SELF, spec, Cells::Triangles, 0.2).block(), Geometry::Planar);
  for (int c = 0; c < m.cells; ++c) {
    const int other = whole.findOwned(m.naturalCell[at(c)]);
    double smallest = static_cast<double>(m.naturalCell[at(c)]), largest = smallest;
    for (int i = whole.faceStart[at(other)]; i < whole.faceStart[at(other) + 1]; ++i) {
      const int face = whole.faceOfCell[at(i)];
      if (whole.high[at(face)] < 0) continue;
      const int beyond = whole.low[at(face)] == other ? whole.high[at(face)] : whole.low[at(face)];
      smallest = std::min(smallest, static_cast<double>(whole.naturalCell[at(beyond)]));
      largest = std::max(largest, static_cast<double>(whole.naturalCell[at(beyond)]));
    }
    EXPECT_EQ(bounds.smallest(c)[0], smallest);
    EXPECT_EQ(bounds.largest(c)[0], largest);
    EXPECT_EQ(bounds.smallest(c)[1], -largest);
    EXPECT_EQ(bounds.largest(c)[1], -smallest);
  }
  known.assign(known.size(), BoundaryData::Value);
  bounds.prepare(values, boundary, known);
  for (int face = m.interiorFaces; face < m.faces; ++face) EXPECT_EQ(bounds.largest(m.low[at(face)])[1], 1e6);
}

// A step of composition on cells of every kind: no face has more or less than the cells around it.
TEST(FaceStateOnSkewedCells, StaysWithinTheCellsAround) {
  for (const Cells cells : {Cells::Triangles, Cells::MixedPlane, Cells::Tetrahedra, Cells::MixedSpace}) {
    Box box = skewedBox(cells);
    const Mesh& m = box.mesh;
    const auto n2 = box.gas.massFractions("N2: 1"), o2 = box.gas.massFractions("O2: 1");
    State state = box.state([&](const Vector3& x) {
      return Box::Local{{0.0, 0.0, 0.0}, x[0] + 0.3 * x[1] < 6e-4 ? 300.0 : 900.0, x[0] + 0.3 * x[1] < 6e-4 ? n2 : o2};
    });
    FaceState faces(box.context, state);
    faces.prepare(state, state.Y);
    std::vector<double> row(n2.size());
    for (int face = 0; face < m.interiorFaces; ++face)
      for (const double direction : {1.0, -1.0}) {
        faces.interpolate(state, face, direction, row);
        for (const double y : row) {
          EXPECT_GE(y, -1e-15);
          EXPECT_LE(y, 1.0 + 1e-15);
        }
        EXPECT_GE(faces.temperature[at(face)], 300.0 - 1e-10);
        EXPECT_LE(faces.temperature[at(face)], 900.0 + 1e-10);
      }
  }
}

TEST(FiniteState, LooksAtAllThreeComponentsAndSaysWhere) {
  Box box = skewedBox(Cells::Tetrahedra);
  const Mesh& m = box.mesh;
  const auto n2 = box.gas.massFractions("N2: 1");
  State state = box.state([&](const Vector3&) { return Box::Local{{0.1, 0.2, 0.3}, 300.0, n2}; });
  EXPECT_TRUE(isFinite(m, state));
  // The last cell of all, its third component.
  const int last = m.findOwned(m.totalCells - 1);
  if (last >= 0) state.velocity[at(3 * last + 2)] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(isFinite(m, state), last < 0);
  const auto message = messageOf<NumericsError>([&] { raiseNotFinite(box.context, state); });
  EXPECT_THAT(message, testing::HasSubstr("the velocity is nan"));
  EXPECT_THAT(message, testing::MatchesRegex(".*at \\(.*, .*, .*\\) m.*")) << "three coordinates";
}

}  // namespace
}  // namespace lampblack::test
