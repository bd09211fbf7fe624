// Fields between centres and vertices: exact where they are linear, continuous, of second order, no worse than what is
// bilinear between the centres of a box, and the same bits on any number of ranks.
#include "flow/discretisation/vertex_field.hpp"

#include <gtest/gtest.h>

#include "core/cell_finder.hpp"
#include "paths_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

std::vector<Vector3> placesIn(int dimension, int count) {
  std::vector<Vector3> places;
  for (std::int64_t i = 0; i < count; ++i) {
    Vector3 place{};
    for (int axis = 0; axis < dimension; ++axis) place[at(axis)] = 0.5 + 0.4999 * noise(i, axis);
    places.push_back(place);
  }
  return places;
}

VertexField::Source sourceOf(const Box& box, const std::function<double(const Vector3&)>& field,
                             BoundaryData known = BoundaryData::Nothing) {
  VertexField::Source source;
  const Mesh& m = box.mesh;
  for (int c = 0; c < m.cells; ++c) source.values.push_back(field(m.centre[at(c)]));
  for (int face = m.interiorFaces; face < m.faces; ++face) source.boundary.push_back(field(m.faceCentre[at(face)]));
  source.known.assign(source.boundary.size(), known);
  return source;
}

// At places, the same on all ranks.
std::vector<double> sampled(const Box& box, const VertexField& field, const std::vector<Vector3>& places) {
  const FoundCells found = findCells(box.mesh, places);
  std::vector<double> values(places.size(), 0.0);
  for (std::size_t i = 0; i < places.size(); ++i)
    if (found.cell[i] >= 0) values[i] = field.at(placeInCell(box.mesh, found.cell[i], places[i]));
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, box.mesh.comm);
  return values;
}

// Cells that are all corners know nothing of a slope along what their one neighbour cannot tell: with these, inside.
TEST(VertexField, ALinearFieldIsExact) {
  const auto linear = [](const Vector3& x) { return 3.0 - 2.0 * x[0] + 5.0 * x[1] + 7.0 * x[2]; };
  for (const MeshKind& kind : meshKinds()) {
    const Box box = unitBox(kind, 6, BoundaryKind::Outlet);
    std::vector<Vector3> places = placesIn(kind.dimension, 200);
    const bool hasCorners =
        kind.split && kind.split->cells != Cells::Quadrilaterals && kind.split->cells != Cells::Hexahedra;
    if (hasCorners)
      for (Vector3& place : places)
        for (int axis = 0; axis < kind.dimension; ++axis) place[at(axis)] = 0.5 + 0.25 * (place[at(axis)] - 0.5);
    const std::vector<double> found = sampled(box, VertexField(box.context, sourceOf(box, linear)), places);
    for (std::size_t i = 0; i < places.size(); ++i) EXPECT_NEAR(found[i], linear(places[i]), 1e-12) << kind.name;
  }
}

struct Errors {
  double mean = 0.0, largest = 0.0;
};
Errors errorsOf(const std::vector<double>& found, const std::vector<Vector3>& places,
                const std::function<double(const Vector3&)>& exact) {
  Errors errors;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double error = std::abs(found[i] - exact(places[i]));
    errors.mean += error / static_cast<double>(places.size());
    errors.largest = std::max(errors.largest, error);
  }
  return errors;
}

double wave(const Vector3& x) {
  return std::sin(3.0 * x[0] + 0.4) * std::cos(2.0 * x[1] - 0.3) + 0.5 * std::sin(2.0 * x[2]);
}

TEST(VertexField, IsOfSecondOrder) {
  for (const MeshKind& kind : meshKinds()) {
    const std::vector<Vector3> places = placesIn(kind.dimension, 500);
    std::vector<Errors> errors;
    for (const int cells : {6, 12}) {
      const Box box = unitBox(kind, cells, BoundaryKind::Outlet);
      errors.push_back(errorsOf(sampled(box, VertexField(box.context, sourceOf(box, wave)), places), places, wave));
    }
    const double order = std::log2(errors[0].mean / errors[1].mean);
    report(fmt::format("{}: mean {:.2e}, {:.2e}, order {:.2f}; largest {:.2e}, {:.2e}, order {:.2f}", kind.name,
                       errors[0].mean, errors[1].mean, order, errors[0].largest, errors[1].largest,
                       std::log2(errors[0].largest / errors[1].largest)));
    EXPECT_GT(order, 1.7) << kind.name;
  }
}

// Bilinear between the centres of a uniform box of n x n cells, constant beyond the outermost.
double bilinear(const Vector3& x, int n, const std::function<double(const Vector3&)>& field) {
  std::array<double, 2> low{}, share{};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double i = std::clamp(std::floor(x[axis] * n - 0.5), 0.0, n - 2.0);
    low[axis] = (i + 0.5) / n;
    share[axis] = std::clamp(x[axis] * n - 0.5 - i, 0.0, 1.0);
  }
  const double h = 1.0 / n;
  const auto row = [&](double y) {
    return (1.0 - share[0]) * field({low[0], y, 0.0}) + share[0] * field({low[0] + h, y, 0.0});
  };
  return (1.0 - share[1]) * row(low[1]) + share[1] * row(low[1] + h);
}

TEST(VertexField, IsNoWorseThanBilinearOnABox) {
  constexpr int n = 16;
  const Box box = unitBox(meshKinds().front(), n, BoundaryKind::Outlet);
  for (const bool isInside : {true, false}) {
    std::vector<Vector3> places = placesIn(2, 4000);
    if (isInside)  // off the boundary, where bilinear has no values
      for (Vector3& place : places)
        for (std::size_t axis = 0; axis < 2; ++axis) place[axis] = 0.5 + (place[axis] - 0.5) * (1.0 - 1.0 / n);
    std::vector<double> byCentres, alongGradient;
    const VertexField::Source source = sourceOf(box, wave);
    const FoundCells found = findCells(box.mesh, places);
    for (std::size_t i = 0; i < places.size(); ++i) {
      byCentres.push_back(bilinear(places[i], n, wave));
      double slope = 0.0;
      const int cell = found.cell[i];
      if (cell >= 0)
        Gradient(box.mesh).along(difference(places[i], box.mesh.centre[at(cell)]), cell, source.values, source.boundary,
                                 1, {&slope, 1}, source.known);
      alongGradient.push_back(cell >= 0 ? source.values[at(cell)] + slope : 0.0);
    }
    MPI_Allreduce(MPI_IN_PLACE, alongGradient.data(), static_cast<int>(alongGradient.size()), MPI_DOUBLE, MPI_SUM,
                  MPI_COMM_WORLD);
    const Errors ours = errorsOf(sampled(box, VertexField(box.context, source), places), places, wave);
    const Errors old = errorsOf(byCentres, places, wave), linear = errorsOf(alongGradient, places, wave);
    report(fmt::format(
        "{}: mean and largest error by vertices {:.2e}, {:.2e}; bilinear {:.2e}, {:.2e}; "
        "along the cell's gradient {:.2e}, {:.2e}",
        isInside ? "inside" : "all", ours.mean, ours.largest, old.mean, old.largest, linear.mean, linear.largest));
    EXPECT_LT(ours.mean, 0.8 * old.mean);
    EXPECT_LT(ours.largest, old.largest);
  }
}

// From both sides of a face the same, at places on it.
TEST(VertexField, IsContinuous) {
  for (const MeshKind& kind : meshKinds()) {
    const Box box = unitBox(kind, 4, BoundaryKind::Outlet);
    const Mesh& m = box.mesh;
    const VertexField field(box.context, sourceOf(box, wave));
    int checked = 0;
    for (int face = 0; face < m.interiorFaces; ++face) {
      if (m.low[at(face)] >= m.owned || m.high[at(face)] >= m.owned) continue;
      // On the way from the face's centre to a corner.
      const int cell = m.low[at(face)];
      const CellSide& side = sidesOf(m.shape[at(cell)])[at(m.lowSide[at(face)])];
      Vector3 middle{};
      std::vector<Vector3> corners;
      for (int i = 0; i < side.corners; ++i)
        corners.push_back(m.vertex[at(m.corner[at(m.cornerStart[at(cell)] + side.corner[at(i)])])]);
      for (const Vector3& corner : corners) middle = sum(middle, scaled(corner, 1.0 / side.corners));
      for (const Vector3& corner : corners) {
        const Vector3 place = sum(scaled(middle, 0.4), scaled(corner, 0.6));
        EXPECT_NEAR(field.at(placeInCell(m, cell, place)), field.at(placeInCell(m, m.high[at(face)], place)), 1e-13)
            << kind.name;
        ++checked;
      }
    }
    EXPECT_GT(checked, 0);
  }
}

// What is known at a boundary is met at it, whatever the cells beside it have.
TEST(VertexField, MeetsWhatIsKnownAtBoundaries) {
  for (const MeshKind& kind : meshKinds()) {
    if (kind.name == "hexahedra" || kind.name == "mixed in space") continue;  // cells whose sides are not plane
    const Box box = unitBox(kind, 5, BoundaryKind::Wall);
    VertexField::Source source = sourceOf(
        box, [](const Vector3& x) { return 1.0 + x[0]; }, BoundaryData::Value);
    std::ranges::fill(source.boundary, 0.0);
    std::vector<Vector3> places = placesIn(kind.dimension, 100);
    for (std::size_t i = 0; i < places.size(); ++i) places[i][i % 2] = i % 4 < 2 ? 0.0 : 1.0;
    for (const double value : sampled(box, VertexField(box.context, source), places)) EXPECT_NEAR(value, 0.0, 1e-12);
  }
}

// Where a wall meets an inlet the wall's value holds, where an inlet meets an outlet the inlet's.
TEST(VertexField, WallsCountBeforeInlets) {
  Box box(
      Geometry::Planar, {uniformAxis(1.0, 5), uniformAxis(1.0, 5), {}},
      {opening(BoundaryKind::Inlet, 0, false, 1.0, 300.0, {}), opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, {}),
       side(BoundaryKind::Wall, 1, false), opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, {})});
  const Mesh& m = box.mesh;
  VertexField::Source source = sourceOf(box, [](const Vector3&) { return 7.0; });
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const BoundaryKind kind = box.context.boundaryOf(face).kind;
    const std::size_t b = at(face - m.interiorFaces);
    source.boundary[b] = kind == BoundaryKind::Wall ? 1.0 : kind == BoundaryKind::Inlet ? 2.0 : 3.0;
    source.known[b] = kind == BoundaryKind::Outlet ? BoundaryData::Nothing : BoundaryData::Value;
  }
  source.isBounded = true;
  const std::vector<double> found =
      sampled(box, VertexField(box.context, source), {{0, 0, 0}, {0, 0.5, 0}, {0, 1, 0}, {1, 0, 0}, {1, 0.5, 0}});
  const std::vector<double> expected{1.0, 2.0, 2.0, 1.0, 7.0};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12);
}

// Both ends of a periodic box have the same values, and at its corners nearly: the cells there meet other faces.
TEST(VertexField, IsContinuousThroughPeriodicSides) {
  MeshSpec spec;
  spec.vertices = {gradedAxis(0.0, {{1.0, 8, 3.0}}), uniformAxis(1.0, 6), {}};
  spec.periodic = {true, true, false};
  const Box box(spec, {});
  const auto wave = [](const Vector3& x) {
    return std::sin(2.0 * std::numbers::pi * (x[0] + 0.2)) + std::cos(2.0 * std::numbers::pi * x[1]);
  };
  const VertexField field(box.context, sourceOf(box, wave));
  std::vector<Vector3> low, high;
  for (int i = 4; i <= 15; ++i) {
    low.push_back({0.0, 0.05 * i, 0.0});
    high.push_back({1.0, 0.05 * i, 0.0});
    low.push_back({0.05 * i, 0.0, 0.0});
    high.push_back({0.05 * i, 1.0, 0.0});
  }
  const std::vector<double> atLow = sampled(box, field, low), atHigh = sampled(box, field, high);
  for (std::size_t i = 0; i < low.size(); ++i) EXPECT_NEAR(atLow[i], atHigh[i], 1e-13);
  // The curvature of both waves is 4 pi^2, the widest cells are 0.2 and 0.17: h^2/8 of each.
  for (const double value : sampled(box, field, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}))
    EXPECT_NEAR(value, wave({}), 0.125 * 4.0 * std::numbers::pi * std::numbers::pi * (0.2 * 0.2 + 0.17 * 0.17));
}

// A crest of one cell is not undershot beside it.
TEST(VertexField, ABoundedFieldStaysBetweenItsCells) {
  const MeshKind kind = meshKinds().front();
  const Box box = unitBox(kind, 9, BoundaryKind::Outlet);
  const auto crest = [](const Vector3& x) { return std::abs(x[0] - 0.5) < 0.05 ? 1.0 : 0.0; };
  VertexField::Source source = sourceOf(box, crest);
  const std::vector<Vector3> places = placesIn(2, 2000);
  const auto leastOf = [&] { return std::ranges::min(sampled(box, VertexField(box.context, source), places)); };
  EXPECT_LT(leastOf(), -0.02) << "without bounds it is";
  source.isBounded = true;
  EXPECT_EQ(leastOf(), 0.0);
}

TEST(VertexField, IsTheSameOnAnyNumberOfRanks) {
  for (const MeshKind& kind : meshKinds()) {
    const Box all = unitBox(kind, 5, BoundaryKind::Wall), one = unitBox(kind, 5, BoundaryKind::Wall, MPI_COMM_SELF);
    const std::vector<Vector3> places = placesIn(kind.dimension, 200);
    for (const BoundaryData known : {BoundaryData::Nothing, BoundaryData::Value})
      EXPECT_EQ(sampled(all, VertexField(all.context, sourceOf(all, wave, known)), places),
                sampled(one, VertexField(one.context, sourceOf(one, wave, known)), places))
          << kind.name;
  }
}

}  // namespace
}  // namespace lampblack::test
