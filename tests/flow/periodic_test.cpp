// Flows whose ends are one: nothing tells where they are.
#include <gtest/gtest.h>

#include <numbers>

#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

constexpr int cellsAlong = 12, cellsAcross = 8;
constexpr double size = 0.01;

// A hot cloud of hydrogen in a stream through the ends, its centre at a share of the length; the field of all cells in
// natural order after some steps.
struct Fields {
  std::vector<double> temperature, velocity, pressure;
};

Fields advance(Geometry geometry, double place) {
  Gas& gas = Gas::hydrogen();
  const auto air = gas.massFractions("O2: 0.21, N2: 0.79"), fuel = gas.massFractions("H2: 1, O2: 0.21, N2: 0.79");
  const int axis = geometry == Geometry::Planar ? 0 : 1;
  MeshSpec spec;
  spec.geometry = geometry;
  spec.vertices[at(axis)] = uniformAxis(size, cellsAlong);
  spec.vertices[at(1 - axis)] = gradedAxis(0.0, {{size, cellsAcross, 1.5}});
  spec.periodic[at(axis)] = true;
  Side low = side(BoundaryKind::Symmetry, 1 - axis, false), high = side(BoundaryKind::Wall, 1 - axis, true);
  high.condition.slip = false;
  spec.patches = {low.patch, high.patch};
  const Mesh mesh(MPI_COMM_WORLD, spec);
  HaloExchange halo(mesh);
  FlowContext context{mesh, halo, gas.mechanism, gas.thermo, gas.transport, {low.condition, high.condition}};
  State state(mesh, air.size(), {});
  for (int c = 0; c < mesh.cells; ++c) {
    double away = mesh.centre[at(c)][at(axis)] / size - place;
    away -= std::round(away);
    const double across = mesh.centre[at(c)][at(1 - axis)] / size - 0.4;
    const double share = std::exp(-(away * away + across * across) / 0.04);
    const double T = 300.0 + 700.0 * share;
    std::vector<double> Y(air);
    for (std::size_t k = 0; k < Y.size(); ++k) Y[k] += share * (fuel[k] - air[k]);
    state.velocity[at(2 * c + axis)] = 0.4;
    state.temperature[at(c)] = T;
    state.density[at(c)] = gas.thermo.density(T, state.thermodynamicPressure, Y);
    state.enthalpy[at(c)] = gas.thermo.enthalpyMass(T, Y);
    std::copy(Y.begin(), Y.end(), state.Y.begin() + c * static_cast<std::ptrdiff_t>(Y.size()));
  }
  const auto massOf = [&] { return integral(mesh, [&](int c) { return state.density[at(c)]; }); };
  const double mass = massOf(), dt = 2e-4;
  TransportOperator transport(context, state, {0.5, 2});
  transport.initialise(state, dt);
  for (int i = 0; i < 30; ++i)
    for (int sweep = 0; sweep < 2; ++sweep) transport.advance(state, i * dt, dt);
  EXPECT_NEAR(massOf() / mass, 1.0, 300.0 * epsilon);
  Fields fields;
  const auto total = at(mesh.totalCells);
  for (auto* field : {&fields.temperature, &fields.velocity, &fields.pressure}) field->assign(total, 0.0);
  for (int c = 0; c < mesh.owned; ++c) {
    const auto natural = at(mesh.naturalCell[at(c)]);
    fields.temperature[natural] = state.temperature[at(c)];
    fields.velocity[natural] = state.velocity[at(2 * c + axis)];
    fields.pressure[natural] = state.pressure[at(c)];
  }
  for (auto* field : {&fields.temperature, &fields.velocity, &fields.pressure})
    MPI_Allreduce(MPI_IN_PLACE, field->data(), static_cast<int>(total), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return fields;
}

class Periodic : public testing::TestWithParam<Geometry> {};
INSTANTIATE_TEST_SUITE_P(Geometry, Periodic, testing::Values(Geometry::Planar, Geometry::Axisymmetric),
                         [](const auto& tested) {
                           return tested.param == Geometry::Planar ? "Planar" : "Axisymmetric";
                         });

TEST_P(Periodic, AStartThatIsMovedMovesTheFlow) {
  const int moved = 5;
  const Fields there = advance(GetParam(), 0.25), here = advance(GetParam(), 0.25 + double(moved) / cellsAlong);
  const int axis = GetParam() == Geometry::Planar ? 0 : 1;
  double warmest = 0.0;
  for (int i = 0; i < cellsAlong; ++i)
    for (int j = 0; j < cellsAcross; ++j) {
      const auto number = [&](int along) { return at(axis == 0 ? along + j * cellsAlong : j + along * cellsAcross); };
      const std::size_t a = number(i), b = number((i + moved) % cellsAlong);
      EXPECT_NEAR(there.temperature[a], here.temperature[b], 1e-3);
      EXPECT_NEAR(there.velocity[a], here.velocity[b], 1e-6);
      EXPECT_NEAR(there.pressure[a], here.pressure[b], 1e-6);
      warmest = std::max(warmest, there.temperature[a]);
    }
  EXPECT_GT(warmest, 350.0);
}

}  // namespace
}  // namespace lampblack::test
