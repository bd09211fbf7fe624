// Coefficients of the gas beside boundaries: their values, and a gas between a hot and a cold wall that feels them.
#include "flow/properties/gas_properties.hpp"

#include <gtest/gtest.h>

#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

class Properties : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");

  // Of the gas at 1 atm.
  Transport::Mixture coefficients(double T, const std::vector<double>& Y) const {
    std::vector<double> X(Y.size()), D(Y.size());
    gas.thermo.massToMole(Y, X);
    return gas.transport.mixture(T, 101325.0, X, D);
  }
};

TEST_F(Properties, BesideABoundaryAreMeansOfBothSidesWhereItHasATemperature) {
  const std::vector<double> fuel = gas.massFractions("H2: 1");
  std::vector<Side> sides{side(BoundaryKind::Wall, 0, false), opening(BoundaryKind::Inlet, 0, true, 0.1, 900.0, fuel),
                          side(BoundaryKind::Wall, 1, false), opening(BoundaryKind::Inlet, 1, true, 0.1, 500.0, fuel)};
  sides[0].condition.isothermal = true;
  sides[0].condition.temperature = 1000.0;
  sides[3].condition.fixedComposition = true;
  Box box(Geometry::Planar, {uniformAxis(0.01, 4), uniformAxis(0.01, 4)}, sides);
  const State state = box.state([&](const auto&) { return Box::Local{{0.0, 0.0}, 300.0, air}; });
  GasProperties properties;
  properties.update(box.context, state);
  const Transport::Mixture inside = coefficients(300.0, air);
  const std::array<Transport::Mixture, 4> atFace{coefficients(1000.0, air), coefficients(900.0, air), inside,
                                                 coefficients(500.0, fuel)};
  for (int face = box.mesh.interiorFaces; face < box.mesh.faces; ++face) {
    const std::size_t b = at(face - box.mesh.interiorFaces);
    const Transport::Mixture& there = atFace[at(box.mesh.patch[b])];
    EXPECT_DOUBLE_EQ(properties.boundaryViscosity[b], 0.5 * (inside.viscosity + there.viscosity));
    EXPECT_DOUBLE_EQ(properties.boundaryConductivity[b], 0.5 * (inside.conductivity + there.conductivity));
  }
}

// Air at rest between a wall of 300 K and a hotter one, the hot one moving along itself: heat and shear pass evenly,
// q y = int lambda dT and u = (tau/q) int lambda/mu dT from the cold wall on.
class BetweenWalls : public Properties {
 protected:
  static constexpr double size = 0.01, cold = 300.0, speed = 0.01;
  static constexpr int pieces = 2000;

  // Both integrals, from the cold wall up to every temperature of a table.
  void heatTo(double temperature) {
    hot_ = temperature;
    piece_ = (hot_ - cold) / pieces;
    heat_ = shear_ = {0.0};
    Transport::Mixture before = coefficients(cold, air);
    for (int i = 1; i <= pieces; ++i) {
      const Transport::Mixture next = coefficients(cold + i * piece_, air);
      heat_.push_back(heat_.back() + 0.5 * (before.conductivity + next.conductivity));
      shear_.push_back(shear_.back() +
                       0.5 * (before.conductivity / before.viscosity + next.conductivity / next.viscosity));
      before = next;
    }
  }

  // Largest errors of temperature, over the walls' difference, and of velocity, over the wall's.
  // After so many steps in which it comes to rest, of 4 s together.
  std::array<double, 2> errors(int cells, int steps = 400) {
    std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Symmetry, 0, true),
                            side(BoundaryKind::Wall, 1, false), side(BoundaryKind::Wall, 1, true)};
    for (std::size_t i : {2, 3}) {
      sides[i].condition.slip = false;
      sides[i].condition.isothermal = true;
      sides[i].condition.temperature = i == 2 ? cold : hot_;
    }
    sides[3].condition.tangential = speed;
    // Periodic along the walls, so that the shear does not end.
    MeshSpec spec;
    spec.vertices = {uniformAxis(size, 3), uniformAxis(size, cells)};
    spec.periodic = {true, false};
    for (std::size_t i : {2, 3}) spec.patches.push_back(sides[i].patch);
    const Mesh mesh(MPI_COMM_WORLD, spec);
    HaloExchange halo(mesh);
    FlowContext context{mesh, halo, gas.mechanism, gas.thermo, gas.transport, {sides[2].condition, sides[3].condition}};
    State state(mesh, air.size(), {});
    for (int c = 0; c < mesh.cells; ++c) {
      const double T = state.temperature[at(c)] = cold + (hot_ - cold) * mesh.centre[at(c)][1] / size;
      std::ranges::copy(air, &state.Y[at(c) * air.size()]);
      state.density[at(c)] = gas.thermo.density(T, state.thermodynamicPressure, air);
      state.enthalpy[at(c)] = gas.thermo.enthalpyMass(T, air);
    }
    TransportOperator transport(context, state);
    transport.initialise(state, 1e-3);
    for (int i = 0; i < steps; ++i) transport.advance(state, 0.0, 4.0 / steps);
    double temperature = 0, velocity = 0;
    for (int c = 0; c < mesh.owned; ++c) {
      const double share = mesh.centre[at(c)][1] / size;
      const auto above = std::ranges::upper_bound(heat_, share * heat_.back());
      const std::size_t i = at(above - heat_.begin()) - 1;
      const double part = (share * heat_.back() - heat_[i]) / (heat_[i + 1] - heat_[i]);
      const double T = cold + piece_ * (static_cast<double>(i) + part);
      const double u = (shear_[i] + part * (shear_[i + 1] - shear_[i])) / shear_.back();
      temperature = std::max(temperature, std::abs(state.temperature[at(c)] - T) / (hot_ - cold));
      velocity = std::max(velocity, std::abs(state.velocity[at(2 * c)] / speed - u));
    }
    return {maxOverRanks(temperature), maxOverRanks(velocity)};
  }

  double hot_ = cold, piece_ = 0.0;  // K
  std::vector<double> heat_, shear_;
};

TEST_F(BetweenWalls, HeatAndShearPassEvenly) {
  heatTo(600.0);
  const auto coarse = errors(8), fine = errors(16);
  for (std::size_t i = 0; i < 2; ++i) {
    const double order = std::log2(coarse[i] / fine[i]);
    report(
        fmt::format("{}: {:.2e} {:.2e}, order {:.2f}", i == 0 ? "temperature" : "velocity", coarse[i], fine[i], order));
    EXPECT_LT(coarse[i], 1e-4);  // 2e-3 with the cell's coefficients alone
    EXPECT_GT(order, 1.7);
  }
}

// The pressure of a gas at rest in thin cells has nothing but round-off to solve for.
TEST_F(BetweenWalls, AGasAtRestIsSolvedForInThinCells) {
  heatTo(1500.0);
  EXPECT_LT(errors(64, 100)[0], 1e-4);
}

}  // namespace
}  // namespace lampblack::test
