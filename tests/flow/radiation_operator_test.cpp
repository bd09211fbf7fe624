// Heat lost by radiation in a flow.
#include "flow/models/radiation_operator.hpp"

#include <gtest/gtest.h>

#include <array>

#include "core/constants.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

// An even gas in a closed vessel cools at constant volume, of second order with two sweeps: du/dt = -loss/rho, while
// the falling pressure makes it absorb less.
TEST(RadiationOperator, CoolsAGasOfConstantVolume) {
  Gas& gas = Gas::hydrogen();
  const auto steam = gas.massFractions("H2O: 0.6, N2: 0.4");
  const double T0 = 2200.0, duration = 0.2, surroundings = 300.0;
  std::vector<double> X(steam.size());
  gas.thermo.massToMole(steam, X);
  const ThinRadiation radiation(gas.mechanism, surroundings);
  const double density = gas.thermo.density(T0, constants::oneAtmosphere, steam);
  const double R = constants::gasConstant / gas.thermo.meanMolecularWeight(steam);
  const auto slope = [&](double T) {
    const double loss = radiation.loss(radiation.absorption(T, density * R * T, X), T);
    return -loss / (density * (gas.thermo.cpMass(T, steam) - R));
  };
  double exact = T0;
  const int parts = 400;
  for (int i = 0; i < parts; ++i) {
    const double d = duration / parts, a = slope(exact), b = slope(exact + 0.5 * d * a);
    const double c = slope(exact + 0.5 * d * b);
    exact += d / 6.0 * (a + 2.0 * b + 2.0 * c + slope(exact + d * c));
  }
  ASSERT_LT(exact, T0 - 300.0);

  std::vector<Side> walls;
  for (int axis : {0, 1})
    for (bool atMax : {false, true}) walls.push_back(side(BoundaryKind::Wall, axis, atMax));
  Box box(Geometry::Planar, {uniformAxis(0.01, 4), uniformAxis(0.01, 4)}, walls);
  const auto errorOf = [&](int sweeps, int steps) {
    State state = box.state([&](const auto&) { return Box::Local{{0.0, 0.0}, T0, steam}; });
    TransportOperator transport(box.context, state, {0.5, sweeps});
    RadiationOperator loss(box.context, surroundings, nullptr);
    const double dt = duration / steps;
    transport.initialise(state, dt);
    loss.endStep(state);
    loss.endSweep(state);
    for (int i = 0; i < steps; ++i) {
      for (int sweep = 0; sweep < sweeps; ++sweep) {
        transport.advance(state, i * dt, dt);
        loss.advance(state, i * dt, dt);
        transport.endSweep(state);
        if (sweep + 1 < sweeps) loss.endSweep(state);
      }
      loss.endStep(state);
      loss.endSweep(state);
    }
    return largest(box.mesh, [&](int c) { return std::abs(state.temperature[at(c)] - exact); });
  };
  EXPECT_NEAR(errorOf(1, 40) / errorOf(1, 80), 2.0, 0.3);
  const double coarse = errorOf(2, 40), fine = errorOf(2, 80);
  EXPECT_GT(coarse / fine, 3.5);
  EXPECT_LT(fine, 0.1);
}

// What of several owners' scalars radiates are those of one.
TEST(RadiationOperator, SeesTheBlockThatRadiates) {
  Gas& gas = Gas::hydrogen();
  const auto N2 = gas.massFractions("N2: 1");
  Box box(Geometry::Planar, {uniformAxis(0.01, 2), uniformAxis(0.01, 2)},
          {side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true), side(BoundaryKind::Wall, 1, false),
           side(BoundaryKind::Wall, 1, true)});
  State state = box.stateWith({{"other", {{"a", "1/m^3", ""}}}, {"soot", {{"b", "1/m^3", ""}, {"c", "1/m^3", ""}}}},
                              [&](const auto&) {
                                return Box::Local{{}, 1500.0, N2};
                              });
  for (std::size_t i = 0; i < state.carried.size(); ++i) state.carried[i] = std::array{100.0, 2.0, 3.0}[i % 3];
  const auto sum = [](double, std::span<const double> carried) {
    double all = 0.0;
    for (const double one : carried) all += one;
    return all;
  };
  RadiationOperator operation(box.context, 300.0, sum, state.block("soot"));
  operation.endStep(state);
  operation.endSweep(state);
  const double loss = ThinRadiation(gas.mechanism, 300.0).loss(5.0, 1500.0);
  for (const double heat : state.balance.enthalpy) EXPECT_NEAR(heat / -loss, 1.0, 1e-12);
}

}  // namespace
}  // namespace lampblack::test
