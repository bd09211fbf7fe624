// The steady state of a flow is that of its equations on the mesh: the same whatever time steps led there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../flow/flow_fixture.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "tests/effort.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

constexpr double speed = 0.2;  // m/s

// Air from below and from above that meets in the middle and leaves to the side, cold.
Box stagnation(Geometry geometry, int cells) {
  const auto air = Gas::hydrogen().massFractions("O2: 0.21, N2: 0.79");
  return {geometry,
          {uniformAxis(8e-3, cells), uniformAxis(8e-3, cells)},
          {opening(BoundaryKind::Inlet, 1, false, speed, 300.0, air),
           opening(BoundaryKind::Inlet, 1, true, speed, 300.0, air), side(BoundaryKind::Symmetry, 0, false),
           opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, air)}};
}

struct Steady {
  std::vector<double> velocity;
  double change = 0.0;  // m/s over the time gas needs from one opening to the other
};

Steady settle(Box& box, double dt, double time, int sweeps) {
  const auto air = Gas::hydrogen().massFractions("O2: 0.21, N2: 0.79");
  State state = box.state([&](const auto&) { return Box::Local{{0.0, 0.0}, 300.0, air}; });
  TransportOperator transport(box.context, state, {0.5, sweeps});
  transport.initialise(state, dt);
  Steady steady;
  for (int i = 0; i * dt < time; ++i) {
    steady.velocity = state.velocity;
    for (int sweep = 0; sweep < sweeps; ++sweep) transport.advance(state, 0.0, dt);
  }
  for (std::size_t i = 0; i < 2 * at(box.mesh.owned); ++i)
    steady.change = std::max(steady.change, std::abs(state.velocity[i] - steady.velocity[i]) / dt * 8e-3 / speed);
  steady.change = maxOverRanks(steady.change);
  steady.velocity = state.velocity;
  return steady;
}

// Geometry, sweeps of a step.
class FlowSteady : public testing::TestWithParam<std::pair<Geometry, int>> {};

TEST_P(FlowSteady, StagnationFlowDoesNotDependOnTheTimeStep) {
  const auto [geometry, sweeps] = GetParam();
  const int cells = fewOrMany(8, 12);
  Box box = stagnation(geometry, cells);
  const double dt = 0.4 * 8e-3 / cells / (2.0 * speed);
  const int finer = fewOrMany(4, 16);
  const Steady coarse = settle(box, dt, 0.4, sweeps);
  const Steady fine = settle(box, dt / finer, 0.4, sweeps);
  const double difference = largest(box.mesh, [&](int c) {
    return std::max(std::abs(coarse.velocity[at(2 * c)] - fine.velocity[at(2 * c)]),
                    std::abs(coarse.velocity[at(2 * c + 1)] - fine.velocity[at(2 * c + 1)]));
  });
  report(fmt::format(
      "stagnation flow, {}, {} sweeps: steady velocities at dt and dt/{} differ by {:.1e} of U; still changing by "
      "{:.1e} and {:.1e}",
      geometry == Geometry::Planar ? "planar" : "axisymmetric", sweeps, finer, difference / speed,
      coarse.change / speed, fine.change / speed));
  EXPECT_LT(difference, 1e-6 * speed);
}

INSTANTIATE_TEST_SUITE_P(Geometries, FlowSteady,
                         testing::Values(std::pair{Geometry::Planar, 1}, std::pair{Geometry::Axisymmetric, 1},
                                         std::pair{Geometry::Axisymmetric, 2}));

}  // namespace
}  // namespace lampblack::test
