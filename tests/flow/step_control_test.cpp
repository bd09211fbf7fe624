// What a step did: its error, what it changed, and steps that are none.
#include "flow/step_control.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/errors.hpp"
#include "flow_fixture.hpp"
#include "tests/every_module.hpp"
#include "tests/messages.hpp"

namespace lampblack::test {
namespace {

class StepControls : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  const std::vector<double> air = gas.massFractions("O2: 0.21, N2: 0.79");
  Box box{Geometry::Planar,
          {uniformAxis(1.0, 4), uniformAxis(1.0, 3)},
          {side(BoundaryKind::Wall, 0, false), side(BoundaryKind::Wall, 0, true), side(BoundaryKind::Wall, 1, false),
           side(BoundaryKind::Wall, 1, true)}};
  State state = box.state([&](const auto&) { return Box::Local{{0.0, 0.0}, 500.0, air}; });
  // The cell of this natural number, if it is here.
  void change(std::int64_t natural, double kelvin, double fraction) {
    const int c = box.mesh.findOwned(natural);
    if (c < 0) return;
    state.temperature[at(c)] += kelvin;
    state.Y[at(c) * air.size()] += fraction;
  }
};

TEST_F(StepControls, TheLastCorrectionIsTheError) {
  StepControl control(box.context, {.sweeps = 3, .tolerance = 1e-3});
  control.endStep(state);
  EXPECT_EQ(control.largestStep(state), std::numeric_limits<double>::infinity()) << "nothing known yet";
  change(2, 100.0, 0.0);
  control.advance(state, 0.0, 2e-5);
  change(5, 50.0, 0.0);
  control.advance(state, 0.0, 2e-5);
  change(7, 2.0, 0.0);
  change(9, 0.0, 3e-3);
  control.advance(state, 0.0, 2e-5);
  EXPECT_NEAR(control.historyValues(state).at(1), std::max(2.0 / 502.0, 3e-3), 1e-15);
  control.endStep(state);
  EXPECT_NEAR(control.largestStep(state), 2e-5 * 0.9 * std::cbrt(1e-3 / (2.0 / 502.0)), 1e-18);
  for (int sweep = 0; sweep < 3; ++sweep) {
    if (sweep == 2) change(9, 0.0, 0.5);
    control.advance(state, 0.0, 1e-5);
  }
  EXPECT_NEAR(control.historyValues(state).at(1), 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(control.largestStep(state), 0.2e-5) << "not less than a fifth at once";
  for (int sweep = 0; sweep < 3; ++sweep) control.advance(state, 0.0, 1e-5);
  EXPECT_EQ(control.historyValues(state).at(1), 0.0) << "of the last step alone";
}

TEST_F(StepControls, NeedsTwoSweeps) {
  EXPECT_THROW(StepControl(box.context, {.sweeps = 1, .tolerance = 1e-3}), std::logic_error);
}

TEST_F(StepControls, TellsTheLargestChangeOfAStepAndStepsByIt) {
  StepControl control(box.context, {.temperatureChange = 100.0});
  EXPECT_TRUE(control.closingLines().empty());
  control.endStep(state);
  change(5, 60.0, 0.0);
  change(7, 90.0, 0.0);
  control.advance(state, 1e-3, 2e-5);
  control.endStep(state);
  EXPECT_NEAR(control.largestStep(state), 2e-5 * 0.8 * 100.0 / 90.0, 1e-18);
  change(2, 10.0, 0.0);
  control.advance(state, 1.02e-3, 2e-5);
  control.endStep(state);
  EXPECT_NEAR(control.largestStep(state), 2e-5 * 8.0, 1e-18) << "by the last step alone";
  EXPECT_NEAR(control.historyValues(state).at(0), 90.0, 1e-10) << "of all steps since the last row";
  EXPECT_EQ(control.historyValues(state).at(0), 0.0);
  // Cell 7 of four in a row is the last of the second row.
  EXPECT_THAT(control.closingLines().at(0),
              testing::AllOf(testing::HasSubstr("90 K at (0.875, 0.5) m at t = 0.00102 s"),
                             testing::HasSubstr("10 K in the last")));
  EXPECT_EQ(control.closingLines().size(), 1u);
  change(9, 0.0, -2e-3);
  control.advance(state, 1.04e-3, 2e-5);
  control.endStep(state);
  change(9, 0.0, 1e-3);
  control.advance(state, 1.06e-3, 2e-5);
  EXPECT_THAT(control.closingLines().at(1), testing::HasSubstr("of all steps -0.002 at (0.375, 0.833"));
  EXPECT_THAT(control.closingLines().at(1), testing::HasSubstr("t = 0.00106 s"));
}

// What a step in one sweep leaves in a cell, and what is said of it; nothing: the step is taken.
struct Left {
  const char* name;
  double kelvin, fraction;
  const char* words;
};

class Steps : public StepControls, public testing::WithParamInterface<Left> {};

TEST_P(Steps, FailWhereTheyHaveGoneWrong) {
  StepControl control(box.context, {.temperatureChange = 300.0, .leastMassFraction = -1e-3});
  control.endStep(state);
  change(5, GetParam().kelvin, GetParam().fraction);
  const auto step = [&] { control.advance(state, 0.0, 1e-5); };
  if (GetParam().words == nullptr) {
    EXPECT_NO_THROW(step());
    return;
  }
  const std::string message = messageOf<NumericsError>(step);
  EXPECT_THAT(message, testing::AllOf(testing::HasSubstr("in the cell at (0.375, 0.5) m: "),
                                      testing::HasSubstr(GetParam().words)));
  EXPECT_TRUE(sameOnAllRanks(message));
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, Steps,
    testing::Values(Left{"Warmer", 299.0, 0.0, nullptr}, Left{"Colder", -29.0, 0.0, nullptr},
                    Left{"Little", 0.0, -0.9e-3, nullptr},
                    Left{"TooWarm", 301.0, 0.0,
                         "from 500 to 801 K in one step; it may change by 300 K (time.temperature_change)"},
                    Left{"ColderThanAll", -31.0, 0.0,
                         "from 500 to 469 K in one step; the start and all boundaries are warmer (500 K and more)"},
                    Left{"BelowZero", 0.0, -1.1e-3, "has become -0.0011, below -0.001 (time.least_mass_fraction)"}),
    [](const auto& left) { return left.param.name; });

TEST_F(StepControls, WhatAShorterStepDoesAsWellIsTaken) {
  StepControl control(box.context, {.temperatureChange = 100.0});
  const auto attempt = [&](double kelvin) {
    control.endStep(state);
    change(5, kelvin, 0.0);
    control.advance(state, 0.0, 1e-5);
  };
  EXPECT_THROW(attempt(400.0), NumericsError);
  EXPECT_THROW(attempt(300.0), NumericsError);
  EXPECT_EQ(control.closingLines().size(), 0u);
  EXPECT_NO_THROW(attempt(260.0));
  EXPECT_THAT(control.closingLines().back(), testing::HasSubstr("a shorter one did as much: 1, the first at t = 0 s"));
  EXPECT_EQ(control.largestStep(state), std::numeric_limits<double>::infinity());
  EXPECT_THROW(attempt(260.0), NumericsError) << "another step";
}

TEST_F(StepControls, ABoundaryThatIsColderCoolsTheGas) {
  box.context.boundaries[0].isothermal = true;
  box.context.boundaries[0].temperature = 400.0;
  StepControl control(box.context, {.temperatureChange = 300.0});
  control.endStep(state);
  change(4, -99.0, 0.0);
  EXPECT_NO_THROW(control.advance(state, 0.0, 1e-5));
  control.endStep(state);
  change(4, -2.0, 0.0);
  EXPECT_NO_THROW(control.advance(state, 0.0, 1e-5)) << "bit by bit a gas may become colder, as where it reacts";
  control.endStep(state);
  change(5, -101.0, 0.0);
  EXPECT_THROW(control.advance(state, 0.0, 1e-5), NumericsError);
}

TEST_F(StepControls, OutOfTheRangeOfTransport) {
  state.temperature.assign(state.temperature.size(), 200.0);
  StepControl control(box.context, {});
  control.endStep(state);
  change(4, -15.0, 0.0);
  EXPECT_THAT(messageOf<NumericsError>([&] { control.advance(state, 0.0, 1e-5); }),
              testing::HasSubstr("transport properties at 185 K"));
}

}  // namespace
}  // namespace lampblack::test
