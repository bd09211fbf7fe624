// Gas that turns about the axis: what it keeps, what it loses to walls, and the pressure that holds it.
#include "flow/equations/swirl.hpp"

#include <gtest/gtest.h>

#include "flow/equations/flow_residual.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

class SwirlInAVessel : public testing::Test {
 protected:
  static constexpr double radius = 0.01, turning = 50.0, dt = 1e-3;
  Gas& gas = Gas::hydrogen();
  std::vector<double> n2 = gas.massFractions("N2: 1");
  double density = gas.thermo.density(300.0, 101325.0, n2);

  // A can of 1 cm radius and height, all of its walls alike.
  static std::vector<Side> can(bool slip, double angularVelocity) {
    std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true),
                            side(BoundaryKind::Wall, 1, false), side(BoundaryKind::Wall, 1, true)};
    for (std::size_t i : {1, 2, 3}) {
      sides[i].condition.slip = slip;
      sides[i].condition.varies.swirl = [=](const auto& x, double) { return angularVelocity * x[0]; };
    }
    return sides;
  }
  static Box boxOf(int cells, const std::vector<Side>& sides) {
    return {Geometry::Axisymmetric, {uniformAxis(radius, cells), uniformAxis(radius, cells)}, sides};
  }
  static void makeTurn(Box& box) {
    box.context.varying = std::make_shared<BoundaryValues>(box.mesh, box.context.boundaries, box.gas.thermo);
  }
  State turningAs(Box& box, const std::function<double(const Vector3&)>& swirl) {
    State state = box.state([&](const auto&) { return Box::Local{{0.0, 0.0}, 300.0, n2}; }, {}, true);
    for (int c = 0; c < box.mesh.cells; ++c) state.swirl[at(c)] = swirl(box.mesh.centre[at(c)]);
    return state;
  }
};

TEST_F(SwirlInAVessel, TurnsWithItsWallsAsASolidBody) {
  Box box = boxOf(12, can(false, turning));
  makeTurn(box);
  State state = turningAs(box, [](const auto& x) { return turning * x[0]; });
  TransportOperator transport(box.context, state);
  transport.initialise(state, dt);
  for (int i = 0; i < 20; ++i) transport.advance(state, 0.0, dt);
  const double wall = turning * radius, held = 0.5 * density * wall * wall;
  double turned = 0, moved = 0, low = 1e300, high = -1e300;
  for (int c = 0; c < box.mesh.owned; ++c) {
    const double r = box.mesh.centre[at(c)][0];
    turned = std::max(turned, std::abs(state.swirl[at(c)] - turning * r));
    for (int i = 0; i < 2; ++i) moved = std::max(moved, std::abs(state.velocity[at(2 * c + i)]));
    const double excess = state.pressure[at(c)] - held * r * r / (radius * radius);
    low = std::min(low, excess);
    high = std::max(high, excess);
  }
  EXPECT_LT(maxOverRanks(turned), 1e-12 * wall);
  EXPECT_LT(maxOverRanks(moved), 1e-9 * wall);  // the tolerance of the pressure's solve
  EXPECT_LT(maxOverRanks(high) - minOverRanks(low), 1e-9 * held);
}

// Free of friction at its walls, and stirred in the mesh's plane by its own uneven turning.
TEST_F(SwirlInAVessel, KeepsItsAngularMomentum) {
  Box box = boxOf(12, can(true, 0.0));
  State state = turningAs(box, [](const auto& x) { return turning * x[0] * (1.0 + x[1] / radius); });
  TransportOperator transport(box.context, state, {0.5, 2});
  transport.initialise(state, dt);
  const auto momentum = [&] {
    return integral(box.mesh,
                    [&](int c) { return state.density[at(c)] * box.mesh.centre[at(c)][0] * state.swirl[at(c)]; });
  };
  const double before = momentum();
  double fastest = 0;
  for (int i = 0; i < 2 * 20; ++i) transport.advance(state, 0.0, dt);
  for (double u : state.velocity) fastest = std::max(fastest, std::abs(u));
  report(fmt::format("angular momentum changed by {:.1e}, flow of {:.3f} m/s", momentum() / before - 1.0,
                     maxOverRanks(fastest)));
  EXPECT_GT(maxOverRanks(fastest), 0.02);
  EXPECT_NEAR(momentum() / before, 1.0, 1e-5);
}

TEST_F(SwirlInAVessel, TurnsByLittleInAStep) {
  Box box = boxOf(8, can(false, turning));
  State state = turningAs(box, [](const auto& x) { return turning * x[0]; });
  TransportOperator transport(box.context, state, {0.25, 1});
  EXPECT_NEAR(transport.largestStep(state), 0.25 / turning, 1e-12);
}

// The residual's moment on each cell is what a short step changes of its angular momentum, by friction at walls that
// turn at another speed and between rings of gas. Velocities stand at the middles of steps: the first changes them by
// half a step.
TEST_F(SwirlInAVessel, HasTheMomentByWhichAShortStepTurnsIt) {
  constexpr double shortStep = 1e-7;
  Box box = boxOf(12, can(false, -turning));
  makeTurn(box);
  State state = turningAs(box, [](const auto& x) { return turning * x[0] * (1.0 + 30.0 * x[0] + 20.0 * x[1]); });
  TransportOperator transport(box.context, state);
  transport.initialise(state, shortStep);
  FlowResidual residual(box.context, state, VelocityScheme::Limited, {});
  const std::vector<double> moment = residual.evaluate(state).angularMomentum, before = state.swirl;
  const std::vector<BoundaryTotals> totals = transport.boundaryTotals(state);
  double onWalls = 0.0;
  for (const BoundaryTotals& of : totals) onWalls += of.torque;
  double onGas = 0.0, size = 0.0;
  for (const double value : moment) {
    onGas += value;
    size += std::abs(value);
  }
  MPI_Allreduce(MPI_IN_PLACE, &onGas, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  MPI_Allreduce(MPI_IN_PLACE, &size, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_NEAR(onWalls, -onGas, 1e-10 * size);
  EXPECT_GT(std::abs(onGas), 1e-3 * size);
  const std::vector<WallFace> faces = transport.wallFaces(state, 1);  // the mantle
  double onMantle = 0.0;
  for (const WallFace& face : faces) onMantle += radius * face.area * face.friction[2];
  EXPECT_NEAR(onMantle, worldRank() == 0 ? totals[1].torque : 0.0, 1e-10 * size);
  transport.advance(state, 0.0, shortStep);
  double most = 0.0, differs = 0.0;
  for (int c = 0; c < box.mesh.owned; ++c) {
    const double inertia = state.density[at(c)] * box.mesh.volume[at(c)] * box.mesh.centre[at(c)][0];
    most = std::max(most, std::abs(moment[at(c)]));
    const double change = (state.swirl[at(c)] - before[at(c)]) / (0.5 * shortStep);
    differs = std::max(differs, std::abs(inertia * change - moment[at(c)]));
  }
  EXPECT_GT(maxOverRanks(most), 0.0);
  EXPECT_LT(maxOverRanks(differs), 1e-3 * maxOverRanks(most));
}

// A pipe whose gas is sucked away at one end and comes in at the other, through an outlet, stops turning.
TEST_F(SwirlInAVessel, GasDrawnInThroughAnOutletComesFromRest) {
  const double speed = 1.0;
  Box box(Geometry::Axisymmetric, {uniformAxis(radius, 3), uniformAxis(radius, 12)},
          {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true),
           opening(BoundaryKind::Inlet, 1, false, -speed, 300.0, n2),
           opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, n2)});
  State state = box.state([&](const auto&) { return Box::Local{{0.0, -speed}, 300.0, n2}; }, {}, true);
  for (int c = 0; c < box.mesh.cells; ++c) state.swirl[at(c)] = turning * box.mesh.centre[at(c)][0];
  TransportOperator transport(box.context, state);
  const double step = 0.4 * radius / 12 / speed;
  transport.initialise(state, step);
  for (int i = 0; i < 150; ++i) transport.advance(state, 0.0, step);
  EXPECT_LT(largest(box.mesh, [&](int c) { return std::abs(state.swirl[at(c)]); }), 1e-3 * turning * radius);
  EXPECT_GT(largest(box.mesh, [&](int c) { return -state.velocity[at(2 * c + 1)]; }), 0.9 * speed);
}

}  // namespace
}  // namespace lampblack::test
