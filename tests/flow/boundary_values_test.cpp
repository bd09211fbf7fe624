// Boundaries that vary over place and time, and walls of given heat flux.
#include "flow/boundaries/boundary_values.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "core/errors.hpp"
#include "flow/stepping/transport_operator.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"
#include "tests/messages.hpp"

namespace lampblack::test {
namespace {

using Place = Vector3;

class VaryingBoundaries : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  const std::vector<double> n2 = gas.massFractions("N2: 1"), air = gas.massFractions("O2: 0.21, N2: 0.79");
  static constexpr double size = 0.01;

  Box box(const Side& inlet, const Side& end) {
    Box b(Geometry::Planar, {uniformAxis(size, 10), uniformAxis(size, 4)},
          {inlet, end, side(BoundaryKind::Symmetry, 1, false), side(BoundaryKind::Symmetry, 1, true)});
    b.context.varying = std::make_shared<BoundaryValues>(b.mesh, b.context.boundaries, gas.thermo);
    return b;
  }
  Side inlet() { return opening(BoundaryKind::Inlet, 0, false, 0.1, 300.0, air); }
  Side outlet() { return opening(BoundaryKind::Outlet, 0, true, 0.0, 300.0, n2); }
};

TEST_F(VaryingBoundaries, HaveTheirValuesAtTheirFacesAndTimes) {
  Side in = inlet();
  in.condition.varies = {[](const Place& x, double t) { return x[1] + t; },
                         [](const Place& x, double t) { return 2.0 * x[1] - t; },
                         [](const Place& x, double t) { return 3.0 * x[1] + t; },
                         {},
                         {[](const Place&, double t) { return 300.0 + t; },
                          {{gas.mechanism.speciesIndex("H2"), [](const Place& x, double) { return x[1] / size; }}}},
                         {},
                         {}};
  Box b = box(in, outlet());
  b.context.varying->set(4.0, 3.0);
  const std::size_t H2 = gas.mechanism.speciesIndex("H2"), O2 = gas.mechanism.speciesIndex("O2");
  for (int face = b.mesh.interiorFaces; face < b.mesh.faces; ++face) {
    const double y = b.mesh.faceCentre[at(face)][1];
    if (b.context.boundaryOf(face).kind == BoundaryKind::Outlet) {
      EXPECT_EQ(b.context.boundaryTemperature(face), 300.0);
      EXPECT_EQ(b.context.boundaryY(face), n2);
    }
    if (b.context.boundaryOf(face).kind != BoundaryKind::Inlet) continue;
    EXPECT_DOUBLE_EQ(b.context.boundarySpeed(face), y + 4.0);
    EXPECT_DOUBLE_EQ(b.context.boundaryVelocity(face)[0], y + 3.0);
    EXPECT_DOUBLE_EQ(b.context.boundaryVelocity(face)[1], 2.0 * y - 3.0);
    EXPECT_DOUBLE_EQ(b.context.boundarySwirl(face), 3.0 * y + 3.0);
    EXPECT_EQ(b.context.boundaryTemperature(face), 304.0);
    std::vector<double> X(n2.size());
    gas.thermo.massToMole(b.context.boundaryY(face), X);
    EXPECT_NEAR(X[H2], y / size, 1e-14);
    EXPECT_NEAR(X[O2], 0.21 * (1.0 - y / size), 1e-14);
  }
}

TEST_F(VaryingBoundaries, SayWhereAValueCannotBe) {
  Side in = inlet();
  in.condition.varies.gas.temperature = [](const Place& x, double) { return x[1] > 0.8 * size ? 5000.0 : 300.0; };
  Box hot = box(in, outlet());
  EXPECT_THAT(messageOf<InputError>([&] { hot.context.varying->set(0.0, 0.0); }),
              testing::AllOf(testing::HasSubstr("boundaries.xmin: at (0, 0.00875) m and t = 0 s"),
                             testing::HasSubstr("from 200 to 4000 K, found 5000 K")));
  in.condition.varies.gas = {{}, {{gas.mechanism.speciesIndex("H2"), [](const Place&, double) { return 1.2; }}}};
  Box rich = box(in, outlet());
  EXPECT_THAT(messageOf<InputError>([&] { rich.context.varying->set(0.0, 0.0); }),
              testing::HasSubstr("sum to one, found 1.2"));
}

// What comes in through an inlet that swells, of a gas that changes, is what the domain gains; the flow is faster at
// the top.
TEST_F(VaryingBoundaries, FeedTheFlow) {
  Side in = inlet();
  in.condition.varies.speed = [](const Place& x, double t) { return (0.1 + x[1] / size) * (1.0 + 50.0 * t); };
  in.condition.varies.gas.temperature = [](const Place&, double t) { return 300.0 + 1e4 * t; };
  Box b = box(in, outlet());
  State state = b.state([&](const auto&) { return Box::Local{{0.6, 0.0}, 300.0, air}; });
  TransportOperator transport(b.context, state);
  double fed = 0.0, expected = 0.0;
  transport.watchBoundary([&](const TransportOperator::BoundaryAmounts& amounts) {
    for (const double amount : amounts.speciesIn) fed += amount;
  });
  const double dt = 2e-4;
  transport.initialise(state, dt);
  for (int i = 0; i < 50; ++i) {
    transport.advance(state, i * dt, dt);
    const double t = (i + 0.5) * dt;
    for (int j = 0; j < 4; ++j)
      expected += dt * 0.25 * size * (0.1 + (j + 0.5) / 4.0) * (1.0 + 50.0 * t) *
                  gas.thermo.density(300.0 + 1e4 * t, state.thermodynamicPressure, air);
  }
  EXPECT_NEAR(sumOverRanks(fed) / expected, 1.0, 1e-12);
}

// A wall takes gas away where its velocity into the domain is below zero: the domain loses what is there, not what the
// inlet would feed.
TEST_F(VaryingBoundaries, AnInletBelowZeroLetsTheGasOut) {
  Side in = inlet(), end = outlet();
  end.condition.temperature = 400.0;
  in.condition.varies.speed = [](const Place&, double) { return -0.2; };
  Box b = box(in, end);
  State state = b.state([&](const auto&) { return Box::Local{{-0.2, 0.0}, 400.0, n2}; });
  TransportOperator transport(b.context, state);
  transport.initialise(state, 1e-3);
  for (int i = 0; i < 10; ++i) transport.advance(state, i * 1e-3, 1e-3);
  // Conduction from the cold inlet reaches a cell or two; oxygen comes from nowhere.
  const std::size_t O2 = gas.mechanism.speciesIndex("O2");
  EXPECT_EQ(largest(b.mesh, [&](int c) { return state.Y[at(c) * n2.size() + O2]; }), 0.0);
  EXPECT_NEAR(largest(b.mesh, [&](int c) { return state.temperature[at(c)]; }), 400.0, 1.0);
}

// A composition that is held at a face through which nothing flows: in the end the gas has it everywhere.
TEST_F(VaryingBoundaries, AHeldCompositionFillsTheDomain) {
  Side in = inlet();
  in.condition.speed = 0.0;
  in.condition.fixedComposition = true;
  in.condition.varies.gas.moleFractions = {
      {gas.mechanism.speciesIndex("H2"), [](const Place&, double) { return 0.1; }}};
  Box b = box(in, outlet());
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.0}, 300.0, air}; });
  TransportOperator transport(b.context, state);
  const double dt = 5e-3;
  transport.initialise(state, dt);
  for (int i = 0; i < 400; ++i) transport.advance(state, i * dt, dt);
  std::vector<double> X(n2.size());
  for (int c = 0; c < b.mesh.owned; ++c) {
    gas.thermo.massToMole({&state.Y[at(c) * n2.size()], n2.size()}, X);
    EXPECT_NEAR(X[gas.mechanism.speciesIndex("H2")], 0.1, 5e-3);
  }
}

// Between a wall that heats and one of 300 K: the heat that comes in leaves, and the integral of the conductivity over
// the temperature is heat flux times distance.
TEST_F(VaryingBoundaries, AWallOfGivenHeatFlux) {
  Side hot = side(BoundaryKind::Wall, 0, false), cold = side(BoundaryKind::Wall, 0, true);
  hot.condition.slip = cold.condition.slip = false;
  hot.condition.heatFlux = 500.0;
  cold.condition.isothermal = true;
  cold.condition.temperature = 300.0;
  Box b = box(hot, cold);
  b.context.varying = nullptr;
  State state = b.state([&](const auto&) { return Box::Local{{0.0, 0.0}, 300.0, n2}; });
  TransportOperator transport(b.context, state);
  const double dt = 0.05;
  transport.initialise(state, dt);
  double in = 0.0, out = 0.0;
  transport.watchBoundary([&](const TransportOperator::BoundaryAmounts& amounts) {
    in = amounts.enthalpyIn;
    out = amounts.enthalpyOut;
  });
  for (int i = 0; i < 400; ++i) transport.advance(state, i * dt, dt);
  EXPECT_NEAR(sumOverRanks(in) / (500.0 * size * dt), 1.0, 1e-12);
  EXPECT_NEAR(sumOverRanks(out) / sumOverRanks(in), 1.0, 1e-5) << "not steady";
  std::vector<double> X(n2.size()), D(n2.size());
  gas.thermo.massToMole(n2, X);
  for (int c = 0; c < b.mesh.owned; ++c) {
    const double T = state.temperature[at(c)], x = b.mesh.centre[at(c)][0];
    double conducted = 0.0;  // W/m
    const int parts = 200;
    for (int i = 0; i < parts; ++i)
      conducted += gas.transport.mixture(300.0 + (i + 0.5) / parts * (T - 300.0), 101325.0, X, D).conductivity *
                   (T - 300.0) / parts;
    EXPECT_NEAR(conducted / (500.0 * size), 1.0 - x / size, 1.5e-3) << "x = " << x;
  }
}

}  // namespace
}  // namespace lampblack::test
