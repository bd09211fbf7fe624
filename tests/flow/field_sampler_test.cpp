// Places in cells, fields at places, and what boundaries are told of the stress on them.
#include "flow/paths/field_sampler.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/state_backup.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

struct Kind {
  std::string name;
  int dimension;
  std::optional<Split> split;
};
std::vector<Kind> kinds() {
  return {{"box", 2, {}},
          {"quadrilaterals", 2, Split{Cells::Quadrilaterals}},
          {"triangles", 2, Split{Cells::Triangles}},
          {"mixed", 2, Split{Cells::MixedPlane}},
          {"hexahedra", 3, {}},
          {"tetrahedra", 3, Split{Cells::Tetrahedra}}};
}

std::vector<Side> wallsAround(int dimension) {
  std::vector<Side> sides;
  for (int axis = 0; axis < dimension; ++axis)
    for (const bool atMax : {false, true}) sides.push_back(side(BoundaryKind::Wall, axis, atMax));
  return sides;
}

Box boxOf(const Kind& kind, const std::vector<Side>& sides) {
  Axes axes{uniformAxis(1.0, 6), uniformAxis(0.8, 5), {}};
  if (kind.dimension == 3) axes[2] = uniformAxis(0.6, 4);
  return {Geometry::Planar, axes, sides, Gas::hydrogen(), kind.split};
}

double linear(const Vector3& x) {
  return 3.0 - 2.0 * x[0] + 5.0 * x[1] + 7.0 * x[2];
}

// Places all over the mesh, its corners and sides among them.
std::vector<Vector3> placesIn(int dimension) {
  std::vector<Vector3> places;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 7; ++j)
      for (int k = 0; k <= (dimension == 3 ? 3 : 0); ++k) places.push_back({0.25 * i, 0.8 / 7.0 * j, 0.2 * k});
  return places;
}

TEST(FindCells, ACentreIsInItsCell) {
  for (const Kind& kind : kinds()) {
    Box box = boxOf(kind, wallsAround(kind.dimension));
    const Mesh& m = box.mesh;
    // The centres of the first rank's cells, known to all.
    auto count = static_cast<std::int64_t>(m.owned);
    MPI_Bcast(&count, 1, MPI_INT64_T, 0, MPI_COMM_WORLD);
    std::vector<Vector3> places(m.centre.begin(), m.centre.begin() + m.owned);
    std::vector<std::int64_t> numbers(m.naturalCell.begin(), m.naturalCell.begin() + m.owned);
    places.resize(at(count));
    numbers.resize(at(count));
    MPI_Bcast(places.data(), static_cast<int>(3 * count), MPI_DOUBLE, 0, MPI_COMM_WORLD);
    MPI_Bcast(numbers.data(), static_cast<int>(count), MPI_INT64_T, 0, MPI_COMM_WORLD);
    const FoundCells found = findCells(m, places);
    EXPECT_EQ(found.naturalCell, numbers) << kind.name;
    for (std::size_t i = 0; i < places.size(); ++i) EXPECT_EQ(found.cell[i], m.findOwned(numbers[i])) << kind.name;
  }
}

// On a box of 6 x 5 cells a place on a face belongs to the cell of the smaller number, a place on a corner to the least
// of four; places outside belong to none.
TEST(FindCells, PlacesOnFacesAndOutside) {
  Box box = boxOf(kinds().front(), wallsAround(2));
  const std::vector<Vector3> places{{0.5, 0.4, 0.0},   {0.5, 0.32, 0.0}, {0.6, 0.32, 0.0},
                                    {0.0, 0.0, 0.0},   {1.0, 0.8, 0.0},  {1.001, 0.4, 0.0},
                                    {0.5, -1e-4, 0.0}, {5.0, 5.0, 0.0},  {0.17, 0.33, 0.0}};
  const FoundCells found = findCells(box.mesh, places);
  const auto cell = [](std::int64_t i, std::int64_t j) { return i + 6 * j; };
  EXPECT_THAT(found.naturalCell,
              testing::ElementsAre(cell(2, 2), cell(2, 1), cell(3, 1), 0, cell(5, 4), -1, -1, -1, cell(1, 2)));
  int here = 0;
  for (const int local : found.cell) here += local >= 0 ? 1 : 0;
  EXPECT_EQ(sumOverRanks(here), 6.0) << "each place on one rank";
  EXPECT_THAT(meshExtentText(box.mesh, places[7]), testing::StrEq("the mesh reaches from (0, 0) m to (1, 0.8) m"));
}

// Opposite sides are one; places beside them are found where they are, and places beyond them are outside.
TEST(FindCells, OnAPeriodicMesh) {
  MeshSpec spec;
  spec.geometry = Geometry::Planar;
  spec.vertices = {uniformAxis(1.0, 6), uniformAxis(0.8, 5), {}};
  spec.periodic = {true, true, false};
  const Mesh mesh(MPI_COMM_WORLD, spec);
  const FoundCells found = findCells(mesh, std::vector<Vector3>{{0.01, 0.01, 0.0},
                                                                {0.99, 0.79, 0.0},
                                                                {0.99, 0.01, 0.0},
                                                                {1.01, 0.4, 0.0},
                                                                {-0.01, 0.4, 0.0},
                                                                {0.5, -0.01, 0.0},
                                                                {0.5, 0.81, 0.0}});
  EXPECT_THAT(found.naturalCell, testing::ElementsAre(0, 29, 5, -1, -1, -1, -1));
}

// A step between cells: along a line nothing jumps, and nothing is beyond what the cells have. The samples are even
// with the step: a hundredth of a cell changes the value by a few hundredths of it.
TEST(FieldSampler, IsContinuousAndWithinWhatTheCellsHave) {
  for (const Kind& kind : kinds()) {
    Box box = boxOf(kind, wallsAround(kind.dimension));
    const Mesh& m = box.mesh;
    FieldSampler::Field field = FieldSampler::scalarField(box.context);
    for (int c = 0; c < m.owned; ++c)
      field.values[at(c)] = m.centre[at(c)][0] + 0.3 * m.centre[at(c)][1] < 0.55 ? 2.0 : 5.0;
    std::vector<Vector3> places;
    for (int i = 0; i <= 1000; ++i) places.push_back({0.001 * i, 0.2 + 0.0004 * i, kind.dimension == 3 ? 0.31 : 0.0});
    std::vector<FieldSampler::Field> fields{field};
    const std::vector<double> samples = FieldSampler(box.context, places).sample(fields);
    double jump = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      EXPECT_GE(samples[i], 2.0 - 1e-12) << kind.name;
      EXPECT_LE(samples[i], 5.0 + 1e-12) << kind.name;
      if (i > 0) jump = std::max(jump, std::abs(samples[i] - samples[i - 1]));
    }
    EXPECT_LT(jump, 0.15) << kind.name;
    // A place by itself has the value that it has among others.
    const std::vector<double> alone = FieldSampler(box.context, {places[427]}).sample(fields);
    EXPECT_EQ(alone, std::vector<double>{samples[427]}) << kind.name;
    EXPECT_NEAR(samples.front(), 2.0, 1e-12) << kind.name;
    EXPECT_NEAR(samples.back(), 5.0, 1e-12) << kind.name;
  }
}

// What is led out, as the pressure, is linear up to the boundary where nothing is known of it; on a box to its corners.
TEST(FieldSampler, WhatIsLedOutGoesOnToTheBoundary) {
  Box box = boxOf(kinds().front(), wallsAround(2));
  FieldSampler::Field field = FieldSampler::scalarField(box.context);
  for (int c = 0; c < box.mesh.owned; ++c) field.values[at(c)] = linear(box.mesh.centre[at(c)]);
  const std::vector<Vector3> places = placesIn(2);
  std::vector<FieldSampler::Field> fields{field, field};
  fields[1].isLedOut = true;
  const std::vector<double> samples = FieldSampler(box.context, places).sample(fields);
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_NEAR(samples[2 * i + 1], linear(places[i]), 1e3 * epsilon) << placeText(places[i], 2);
  EXPECT_GT(samples[0], linear(places[0]) + 0.1);  // bounded by the cells
}

// Where the boundary's values are known, in a plane everywhere but in its corners, whose vertices have the mean of two
// sides; where nothing is known there, in cells that see enough others.
TEST(FieldSampler, ALinearFieldIsExact) {
  for (const Kind& kind : kinds()) {
    Box box = boxOf(kind, wallsAround(kind.dimension));
    const Mesh& m = box.mesh;
    for (const bool isKnown : {true, false}) {
      FieldSampler::Field field = FieldSampler::scalarField(box.context);
      // The halo is filled by the sampler.
      for (int c = 0; c < m.cells; ++c) field.values[at(c)] = c < m.owned ? linear(m.centre[at(c)]) : 1e10;
      for (int b = 0; b < m.boundaryFaces(); ++b)
        if (isKnown) field.boundary[at(b)] = linear(m.faceCentre[at(m.interiorFaces + b)]);
      if (isKnown) std::ranges::fill(field.known, BoundaryData::Value);
      std::vector<Vector3> places = placesIn(kind.dimension);
      const auto isOuter = [](const Vector3& x) {
        return std::min({x[0], 1.0 - x[0], x[1], 0.8 - x[1]}) < 0.2 || (x[2] > 0.0 && std::min(x[2], 0.6 - x[2]) < 0.2);
      };
      const auto isInCorner = [](const Vector3& x) {
        return std::min(x[0], 1.0 - x[0]) < 0.2 && std::min(x[1], 0.8 - x[1]) < 0.2;
      };
      std::erase_if(places, [&](const Vector3& x) { return isKnown ? isInCorner(x) : isOuter(x); });
      if (kind.dimension == 3) places = {{0.5, 0.4, 0.3}, {0.45, 0.37, 0.28}};
      const FieldSampler sampler(box.context, places);
      ASSERT_EQ(sampler.firstOutside(), -1) << kind.name;
      std::vector<FieldSampler::Field> fields{field, field};
      for (double& value : fields[1].values) value *= 2.0;
      for (double& value : fields[1].boundary) value *= 2.0;
      const std::vector<double> samples = sampler.sample(fields);
      ASSERT_EQ(samples.size(), 2 * places.size());
      // Values up to ten, gradients from differences of them over a tenth and back: some hundred epsilons.
      for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_NEAR(samples[2 * i], linear(places[i]), 1e3 * epsilon) << kind.name << " at " << placeText(places[i], 3);
        EXPECT_NEAR(samples[2 * i + 1], 2.0 * linear(places[i]), 2e3 * epsilon) << kind.name;
      }
    }
  }
}

TEST(FieldSampler, TellsTheFirstPlaceOutside) {
  Box box = boxOf(kinds().front(), wallsAround(2));
  EXPECT_EQ(FieldSampler(box.context, {{0.5, 0.5, 0.0}, {0.5, 0.9, 0.0}, {-1.0, 0.0, 0.0}}).firstOutside(), 1);
}

// A shear flow u = a y between a wall at rest and one that moves, open at both ends,: the stress is the
// same everywhere, so forces are known exactly.
class ShearFlow {
 public:
  static constexpr double rate = 50.0, height = 0.8;

  explicit ShearFlow(const Kind& kind)
      : box_(boxOf(kind, sides())), state_(box_.state([&](const Vector3& x) {
          return Box::Local{{rate * x[1], 0.0, 0.0}, 300.0, Gas::hydrogen().massFractions("N2: 1")};
        })) {
    transport_.emplace(box_.context, state_);
    transport_->initialise(state_, 1e-6);
    // What projecting and weighing have changed is undone.
    for (int c = 0; c < box_.mesh.cells; ++c) {
      const Vector3& x = box_.mesh.centre[at(c)];
      state_.velocity[at(2 * c)] = rate * x[1];
      state_.velocity[at(2 * c + 1)] = 0.0;
    }
    viscosity = transport_->properties().viscosity[0];
  }

  void advance(double dt) { transport_->advance(state_, 0.0, dt); }
  void saveOrLoad(StateArchive& archive) {
    state_.saveOrLoad(archive);
    transport_->saveOrLoad(archive);
    if (archive.loading()) state_.updateHalo(box_.halo);
  }
  [[nodiscard]] const Mesh& mesh() const { return box_.mesh; }
  [[nodiscard]] std::vector<BoundaryTotals> totals() { return transport_->boundaryTotals(state_); }
  [[nodiscard]] TransportOperator::Integrals integrals() { return transport_->integrals(state_); }
  [[nodiscard]] double density() const { return state_.density[0]; }
  double viscosity = 0.0;

 private:
  static std::vector<Side> sides() {
    std::vector<Side> sides = wallsAround(2);
    for (std::size_t i = 0; i < 2; ++i) {
      sides[i].condition.kind = BoundaryKind::Outlet;
      sides[i].condition.temperature = 300.0;
      sides[i].condition.Y = Gas::hydrogen().massFractions("N2: 1");
    }
    for (std::size_t i = 2; i < 4; ++i) sides[i].condition.slip = false;
    sides[3].condition.tangential = rate * height;
    return sides;
  }
  Box box_;
  State state_;
  std::optional<TransportOperator> transport_;
};

TEST(BoundaryTotals, ForcesOfAShearFlowAreExact) {
  for (const Kind& kind : {kinds()[0], kinds()[1]}) {
    ShearFlow flow(kind);
    const std::vector<BoundaryTotals> totals = flow.totals();
    ASSERT_EQ(totals.size(), 4u);
    const double friction = flow.viscosity * ShearFlow::rate;  // N/m^2
    const auto near = [&](double found, double expected, double scale, const char* what) {
      EXPECT_NEAR(found, expected, 1e-10 * scale) << what << " on " << kind.name;
    };
    // The gas drags the lower wall along and holds the upper one back.
    near(totals[2].viscousForce[0], friction * 1.0, friction, "friction below");
    near(totals[3].viscousForce[0], -friction * 1.0, friction, "friction above");
    // Across the openings the same stress points along y.
    near(totals[0].viscousForce[1], friction * 0.8, friction, "friction at the left");
    near(totals[1].viscousForce[1], -friction * 0.8, friction, "friction at the right");
    for (const std::size_t b : {2u, 3u}) near(totals[b].viscousForce[1], 0.0, friction, "no friction across");
    for (std::size_t b = 0; b < 4; ++b) near(totals[b].viscousForce[2], 0.0, friction, "nothing along the depth");
    near(totals[2].area, 1.0, 1.0, "area below");
    near(totals[0].area, 0.8, 1.0, "area at the left");
  }
}

// What came in during a step is kept with the state: a step that is taken back leaves the flows of the one before.
TEST(BoundaryTotals, GoBackWithTheState) {
  ShearFlow flow(kinds().front());
  flow.advance(1e-3);
  const std::vector<BoundaryTotals> before = flow.totals();
  EXPECT_GT(std::abs(before[0].massFlow), 0.0);
  StateBackup kept(flow.mesh().owned, flow.mesh().faces);
  const auto owners = [&](StateArchive& archive) { flow.saveOrLoad(archive); };
  kept.save(owners);
  flow.advance(2e-3);
  EXPECT_NE(flow.totals()[0].massFlow, before[0].massFlow);
  kept.restore(owners);
  const std::vector<BoundaryTotals> after = flow.totals();
  for (std::size_t b = 0; b < 4; ++b) {
    EXPECT_EQ(after[b].massFlow, before[b].massFlow);
    EXPECT_EQ(after[b].enthalpyFlow, before[b].enthalpyFlow);
    EXPECT_EQ(after[b].heatFlow, before[b].heatFlow);
  }
}

// A pressure 300 x - 200 y in a box of walls: on the sides at y = 0 and 0.8 it has the means 150 and -10, on those at
// x = 0 and 1 -80 and 220. What it presses on adds up to its slope times the volume.
TEST(BoundaryTotals, ForcesOfALinearPressureAreExact) {
  for (const Kind& kind : {kinds()[0], kinds()[1]}) {
    Box box = boxOf(kind, wallsAround(2));
    State state = box.state([](const Vector3&) {
      return Box::Local{{}, 300.0, Gas::hydrogen().massFractions("N2: 1")};
    });
    TransportOperator transport(box.context, state);
    transport.initialise(state, 1e-6);
    for (int c = 0; c < box.mesh.cells; ++c)
      state.pressure[at(c)] = 300.0 * box.mesh.centre[at(c)][0] - 200.0 * box.mesh.centre[at(c)][1];
    const std::vector<BoundaryTotals> totals = transport.boundaryTotals(state);
    const double expected[4][2] = {{80.0 * 0.8, 0.0}, {220.0 * 0.8, 0.0}, {0.0, -150.0}, {0.0, -10.0}};
    for (std::size_t b = 0; b < 4; ++b)
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(totals[b].pressureForce[i], i < 2 ? expected[b][i] : 0.0, 1e-8) << kind.name << ", side " << b;
        EXPECT_EQ(totals[b].viscousForce[i], 0.0) << kind.name << ", side " << b;
      }
  }
}

// Half of rho u^2 over the box, by the middle of each cell: with five rows of 0.16 the mean of y^2 is 0.8^2/3 less
// 0.16^2/12. The vorticity is the shear rate.
TEST(Integrals, EnergyAndEnstrophyOfAShearFlow) {
  ShearFlow flow(kinds().front());
  const auto [energy, enstrophy] = flow.integrals();
  const double rate = ShearFlow::rate, meanSquare = 0.8 * 0.8 / 3.0 - 0.16 * 0.16 / 12.0;
  EXPECT_NEAR(energy, 0.5 * flow.density() * rate * rate * meanSquare * 0.8, 1e-10 * energy);
  EXPECT_NEAR(enstrophy, 0.5 * flow.density() * rate * rate * 0.8, 1e-10 * enstrophy);
}

// A gas that turns as a solid body about the z axis of a box in space, with a stream through it whose speed grows along
// y: all three components of the vorticity.
TEST(Integrals, EnstrophyInSpace) {
  std::vector<Side> sides = wallsAround(3);
  for (Side& s : sides) {
    s.condition.kind = BoundaryKind::Outlet;
    s.condition.temperature = 300.0;
    s.condition.Y = Gas::hydrogen().massFractions("N2: 1");
  }
  Box box = boxOf(kinds()[4], sides);
  State state = box.state([&](const Vector3& x) {
    return Box::Local{{-2.0 * x[1] + 5.0 * x[2], 2.0 * x[0] + 1.0 * x[2], 3.0 * x[1] - 4.0 * x[0]},
                      300.0,
                      Gas::hydrogen().massFractions("N2: 1")};
  });
  TransportOperator transport(box.context, state);
  // Vorticity (3 - 1, 5 + 4, 2 + 2).
  const double enstrophy = 0.5 * state.density[0] * (4.0 + 81.0 + 16.0) * 0.48;
  EXPECT_NEAR(transport.integrals(state).enstrophy, enstrophy, 1e-10 * enstrophy);
}

// An axisymmetric gas that turns as a solid body, w = 7 r: vorticity 14 along the axis, and per radian the integral of
// r dr dz is half of the radius squared times the length.
TEST(Integrals, EnstrophyOfAGasThatTurns) {
  std::vector<Side> sides = wallsAround(2);
  sides[0].condition.kind = BoundaryKind::Symmetry;
  sides[1].condition.slip = false;
  sides[1].condition.swirl = 7.0;
  Box box(Geometry::Axisymmetric, {uniformAxis(1.0, 6), uniformAxis(0.8, 5), {}}, sides);
  State state = box.state(
      [&](const Vector3&) {
        return Box::Local{{}, 300.0, Gas::hydrogen().massFractions("N2: 1")};
      },
      {}, true);
  for (int c = 0; c < box.mesh.cells; ++c) state.swirl[at(c)] = 7.0 * box.mesh.centre[at(c)][0];
  TransportOperator transport(box.context, state);
  const double enstrophy = 0.5 * state.density[0] * 14.0 * 14.0 * 0.4;
  EXPECT_NEAR(transport.integrals(state).enstrophy, enstrophy, 1e-10 * enstrophy);
}

}  // namespace
}  // namespace lampblack::test
