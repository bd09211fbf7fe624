// A start given over place.
#include "flow/initial_fields.hpp"

#include <gmock/gmock.h>

#include "core/errors.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"
#include "tests/messages.hpp"

namespace lampblack::test {
namespace {

using Place = Vector3;

TEST(InitialFields, LieOverTheState) {
  Gas& gas = Gas::hydrogen();
  const auto air = gas.massFractions("O2: 0.21, N2: 0.79");
  const std::size_t H2 = gas.mechanism.speciesIndex("H2"), O2 = gas.mechanism.speciesIndex("O2");
  Box box(Geometry::Planar, {uniformAxis(1.0, 6), uniformAxis(1.0, 5)},
          {side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true), side(BoundaryKind::Wall, 1, false),
           side(BoundaryKind::Wall, 1, true)});
  State state = box.state([&](const auto&) { return Box::Local{{5.0, 7.0}, 300.0, air}; });
  InitialFields fields;
  EXPECT_TRUE(fields.isEmpty());
  fields.velocity[1] = [](const Place& x, double t) { return x[0] - x[1] + t; };
  fields.gas.temperature = [](const Place& x, double) { return 500.0 + 100.0 * x[0]; };
  fields.gas.moleFractions = {{H2, [](const Place& x, double) { return 0.5 * x[1]; }}};
  EXPECT_FALSE(fields.isEmpty());
  setInitialFields(box.context, fields, state);
  std::vector<double> X(air.size());
  for (int c = 0; c < box.mesh.cells; ++c) {
    const Place& x = box.mesh.centre[at(c)];
    EXPECT_EQ(state.velocity[at(2 * c)], 5.0);
    EXPECT_DOUBLE_EQ(state.velocity[at(2 * c + 1)], x[0] - x[1]);
    EXPECT_DOUBLE_EQ(state.temperature[at(c)], 500.0 + 100.0 * x[0]);
    const std::span<const double> Y{&state.Y[at(c) * air.size()], air.size()};
    gas.thermo.massToMole(Y, X);
    EXPECT_NEAR(X[H2], 0.5 * x[1], 1e-14);
    EXPECT_NEAR(X[O2], 0.21 * (1.0 - 0.5 * x[1]), 1e-14);
    EXPECT_DOUBLE_EQ(state.density[at(c)], gas.thermo.density(state.temperature[at(c)], 101325.0, Y));
    EXPECT_DOUBLE_EQ(state.enthalpy[at(c)], gas.thermo.enthalpyMass(state.temperature[at(c)], Y));
  }
  fields.gas.temperature = [](const Place&, double) { return 10.0; };
  EXPECT_THAT(messageOf<InputError>([&] { setInitialFields(box.context, fields, state); }),
              testing::AllOf(testing::HasSubstr("initial: the start at ("), testing::HasSubstr("found 10 K")));
}

}  // namespace
}  // namespace lampblack::test
