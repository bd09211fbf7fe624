// Velocities, pressure and mass fluxes as one linear system.
#include "flow/steady/coupled_flow.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

// What is left of momentum, mass and mass fluxes, each as the largest of any cell or face.
std::array<double, 3> leftOfFlow(const Mesh& m, const FlowResidual::Rates& rates) {
  std::array<double, 3> most{};
  for (const double left : rates.momentum) most[0] = std::max(most[0], std::abs(left));
  for (const double left : rates.mass) most[1] = std::max(most[1], std::abs(left));
  for (const double left : rates.massFlux) most[2] = std::max(most[2], std::abs(left));
  MPI_Allreduce(MPI_IN_PLACE, most.data(), 3, MPI_DOUBLE, MPI_MAX, m.comm);
  return most;
}

// Steps of Newton's method from a state with waves in it; what they leave of momentum and mass fluxes, and of the mass
// over those.
std::array<double, 3> leftBySteps(Box& box, State& state, int steps) {
  FlowResidual residual(box.context, state, VelocityScheme::Limited, {});
  CoupledFlow flow(box.context, state, residual);
  residual.evaluate(state);
  const std::array<double, 3> before = leftOfFlow(box.mesh, residual.rates());
  const std::vector<double> none(at(box.mesh.owned), 0.0);
  for (int i = 0; i < steps; ++i) {
    flow.prepare(state, none);
    flow.left() = {residual.rates().momentum, residual.rates().mass, residual.rates().massFlux};
    const CoupledFlow::Change& change = flow.find();
    for (std::size_t k = 0; k < state.velocity.size(); ++k) state.velocity[k] += change.velocity[k];
    for (std::size_t c = 0; c < state.pressure.size(); ++c) state.pressure[c] += change.pressure[c];
    for (std::size_t f = 0; f < state.massFlux.size(); ++f) state.massFlux[f] += change.massFlux[f];
    state.updateHalo(box.halo);
    residual.evaluate(state);
  }
  std::array<double, 3> left = leftOfFlow(box.mesh, residual.rates());
  left = {left[0] / before[0], left[1] / before[2], left[2] / before[2]};
  report(fmt::format("left: momentum {:.2g}, mass {:.2g}, mass fluxes {:.2g}", left[0], left[1], left[2]));
  return left;
}

// A can with walls around and an outlet above, of cells 30 times as long as high.
Box thinCells(double velocity) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> n2 = gas.massFractions("N2: 1");
  Side wall = side(BoundaryKind::Wall, 0, true);
  wall.condition.slip = false;
  Side floor = side(BoundaryKind::Wall, 1, false);
  if (velocity > 0.0) floor = opening(BoundaryKind::Inlet, 1, false, velocity, 300.0, n2);
  return {
      Geometry::Axisymmetric,
      {uniformAxis(0.012, 4), uniformAxis(0.001, 10)},
      {side(BoundaryKind::Symmetry, 0, false), wall, floor, opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, n2)}};
}

State wavesIn(Box& box, double velocity, double size) {
  const std::vector<double> n2 = box.gas.massFractions("N2: 1");
  State state = box.state([&](const Vector3& x) {
    const double wave = size * std::sin(3000.0 * x[1]) * std::cos(200.0 * x[0]);
    return Box::Local{{wave, velocity + 0.5 * wave}, 300.0, n2};
  });
  for (int c = 0; c < box.mesh.cells; ++c)
    state.pressure[at(c)] = 1e-3 * size * std::cos(2000.0 * box.mesh.centre[at(c)][1]);
  for (int face = 0; face < box.mesh.faces; ++face)
    state.massFlux[at(face)] = velocity * state.density[0] * box.mesh.area[at(face)] * box.mesh.normal[at(face)][1];
  return state;
}

// The mass is conserved by each; of the mass fluxes what the cells' own slopes of the pressure add is not in the
// system, nor is the stress of gas that expands: these go from step to step.
TEST(CoupledFlow, BringsCreepingGasToRest) {
  Box box = thinCells(0.0);
  State state = wavesIn(box, 0.0, 1e-7);
  const std::array<double, 3> left = leftBySteps(box, state, 8);
  EXPECT_LT(left[0], 0.1);
  EXPECT_LT(left[1], box.mesh.owned == 40 ? 1e-9 : 0.01);  // ranks join what each eliminates to a twentieth
  EXPECT_LT(left[2], 0.03);
}

// Where gas flows convection is that of first order, and its change by the mass fluxes is in the system.
TEST(CoupledFlow, FollowsGasThatPassesThrough) {
  Box box = thinCells(2.0);
  State state = wavesIn(box, 2.0, 1e-3);
  const std::array<double, 3> left = leftBySteps(box, state, 8);
  EXPECT_LT(left[0], 0.005);
  EXPECT_LT(left[1], box.mesh.owned == 40 ? 1e-9 : 0.01);
  EXPECT_LT(left[2], 0.03);
}

// A jet in cells of unequal width, whose velocities differ from cell to cell: what mass fluxes bring matters.
TEST(CoupledFlow, FollowsAJet) {
  Gas& gas = Gas::hydrogen();
  const std::vector<double> n2 = gas.massFractions("N2: 1");
  Side wall = side(BoundaryKind::Wall, 0, true);
  wall.condition.slip = false;
  const Axes axes{std::vector<double>{0.0, 0.0005, 0.0015, 0.0035, 0.0075},
                  std::vector<double>{0.0, 0.001, 0.0025, 0.005, 0.009, 0.015}};
  Box box{Geometry::Axisymmetric,
          axes,
          {side(BoundaryKind::Symmetry, 0, false), wall, opening(BoundaryKind::Inlet, 1, false, 0.2, 300.0, n2),
           opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, n2)}};
  State state = box.state([&](const Vector3& x) {
    return Box::Local{{0.0, 0.4 * (1.0 - x[0] * x[0] / (0.0075 * 0.0075)) * (1.0 + 20.0 * x[1])}, 300.0, n2};
  });
  for (int face = 0; face < box.mesh.faces; ++face)
    state.massFlux[at(face)] = 0.2 * state.density[0] * box.mesh.area[at(face)] * box.mesh.normal[at(face)][1];
  const std::array<double, 3> left = leftBySteps(box, state, 8);
  const bool isWhole = box.mesh.owned == 20;
  EXPECT_LT(left[0], isWhole ? 1e-3 : 1e-2);
  EXPECT_LT(left[1], isWhole ? 1e-9 : 1e-2);
  EXPECT_LT(left[2], isWhole ? 1.2e-3 : 1e-2);
}

// In a short pseudo-time velocities change by no more than it lets them.
TEST(CoupledFlow, GoesSlowlyInAShortTime) {
  Box box = thinCells(2.0);
  State state = wavesIn(box, 2.0, 1e-3);
  FlowResidual residual(box.context, state, VelocityScheme::Limited, {});
  CoupledFlow flow(box.context, state, residual);
  residual.evaluate(state);
  const double inertia = 1.0;  // kg/s, a thousand times what flows and is conducted
  flow.prepare(state, std::vector<double>(at(box.mesh.owned), inertia));
  flow.left() = {residual.rates().momentum, std::vector<double>(at(box.mesh.owned), 0.0),
                 std::vector<double>(at(box.mesh.faces), 0.0)};
  const CoupledFlow::Change& change = flow.find();
  const double most = leftOfFlow(box.mesh, residual.rates())[0] / inertia;
  const double found = largest(box.mesh, [&](int c) { return std::abs(change.velocity[2 * at(c) + 1]); });
  EXPECT_LT(found, 2.0 * most);
  EXPECT_GT(found, 1e-3 * most);
}

}  // namespace
}  // namespace lampblack::test
