// Cells without order: bounds of face values, and what is no number in a mesh of three axes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "flow/discretisation/limiter.hpp"
#include "flow/discretisation/neighbour_bounds.hpp"
#include "flow/equations/face_state.hpp"
#include "flow/equations/flow_residual.hpp"
#include "flow/equations/momentum_forces.hpp"
#include "flow/equations/pressure_force.hpp"
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

// Owned cells whose faces are all inside, their centres in reach of the steps, with neighbours of which the same is
// true but for the reach: no boundary has a part in what acts on them.
std::vector<int> cellsWithin(const Mesh& m) {
  const auto all = [&](int c, const auto& holds) {
    for (int i = m.faceStart[at(c)]; i < m.faceStart[at(c) + 1]; ++i)
      if (!holds(m.faceOfCell[at(i)])) return false;
    return true;
  };
  const auto isInside = [&](int face) { return m.high[at(face)] >= 0; };
  const auto isSurrounded = [&](int face) {
    for (const int c : {m.low[at(face)], m.high[at(face)]})
      if (c >= m.owned || !all(c, isInside)) return false;
    return isCentreInReach(m, face);
  };
  std::vector<int> cells;
  for (int c = 0; c < m.owned; ++c)
    if (all(c, isInside) && all(c, isSurrounded)) cells.push_back(c);
  return cells;
}

const std::array skewedKinds{Cells::Quadrilaterals, Cells::Triangles, Cells::MixedPlane, Cells::Tetrahedra};

// The pressures at the faces' centres of an even slope push each cell by that slope.
TEST(PressureForceOnSkewedCells, EvenSlopesAreFoundAsTheyAre) {
  const Vector3 slope{3.0, -2.0, 5.0};
  for (const Cells cells : skewedKinds) {
    Box box = skewedBox(cells);
    const Mesh& m = box.mesh;
    const int d = m.dimension;
    std::vector<double> pressure, boundary, gradient(at(m.cells * d));
    for (const Vector3& centre : m.centre) pressure.push_back(dot(slope, centre));
    for (int face = m.interiorFaces; face < m.faces; ++face)
      boundary.push_back(dot(slope, sum(m.centre[at(m.low[at(face)])], m.step[at(face)])));
    const std::vector<BoundaryData> known(boundary.size(), BoundaryData::Value);
    PressureForce force(box.context, known);
    force.compute(pressure, boundary, gradient);
    for (const int c : cellsWithin(m))
      for (int i = 0; i < d; ++i) EXPECT_NEAR(gradient[at(d * c + i)], slope[at(i)], 1e-9) << static_cast<int>(cells);
  }
}

// What an even stream carries of velocities: of even slopes as much as there is at the faces' centres, which leaves the
// stream times the slopes in each cell; of others what lies along the slope of the cell it comes from, between cells
// with opposite sides on the parabola through both cells' values.
TEST(MomentumForcesOnSkewedCells, ConvectedVelocitiesAreThoseAtTheFacesCentres) {
  constexpr double sharp = 4e2;
  const Vector3 stream{0.3, -0.2, 0.1};
  const std::array<Vector3, 3> slopes{{{30.0, -20.0, 10.0}, {5.0, 40.0, -25.0}, {-15.0, 10.0, 35.0}}};
  double seen = 0.0;
  for (const Cells cells : skewedKinds)
    for (const double bend : {0.0, sharp}) {
      Box box = skewedBox(cells);
      const Mesh& m = box.mesh;
      const int d = m.dimension;
      const auto n2 = box.gas.massFractions("N2: 1");
      State state = box.state([&](const Vector3& x) {
        Vector3 velocity{};
        for (int i = 0; i < d; ++i)
          velocity[at(i)] = dot(slopes[at(i)], x) + bend * slopes[at(i)][0] * x[at((i + 1) % d)] * x[at(i)];
        return Box::Local{velocity, 300.0, n2};
      });
      const double density = state.density[0];
      for (int face = 0; face < m.interiorFaces; ++face)
        state.massFlux[at(face)] = density * m.area[at(face)] * dot(m.normal[at(face)], stream);
      const std::vector<double> none(at(m.cells)), noneOutside(at(m.boundaryFaces()));
      MomentumForces forces(box.context, false, VelocityScheme::Limited);
      std::vector<double> momentum(at(m.owned * d));
      forces.rates(state, {state, state, none, noneOutside, {}, 0.0}, momentum, {});
      VelocityGradient gradient(box.context);
      gradient.setBoundary(state.velocity);
      gradient.compute(state.velocity);
      const auto carried = [&](int face, int i) {
        const auto f = at(face);
        const bool fromLow = state.massFlux[f] >= 0.0;
        const int up = fromLow ? m.low[f] : m.high[f], down = fromLow ? m.high[f] : m.low[f];
        const Vector3 step = scaled(m.step[f], fromLow ? 1.0 : -1.0);
        const double share = fromLow ? 1.0 - m.lowWeight[f] : m.lowWeight[f];
        const double own = state.velocity[at(d * up + i)], rise = state.velocity[at(d * down + i)] - own;
        double along = 0.0, beside = 0.0;
        for (int j = 0; j < d; ++j) {
          along += step[at(j)] * gradient.of(up, i)[j];
          beside += m.offset[f][at(j)] * gradient.of(up, i)[j];
        }
        const double curved = m.betweenOpposite[f] != 0 ? share * share * (rise - along) : 0.0;
        return own + share * along + curved + beside;
      };
      for (const int c : cellsWithin(m))
        for (int i = 0; i < d; ++i) {
          double expected = 0.0;
          for (int j = m.faceStart[at(c)]; j < m.faceStart[at(c) + 1] && bend > 0.0; ++j) {
            const int face = m.faceOfCell[at(j)];
            const double out = m.low[at(face)] == c ? state.massFlux[at(face)] : -state.massFlux[at(face)];
            expected -= out * (carried(face, i) - state.velocity[at(d * c + i)]);
          }
          for (int j = 0; j < d && bend == 0.0; ++j)
            expected -= density * m.volume[at(c)] * stream[at(j)] * slopes[at(i)][at(j)];
          const double size = density * m.volume[at(c)] * length(stream) * length(slopes[at(i)]);
          EXPECT_NEAR(momentum[at(d * c + i)] / size, expected / size, 1e-9) << static_cast<int>(cells) << ", " << bend;
          seen += 1.0;
        }
    }
  EXPECT_GT(sumOverRanks(seen), 200.0);
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

// A variable of turbulence that boundaries hold diffuses in a linear field as much into each cell as out of it, those
// beside boundaries too.
TEST(CarriedOnSkewedCells, LinearValuesThatBoundariesHoldStay) {
  for (const Cells cells : {Cells::Quadrilaterals, Cells::Triangles}) {
    Box box = skewedBox(cells);
    const Mesh& m = box.mesh;
    for (BoundaryCondition& wall : box.context.boundaries) wall.slip = false;
    const auto linear = [](const Vector3& x, double) { return 5.0 + 2e3 * x[0] - 1e3 * x[1]; };
    ScalarBlock block{"turbulence", {{.name = "k", .unit = "m^2/s^2", .description = "", .isStirred = false}}};
    block.scalars[0].boundaries.assign(box.context.boundaries.size(), {.isHeld = true, .varies = linear});
    const std::vector<double> air = box.gas.massFractions("O2: 0.21, N2: 0.79");
    State state = box.stateWith({block}, [&](const Vector3&) { return Box::Local{{}, 300.0, air}; });
    constexpr double D = 1e-4;  // m^2/s
    std::ranges::fill(state.carriedDiffusivity, D);
    for (int c = 0; c < m.cells; ++c) state.carried[at(c)] = state.density[at(c)] * linear(m.centre[at(c)], 0.0);
    FlowResidual residual(box.context, state, VelocityScheme::Limited, {});
    residual.evaluate(state);
    const double through = state.density[0] * D * 2e3 * 1e-3 / 6;  // of a cell's side
    for (const double rate : residual.rates().carried) EXPECT_NEAR(rate / through, 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace lampblack::test
