// Closed vessels, whose thermodynamic pressure changes; gravity; walls that move.
#include <gtest/gtest.h>

#include "core/constants.hpp"
#include "flow/models/reaction_operator.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

class ClosedVessel : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  static constexpr double size = 0.01;

  static std::vector<Side> walls(bool slip) {
    std::vector<Side> sides;
    for (int axis : {0, 1})
      for (bool atMax : {false, true}) {
        sides.push_back(side(BoundaryKind::Wall, axis, atMax));
        sides.back().condition.slip = slip;
      }
    return sides;
  }
  static Box box(const std::vector<Side>& sides, int cells = 8) {
    return Box(Geometry::Planar, {gradedAxis(0.0, {{size, cells, 2.0}}), uniformAxis(size, cells)}, sides);
  }
  double massOf(const Box& b, const State& state) const {
    return integral(b.mesh, [&](int c) { return state.density[at(c)]; });
  }
  // Temperature of a gas of that internal energy, J/kg.
  double temperatureOf(double energy, const std::vector<double>& Y, double guess) const {
    const double R = constants::gasConstant / gas.thermo.meanMolecularWeight(Y);
    for (int i = 0; i < 50; ++i)
      guess -= (gas.thermo.enthalpyMass(guess, Y) - R * guess - energy) / (gas.thermo.cpMass(guess, Y) - R);
    return guess;
  }
};

// Heat that comes evenly: the gas of constant volume keeps its mass, and its internal energy rises by the heat.
TEST_F(ClosedVessel, HeatRaisesThePressureAtConstantVolume) {
  Box b = box(walls(false));
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.0}, 300.0, air}; });
  TransportOperator transport(b.context, state);
  transport.initialise(state, 1e-4);
  const double mass = massOf(b, state), power = 5e6, dt = 1e-4;  // W/m3
  const int steps = 200;
  for (int i = 0; i < steps; ++i) {
    std::ranges::fill(state.balance.enthalpy, power);
    transport.advance(state, i * dt, dt);
  }
  const double density = mass / (size * size);
  const double R = constants::gasConstant / gas.thermo.meanMolecularWeight(air);
  const double start = gas.thermo.enthalpyMass(300.0, air) - R * 300.0;
  const double T = temperatureOf(start + steps * dt * power / density, air, 400.0);
  EXPECT_GT(T, 390.0);
  EXPECT_NEAR(massOf(b, state) / mass, 1.0, 5.0 * steps * epsilon);
  // A step warms the gas by 1/600, whose square the linearised constraint leaves to the next step.
  EXPECT_NEAR(state.thermodynamicPressure / (constants::oneAtmosphere * T / 300.0), 1.0, 5e-6);
  EXPECT_NEAR(largest(b.mesh, [&](int c) { return state.temperature[at(c)]; }), T, 1e-3);
  EXPECT_LT(largest(b.mesh, [&](int c) { return std::abs(state.velocity[at(2 * c)]); }), 1e-9);
}

// Gas that is let in brings its enthalpy: with the gas's own temperature at first, p V grows by (gamma - 1) h_in.
TEST_F(ClosedVessel, GasThatIsLetInRaisesThePressure) {
  const double speed = 0.05;
  std::vector<Side> sides = walls(true);
  sides[0] = opening(BoundaryKind::Inlet, 0, false, speed, 300.0, air);
  Box b = box(sides);
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.0}, 300.0, air}; });
  TransportOperator transport(b.context, state);
  transport.initialise(state, 1e-3);
  const double mass = massOf(b, state), dt = 1e-3;
  const double enthalpy = integral(b.mesh, [&](int c) { return state.density[at(c)] * state.enthalpy[at(c)]; });
  double heatIn = 0.0, massIn = 0.0;
  const int steps = 40;
  for (int i = 0; i < steps; ++i) {
    transport.advance(state, i * dt, dt);
    const auto& amounts = transport.boundaryAmounts();
    heatIn += sumOverRanks(amounts.enthalpyIn - amounts.enthalpyOut);
    for (std::size_t k = 0; k < amounts.speciesIn.size(); ++k)
      massIn += sumOverRanks(amounts.speciesIn[k] - amounts.speciesOut[k]);
  }
  EXPECT_GT(massIn, 0.15 * mass);
  EXPECT_NEAR(massOf(b, state), mass + massIn, 5.0 * steps * epsilon * mass);
  // Internal energy: what came in is all enthalpy, whatever conduction has done inside and at the inlet.
  const double rise = state.thermodynamicPressure - constants::oneAtmosphere;
  const double now = integral(b.mesh, [&](int c) { return state.density[at(c)] * state.enthalpy[at(c)]; });
  EXPECT_NEAR(now - enthalpy, heatIn + rise * size * size, 1e-9 * std::abs(heatIn));
  // gamma = 1.4, within what conduction through the inlet takes away again.
  const double exponent = 1.4 * speed * steps * dt / size;
  EXPECT_NEAR(std::log1p(rise / constants::oneAtmosphere) / exponent, 1.0, 0.03);
  EXPECT_LT(transport.pressureDrift(state), 1e-4);
}

// An even mixture that reacts in a vessel is a reactor of constant volume.
TEST_F(ClosedVessel, ReactsAsAReactorOfConstantVolume) {
  const auto mixture = gas.massFractions("H2: 2, O2: 1, N2: 3.76");
  const double T0 = 1200.0, dt = 1e-6;
  const int steps = 100;
  Box b = box(walls(true), 2);
  for (const int sweeps : {1, 2}) {
    State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.0}, T0, mixture}; });
    TransportOperator transport(b.context, state, {0.5, sweeps});
    ReactionOperator::Options options;
    options.reactor.relativeTolerance = 1e-8;
    options.reactor.absoluteTolerance = 1e-14;
    ReactionOperator chemistry(b.context, options);
    transport.initialise(state, dt);
    chemistry.endStep(state);
    chemistry.endSweep(state);
    for (int i = 0; i < steps; ++i) {
      for (int sweep = 0; sweep < sweeps; ++sweep) {
        transport.advance(state, i * dt, dt);
        chemistry.advance(state, i * dt, dt);
        if (sweep + 1 == sweeps) chemistry.endStep(state);
        transport.endSweep(state);
        chemistry.endSweep(state);
      }
    }
    // Burnt: its temperature does not depend on when it ignited.
    const double R0 = constants::gasConstant / gas.thermo.meanMolecularWeight(mixture);
    const double energy = gas.thermo.enthalpyMass(T0, mixture) - R0 * T0;
    const std::size_t n = mixture.size();
    double worst = 0.0;
    for (int c = 0; c < b.mesh.owned; ++c) {
      const std::vector<double> Y(&state.Y[at(c) * n], &state.Y[at(c) * n] + n);
      worst = std::max(worst, std::abs(state.temperature[at(c)] - temperatureOf(energy, Y, 2500.0)));
    }
    EXPECT_GT(largest(b.mesh, [&](int c) { return state.temperature[at(c)]; }), 2800.0) << sweeps;
    EXPECT_LT(maxOverRanks(worst), 1.0) << sweeps;
    EXPECT_GT(state.thermodynamicPressure, 2.0 * constants::oneAtmosphere) << sweeps;
    EXPECT_LT(transport.pressureDrift(state), 1e-4) << sweeps;
  }
}

// A gas of one density is at rest under its weight, in a vessel and next to an outlet.
TEST_F(ClosedVessel, GasUnderItsWeightIsAtRest) {
  for (const bool open : {false, true}) {
    std::vector<Side> sides = walls(false);
    if (open) sides[3] = opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air);
    Box b = box(sides);
    b.context.gravity = {0.0, -9.81};
    b.context.referenceDensity = open ? gas.thermo.density(300.0, constants::oneAtmosphere, air) : 0.0;
    State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.0}, 300.0, air}; });
    TransportOperator transport(b.context, state);
    transport.initialise(state, 1e-3);
    for (int i = 0; i < 20; ++i) transport.advance(state, 0.0, 1e-3);
    EXPECT_LT(largest(b.mesh, [&](int c) { return std::abs(state.velocity[at(2 * c + 1)]); }), 1e-9) << open;
    if (open) continue;
    // rho g over the height, between the centres of the lowest and the highest cells.
    const double top = largest(b.mesh, [&](int c) { return state.pressure[at(c)]; });
    const double bottom = -largest(b.mesh, [&](int c) { return -state.pressure[at(c)]; });
    EXPECT_NEAR((top - bottom) / (state.density[0] * 9.81 * size * 7.0 / 8.0), 1.0, 1e-6);
  }
}

// Between a wall at rest and one that moves along it the velocity is linear.
TEST_F(ClosedVessel, MovingWallDragsTheGasAlong) {
  std::vector<Side> sides{side(BoundaryKind::Symmetry, 0, false),
                          opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, air), side(BoundaryKind::Wall, 1, false),
                          side(BoundaryKind::Wall, 1, true)};
  sides[0] = opening(BoundaryKind::Outlet, 0, false, 0.0, 300.0, air);
  for (std::size_t i : {2, 3}) sides[i].condition.slip = false;
  // So slow that the pressure that draws gas in, rho v^2/2, is nothing next to the stress.
  sides[3].condition.tangential = 1e-5;
  Box b = box(sides);
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.0}, 300.0, air}; });
  TransportOperator transport(b.context, state);
  transport.initialise(state, 1e-2);
  for (int i = 0; i < 300; ++i) transport.advance(state, 0.0, 1e-1);  // four diffusion times
  EXPECT_LT(largest(b.mesh,
                    [&](int c) { return std::abs(state.velocity[at(2 * c)] / 1e-5 - b.mesh.centre[at(c)][1] / size); }),
            1e-3);
}

}  // namespace
}  // namespace lampblack::test
