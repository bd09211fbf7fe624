// What a step did: its error, what it changed, and steps that are none.
#include "flow/stepping/step_control.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/errors.hpp"
#include "flow/stepping/undershoot_correction.hpp"
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
  // A step that takes a mass fraction that much further below zero.
  void stepBelow(StepControl& control, double below) {
    control.endStep(state);
    state.start.Y = state.Y;
    change(5, 0.0, -below);
    control.advance(state, 0.0, 2e-5);
    control.endStep(state);
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
  EXPECT_NEAR(control.historyValues(state).at(3), std::max(2.0 / 502.0, 3e-3), 1e-15);
  control.endStep(state);
  EXPECT_NEAR(control.largestStep(state), 2e-5 * 0.9 * std::cbrt(1e-3 / (2.0 / 502.0)), 1e-18);
  for (int sweep = 0; sweep < 3; ++sweep) {
    if (sweep == 2) change(9, 0.0, 0.5);
    control.advance(state, 0.0, 1e-5);
  }
  EXPECT_NEAR(control.historyValues(state).at(3), 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(control.largestStep(state), 0.2e-5) << "not less than a fifth at once";
  for (int sweep = 0; sweep < 3; ++sweep) control.advance(state, 0.0, 1e-5);
  EXPECT_EQ(control.historyValues(state).at(3), 0.0) << "of the last step alone";
}

TEST_F(StepControls, NeedsTwoSweeps) {
  EXPECT_THROW(StepControl(box.context, {.sweeps = 1, .tolerance = 1e-3}), std::logic_error);
}

TEST_F(StepControls, TellsTheLargestChangeOfAStepAndStepsByIt) {
  StepControl control(box.context, {.temperatureChange = 100.0, .leastMassFraction = -0.01});
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
                             testing::HasSubstr("10 K in the last, at (0.625, 0.166667) m")));
  EXPECT_EQ(control.closingLines().size(), 1u);
  change(9, 0.0, -2e-3);
  control.advance(state, 1.04e-3, 2e-5);
  control.endStep(state);
  change(9, 0.0, 1e-3);
  control.advance(state, 1.06e-3, 2e-5);
  EXPECT_THAT(control.closingLines().at(1), testing::HasSubstr("of all steps -0.002 at (0.375, 0.833"));
  EXPECT_THAT(control.closingLines().at(1), testing::HasSubstr("t = 0.00106 s"));
}

TEST_F(StepControls, TellsTheLargestChangeOfHeatRelease) {
  StepControl control(box.context, {});
  const auto release = [&](std::int64_t number, double rate) {  // kg/m3/s, of water
    const int c = box.mesh.findOwned(number);
    if (c >= 0) state.balance.reactions[at(c) * air.size() + gas.mechanism.speciesIndex("H2O")] = rate;
  };
  const auto changeIn = [&] {
    control.endStep(state);
    control.advance(state, 0.0, 1e-5);
    return control.historyValues(state).at(1);
  };
  release(5, 2.0);
  release(7, 4.0);
  EXPECT_DOUBLE_EQ(changeIn(), 1.0) << "the first step from nothing";
  EXPECT_EQ(changeIn(), 0.0);
  release(5, 1.0);
  EXPECT_NEAR(changeIn(), 0.25, 1e-14) << "in units of the largest of any cell";
  release(7, 1.0);
  EXPECT_NEAR(changeIn(), 0.75, 1e-14) << "before or after";
}

TEST_F(StepControls, TellsTheHeatReleaseOfTheWholeDomain) {
  StepControl control(box.context, {});
  std::vector<double> enthalpies(air.size());
  gas.thermo.speciesEnthalpies(500.0, enthalpies);
  const std::size_t water = gas.mechanism.speciesIndex("H2O");
  EXPECT_EQ(control.historyValues(state).at(2), 0.0);
  for (const std::int64_t number : {5, 7})
    if (const int c = box.mesh.findOwned(number); c >= 0)
      state.balance.reactions[at(c) * air.size() + water] = static_cast<double>(number);  // kg/m3/s
  control.endStep(state);
  control.advance(state, 0.0, 1e-5);
  EXPECT_NEAR(control.historyValues(state).at(2) / (-enthalpies[water] * (5.0 + 7.0) / 12.0), 1.0, 1e-14)
      << "of cells of a twelfth of a square metre";
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

TEST_F(StepControls, StepsByHowFarTheLastWentBelowZero) {
  StepControl control(box.context, {.leastMassFraction = -1e-3});
  stepBelow(control, 8e-4);
  EXPECT_NEAR(control.largestStep(state), 2e-5 * 0.5 / 0.8, 1e-18);
  stepBelow(control, 1e-4);
  EXPECT_NEAR(control.largestStep(state), 2e-5 * 0.5 / 0.1, 1e-18)
      << "what was below zero beforehand is no matter of the step";
}

// Else a mass fraction that nothing fills would shorten the steps for ever.
TEST_F(StepControls, DoNotFailByWhatWasBelowZeroBeforehand) {
  StepControl control(box.context, {.leastMassFraction = -1e-3});
  EXPECT_NO_THROW(stepBelow(control, 9.5e-4));
  EXPECT_NO_THROW(stepBelow(control, 0.9e-4));
  EXPECT_THROW(stepBelow(control, 1.1e-4), NumericsError);
}

// Some hydrogen in a gas of several temperatures; two cells beside each other lack some.
class Undershoots : public StepControls {
 protected:
  const std::size_t n = air.size(), H2 = gas.mechanism.speciesIndex("H2"), N2 = gas.mechanism.speciesIndex("N2");
  // Of the cells by their numbers, four in a row.
  const std::vector<double> hydrogen{3e-3, 2e-3, 5e-3, 0.0, 4e-3, -2e-3, -1e-3, 6e-3, 0.0, 1e-3, 2e-3, 8e-3};
  void SetUp() override {
    for (int c = 0; c < box.mesh.owned; ++c) {
      const auto number = at(box.mesh.naturalCell[at(c)]);
      std::vector<double> Y = gas.massFractions("O2: 0.1, N2: 0.79, H2O: 0.2");
      Y[N2] -= hydrogen[number];
      Y[H2] = hydrogen[number];
      std::ranges::copy(Y, state.Y.begin() + static_cast<std::ptrdiff_t>(at(c) * n));
      state.temperature[at(c)] = 600.0 + 100.0 * static_cast<double>(number);
      state.density[at(c)] = gas.thermo.density(state.temperature[at(c)], state.thermodynamicPressure, Y);
      state.enthalpy[at(c)] = gas.thermo.enthalpyMass(state.temperature[at(c)], Y);
    }
    state.updateHalo(box.halo);
  }
  double amount(std::int64_t number, std::size_t species) {
    const int c = box.mesh.findOwned(number);
    return sumOverRanks(c < 0 ? 0.0 : state.Y[at(c) * n + species] * state.density[at(c)] * box.mesh.volume[at(c)]);
  }
  double total(std::size_t species) {
    return integral(box.mesh, [&](int c) { return state.density[at(c)] * state.Y[at(c) * n + species]; });
  }
  double enthalpy() {
    return integral(box.mesh, [&](int c) { return state.density[at(c)] * state.enthalpy[at(c)]; });
  }
};

TEST_F(Undershoots, AreFilledFromTheCellsAround) {
  std::vector<double> before, totals;
  for (std::int64_t number = 0; number < 12; ++number) before.push_back(amount(number, H2));
  for (std::size_t k = 0; k < n; ++k) totals.push_back(total(k));
  const double heat = enthalpy();
  const State start = state;
  UndershootCorrection correction(box.context, 2);
  correction.advance(state, 0.0, 1e-5);
  EXPECT_EQ(state.Y, start.Y) << "the last sweep's alone";
  correction.advance(state, 0.0, 1e-5);
  EXPECT_NEAR(correction.historyValues(state).at(0), -2e-3, 1e-15);
  EXPECT_EQ(correction.historyValues(state).at(0), 0.0);
  EXPECT_EQ(correction.closingLines().at(0),
            "mass fractions below -1e-05, down to -0.002, that got back from the cells around what they lacked: in 1 "
            "steps");
  EXPECT_GT(-largest(box.mesh, [&](int c) { return -state.Y[at(c) * n + H2]; }), -1.02e-5);
  for (std::size_t k = 0; k < n; ++k) EXPECT_NEAR(total(k), totals[k], 1e-15 * totals[N2]) << k;
  EXPECT_NEAR(enthalpy(), heat, 1e-14 * std::abs(heat) + 1e-9);
  for (int c = 0; c < box.mesh.owned; ++c) {
    double sum = 0.0;
    for (std::size_t k = 0; k < n; ++k) sum += state.Y[at(c) * n + k];
    EXPECT_NEAR(sum, 1.0, 1e-15);
    EXPECT_NEAR(gas.thermo.enthalpyMass(state.temperature[at(c)], {&state.Y[at(c) * n], n}), state.enthalpy[at(c)],
                1e-6 * std::abs(state.enthalpy[at(c)]));
    // What is exchanged has the temperature between the two cells, some 1e-3 of what they hold.
    EXPECT_NEAR(state.temperature[at(c)], start.temperature[at(c)], 10.0);
  }
  EXPECT_EQ(state.density, start.density);
  // Cell 5 has 1, 4, 6 and 9 around it, 6 has 2, 5, 7 and 10: both ask in proportion to what is there.
  const auto given = [&](std::int64_t number) {
    return (before[at(number)] - amount(number, H2)) / before[at(number)];
  };
  EXPECT_NEAR(given(4), given(1), 1e-12);
  EXPECT_NEAR(given(9), given(1), 1e-12);
  EXPECT_NEAR(given(7), given(2), 1e-12);
  EXPECT_NEAR(given(10), given(2), 1e-12);
  for (const std::int64_t number : {1, 2, 4, 7, 9, 10}) {
    EXPECT_GT(given(number), 0.05) << number;
    EXPECT_LE(given(number), 0.5) << number;
  }
  for (const std::int64_t number : {0, 3, 8, 11}) EXPECT_NEAR(amount(number, H2), before[at(number)], 1e-18) << number;
}

TEST_F(Undershoots, OfAGasOfOneTemperatureLeaveIt) {
  state.temperature.assign(state.temperature.size(), 1300.0);
  for (int c = 0; c < box.mesh.owned; ++c)
    state.enthalpy[at(c)] = gas.thermo.enthalpyMass(1300.0, {&state.Y[at(c) * n], n});
  state.updateHalo(box.halo);
  UndershootCorrection(box.context, 1).advance(state, 0.0, 1e-5);
  EXPECT_GT(-largest(box.mesh, [&](int c) { return -state.Y[at(c) * n + H2]; }), -1.02e-5);
  for (int c = 0; c < box.mesh.owned; ++c) EXPECT_NEAR(state.temperature[at(c)], 1300.0, 1e-5);
}

TEST_F(Undershoots, OfNextToNothingStay) {
  for (int c = 0; c < box.mesh.owned; ++c) {
    double& Y = state.Y[at(c) * n + H2];
    if (Y < 0.0) Y = -0.99e-5;
  }
  state.updateHalo(box.halo);
  const State start = state;
  UndershootCorrection correction(box.context, 1);
  correction.advance(state, 0.0, 1e-5);
  EXPECT_EQ(state.Y, start.Y);
  EXPECT_EQ(state.temperature, start.temperature);
  EXPECT_EQ(correction.historyValues(state).at(0), -0.99e-5);
  EXPECT_TRUE(correction.closingLines().empty());
}

// Two cells that ask one for more than it gives share that.
TEST_F(Undershoots, TakeNoMoreThanHalf) {
  for (int c = 0; c < box.mesh.owned; ++c) {
    const std::int64_t number = box.mesh.naturalCell[at(c)];
    double& Y = state.Y[at(c) * n + H2];
    Y = number == 6 ? 1e-4 : number == 5 || number == 7 ? -0.03 : 0.0;
  }
  state.updateHalo(box.halo);
  const double before = amount(6, H2);
  UndershootCorrection correction(box.context, 1);
  correction.advance(state, 0.0, 1e-5);
  EXPECT_GT(amount(6, H2), 0.0);
  EXPECT_NEAR(amount(6, H2), before * std::pow(0.5, 6), 1e-3 * before) << "in each of six rounds";
}

}  // namespace
}  // namespace lampblack::test
