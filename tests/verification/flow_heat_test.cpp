// Exact solutions of heat in a low-Mach flow: a hot spot that relaxes at constant pressure, convection against
// conduction, and gas at rest.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../flow/flow_fixture.hpp"
#include "flow/stepping/time_step.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "tests/effort.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

class FlowHeat : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
};

// 2400 K in 300 K: density ratio 8. Open on all sides, so that the thermodynamic pressure stays. The pressure of the
// equation of state leaves it only as far as one step's linearisation reaches.
TEST_F(FlowHeat, HotSpotOfDensityRatioEightRelaxesAtConstantPressure) {
  const double size = 4e-3;
  std::vector<Side> sides;
  for (int axis : {0, 1})
    for (bool atMax : {false, true}) sides.push_back(opening(BoundaryKind::Outlet, axis, atMax, 0.0, 300.0, air));
  double worst[2];
  double last[2] = {0.0, 0.0};
  for (int level = 0; level < 2; ++level) {
    const int cells = fewOrMany(16, 24) << level;
    Box box(Geometry::Planar, {uniformAxis(size, cells), uniformAxis(size, cells)}, sides);
    State state = box.state([&](const Vector3& x) {
      const double r2 = std::pow(x[0] - 0.5 * size, 2) + std::pow(x[1] - 0.5 * size, 2);
      return Box::Local{{0.0, 0.0}, 300.0 + 2100.0 * std::exp(-r2 / std::pow(0.6e-3, 2)), air};
    });
    TransportOperator transport(box.context, state);
    const double longest = 1e-5 / (1 << level);  // s
    transport.initialise(state, longest);
    const auto massOf = [&] { return integral(box.mesh, [&](int c) { return state.density[at(c)]; }); };
    const auto heatOf = [&](bool magnitude) {
      return integral(box.mesh, [&](int c) {
        const double h = state.density[at(c)] * state.enthalpy[at(c)];
        return magnitude ? std::abs(h) : h;
      });
    };
    const double mass = massOf();
    const double heat = heatOf(false);
    const double heatScale = heatOf(true);
    double massIn = 0.0;
    double massGross = 0.0;
    double heatIn = 0.0;
    double heatGross = 0.0;
    worst[level] = 0.0;
    double first = 0.0;
    double fastest = 0.0;
    const int steps = 100 << level;
    for (int i = 0; i < steps; ++i) {
      transport.advance(state, 0.0, std::min(longest, convectiveTimeStep(box.mesh, state, 0.3)));
      const double drift = transport.pressureDrift(state);
      (i < 5 ? first : worst[level]) = std::max(i < 5 ? first : worst[level], drift);
      last[level] = drift;
      const auto& b = transport.boundaryAmounts();
      double in = 0.0;
      double out = 0.0;
      for (std::size_t k = 0; k < b.speciesIn.size(); ++k) in += b.speciesIn[k], out += b.speciesOut[k];
      massIn += sumOverRanks(in - out);
      massGross += sumOverRanks(in + out);
      heatIn += sumOverRanks(b.enthalpyIn - b.enthalpyOut);
      heatGross += sumOverRanks(b.enthalpyIn + b.enthalpyOut);
      fastest = std::max(fastest, largest(box.mesh, [&](int c) { return std::abs(state.velocity[at(2 * c)]); }));
    }
    const double hottest = largest(box.mesh, [&](int c) { return state.temperature[at(c)]; });
    report(
        fmt::format("hot spot, {0} x {0} cells: |p_eos - p0|/p0 at most {1:.2e} in the first five steps, {2:.2e} "
                    "after, {5:.2e} at the end; "
                    "peak {3:.0f} K, {4:.2f} m/s",
                    cells, first, worst[level], hottest, fastest, last[level]));
    EXPECT_LT(worst[level], 1e-3);
    const double roundOff = 5.0 * steps * epsilon;
    EXPECT_NEAR(massOf() - mass, massIn, roundOff * (mass + massGross));
    EXPECT_NEAR(heatOf(false) - heat, heatIn, roundOff * (heatScale + heatOf(true) + heatGross));
    EXPECT_LT(hottest, 2000.0);  // it did relax
    EXPECT_GT(hottest, 600.0);
  }
  // First order in the step, second in space: half of both at least halves the drift at one time, but for a margin.
  EXPECT_LT(last[1], 0.6 * last[0]);
}

// Gas is drawn in through the open end at T0 (the flux there is all convection) and sucked out at the other, which is
// held at T1: lambda dT/dx = m (h(T) - h(T0)), an exponential for constant properties.
TEST_F(FlowHeat, ConvectionAgainstConductionIsSecondOrder) {
  const double length = 0.01;
  const double T0 = 300.0;
  const double T1 = 450.0;
  const double speed = 0.015;
  const double m = gas.thermo.density(T1, 101325.0, air) * speed;
  std::vector<double> X(air.size());
  std::vector<double> D(air.size());
  gas.thermo.massToMole(air, X);
  const double h0 = gas.thermo.enthalpyMass(T0, air);
  const auto slope = [&](double T) {
    return m * (gas.thermo.enthalpyMass(T, air) - h0) / gas.transport.mixture(T, 101325.0, X, D).conductivity;
  };
  double error[3];
  for (int level = 0; level < 3; ++level) {
    const int cells = 10 << level;
    Side held = opening(BoundaryKind::Inlet, 0, true, -speed, T1, air);
    held.condition.fixedComposition = true;
    Box box(Geometry::Planar, {uniformAxis(length, cells), uniformAxis(1e-3, 1)},
            {opening(BoundaryKind::Outlet, 0, false, 0.0, T0, air), held, side(BoundaryKind::Symmetry, 1, false),
             side(BoundaryKind::Symmetry, 1, true)});
    const double guess = m * 1010.0 / 0.032;  // 1/m
    State state = box.state([&](const Vector3& x) {
      return Box::Local{{0.6 * speed, 0.0}, T0 + (T1 - T0) * std::exp(guess * (x[0] - length)), air};
    });
    TransportOperator transport(box.context, state);
    const double dt = 0.4 * length / cells / speed;
    transport.initialise(state, dt);
    double change = 1.0;
    std::vector<double> before;
    for (int step = 0; step < 40 * cells && change > 1e-7; ++step) {
      before = state.temperature;
      transport.advance(state, 0.0, dt);
      change = largest(box.mesh, [&](int c) { return std::abs(state.temperature[at(c)] - before[at(c)]); });
    }
    EXPECT_LE(change, 1e-6) << "not steady";
    // What the linearised constraint misses is known by then.
    EXPECT_LT(transport.pressureDrift(state), 1e-9);
    // Exact temperature at a cell's centre: Runge and Kutta from the held end.
    const auto exact = [&](double x) {
      constexpr int parts = 200;
      const double dx = (x - length) / parts;
      double T = T1;
      for (int i = 0; i < parts; ++i) {
        const double a = slope(T);
        const double b = slope(T + 0.5 * dx * a);
        const double c = slope(T + 0.5 * dx * b);
        const double d = slope(T + dx * c);
        T += dx / 6.0 * (a + 2.0 * b + 2.0 * c + d);
      }
      return T;
    };
    error[level] =
        largest(box.mesh,
                [&](int c) { return std::abs(state.temperature[at(c)] - exact(box.mesh.centre[at(c)][0])); }) /
        (T1 - T0);
  }
  report(
      fmt::format("convection against conduction, 10, 20, 40 cells: errors {:.2e} {:.2e} {:.2e}, orders {:.2f} {:.2f}",
                  error[0], error[1], error[2], std::log2(error[0] / error[1]), std::log2(error[1] / error[2])));
  EXPECT_GT(std::log2(error[1] / error[2]), 1.7);
  EXPECT_LT(error[2], 0.01);
}

// Round-off of p_eos/p0 over the time in which it is taken away is all the divergence there is.
TEST_F(FlowHeat, GasAtRestStaysAtRest) {
  const double size = 0.01;
  for (const Geometry geometry : {Geometry::Planar, Geometry::Axisymmetric}) {
    Box box(geometry, {gradedAxis(0.0, {{size, 16, 3.0}}), gradedAxis(0.0, {{size, 16, 0.3}})},
            {side(BoundaryKind::Symmetry, 0, false), side(BoundaryKind::Wall, 0, true),
             side(BoundaryKind::Wall, 1, false), opening(BoundaryKind::Outlet, 1, true, 0.0, 300.0, air)});
    State state = box.state([&](const auto&) { return Box::Local{{0.0, 0.0}, 700.0, air}; });
    TransportOperator transport(box.context, state);
    const double dt = 1e-4;
    const int steps = 20;
    transport.initialise(state, dt);
    for (int i = 0; i < steps; ++i) transport.advance(state, 0.0, dt);
    const double speed = largest(box.mesh, [&](int c) {
      return std::max(std::abs(state.velocity[at(2 * c)]), std::abs(state.velocity[at(2 * c + 1)]));
    });
    report(fmt::format("gas at rest ({}): {:.1e} m/s after {} steps",
                       geometry == Geometry::Planar ? "planar" : "axisymmetric", speed, steps));
    // Some ten roundings in the divergence, over the box; the steps' increments may add up.
    EXPECT_LE(speed, 10.0 * steps * epsilon / dt * size);
    EXPECT_LE(largest(box.mesh, [&](int c) { return std::abs(state.temperature[at(c)] - 700.0); }),
              10.0 * steps * epsilon * 700.0);
  }
}

}  // namespace
}  // namespace lampblack::test
