#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "chemistry/reactor/reactor.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::hydrogen;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

struct Burning {
  double T = 1300;
  std::vector<double> Y = std::vector<double>(hydrogen().numSpecies());
  Burning() { Thermo(hydrogen()).moleToMass(parseComposition(hydrogen(), "H2: 2, O2: 1, N2: 3.76"), Y); }
  ConstantPressureReactor::Cell cell() { return {T, constants::oneAtmosphere, Y, {}, 0.0}; }
};

std::string messageOf(ConstantPressureReactor& reactor, ConstantPressureReactor::Cell& cell, double dt) {
  try {
    reactor.advance(cell, dt);
  } catch (const NumericsError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ReactorFailure, SaysWhichStateFailedAndWhyAndLeavesTheCellAlone) {
  ConstantPressureReactor reactor(hydrogen(), {1e-6, 1e-12, 3, 0.0});
  Burning gas;
  const auto start = gas.Y;
  auto cell = gas.cell();
  const auto message = messageOf(reactor, cell, 1e-3);
  EXPECT_THAT(message, AllOf(HasSubstr("T = 1300 K"), HasSubstr("p = 101325 Pa"), HasSubstr("dt = 0.001 s"),
                             HasSubstr("H2: 0.0285"), HasSubstr("N2: 0.745"), HasSubstr("mxstep steps"),
                             Not(HasSubstr("H2O2:"))));
  EXPECT_EQ(gas.Y, start);
  EXPECT_EQ(cell.temperature, 1300);
  // The object is as good as new afterwards.
  EXPECT_NO_THROW(reactor.advance(cell, 1e-12));
}

TEST(ReactorFailure, RetriesRescueACellThatNeedsMoreSteps) {
  Burning gas, reference;
  auto cell = gas.cell(), other = reference.cell();
  ConstantPressureReactor plenty(hydrogen());
  const int needed = plenty.advance(other, 1e-3).steps;
  ConstantPressureReactor few(hydrogen(), {1e-6, 1e-12, needed - 20, 1e-10});
  const auto result = few.advance(cell, 1e-3);
  EXPECT_GE(result.retries, 1);
  EXPECT_NEAR(cell.temperature, other.temperature, 1e-3);
}

TEST(ReactorFailure, StatesThatAreNoGasAreRefused) {
  ConstantPressureReactor reactor(hydrogen());
  const auto refused = [&](auto&& spoil) {
    Burning gas;
    auto cell = gas.cell();
    spoil(cell);
    return messageOf(reactor, cell, 1e-5);
  };
  using Cell = ConstantPressureReactor::Cell;
  for (const auto& message : {refused([](Cell& c) { c.temperature = std::nan(""); }),
                              refused([](Cell& c) { c.temperature = 20; }), refused([](Cell& c) { c.pressure = 0; }),
                              refused([](Cell& c) { c.Y[0] = std::nan(""); }), refused([](Cell& c) { c.Y[0] = 3; })})
    EXPECT_THAT(message, HasSubstr("not a state of a gas"));
  Burning gas;
  auto cell = gas.cell();
  EXPECT_THAT(messageOf(reactor, cell, -1.0), HasSubstr("dt = -1 s"));
}

}  // namespace
