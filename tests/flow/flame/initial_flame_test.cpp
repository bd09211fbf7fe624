// First profiles of flames: what has to hold of them whatever the flame.
#include "flow/flame/initial_flame.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "flow/flame/stream_mixture.hpp"
#include "tests/every_module.hpp"
#include "tests/flow/flame/initial_flame_checks.hpp"
#include "tests/messages.hpp"

namespace lampblack::test {
namespace {

TEST(InitialFlame, FreeFlamesGoFromFreshToBurntAtConstantEnthalpyWithRoomOnBothSides) {
  for (const auto& [gas, moles] : {std::pair{&Gas::methane(), stoichiometric},
                                   {&Gas::methane(), "CH4: 0.6, O2: 2, N2: 7.52"},
                                   {&Gas::methane(), "CH4: 1.5, O2: 2, N2: 7.52"},
                                   {&Gas::hydrogen(), "H2: 2, O2: 1, N2: 3.76"},
                                   {&Gas::hydrogen(), "H2: 0.8, O2: 1, N2: 3.76"}}) {
    const auto problem = oneStream(*gas, FlameType::Free, moles, 0);
    const auto p = initialFlame(gas->mechanism, problem, 3);
    const double burnt = gas->equilibriumTemperature(problem.left);
    expectSound(*gas, problem, p, 300, burnt);
    expectElementsMixed(*gas, problem, p);
    EXPECT_NEAR(p.temperature(p.points() - 1), burnt, 1e-6 * burnt);
    const double h = gas->thermo.enthalpyMass(300, problem.left.Y);
    std::size_t inside = 0;
    for (std::size_t i = 0; i < p.points(); ++i) {
      EXPECT_NEAR(gas->thermo.enthalpyMass(p.temperature(i), p.massFractions(i)), h, 1.0);
      inside += p.temperature(i) > 350 && p.temperature(i) < burnt - 50;
      EXPECT_EQ(p.at(i, FlameLayout::massFlux), p.global(leftMassFlux));
    }
    EXPECT_GE(inside, 8u) << "points within the flame";
    EXPECT_NEAR(p.temperature(1), 300, 1.0);
    EXPECT_NEAR(p.temperature(p.points() - 2), burnt, 1.0);
  }
}

// The guess need not be good, but of the right order: within a factor of two of speeds that are known well (methane
// 0.37 m/s and hydrogen 2.3 m/s in air, lean methane 0.11 m/s at equivalence ratio 0.6); of four where hydrogen spreads
// faster than heat.
TEST(InitialFlame, SpeedIsOfTheRightOrder) {
  const auto speed = [](const Gas& gas, const char* moles) {
    const auto problem = oneStream(gas, FlameType::Free, moles, 0);
    return initialFlame(gas.mechanism, problem, 0).global(leftMassFlux) /
           gas.thermo.density(300, problem.pressure, problem.left.Y);
  };
  EXPECT_NEAR(std::log2(speed(Gas::methane(), stoichiometric) / 0.37), 0, 1);
  EXPECT_NEAR(std::log2(speed(Gas::methane(), "CH4: 0.6, O2: 2, N2: 7.52") / 0.11), 0, 1);
  EXPECT_NEAR(std::log2(speed(Gas::hydrogen(), "H2: 2, O2: 1, N2: 3.76") / 2.3), 0, 1);
  // Speeds that the solver finds: 7.25 m/s in air of 600 K, 0.067 m/s at 40 atm, 3.07 m/s in oxygen, 4.7 m/s lean.
  const auto away = [](const Gas& gas, const char* moles, double T, double atmospheres, double found) {
    auto problem = oneStream(gas, FlameType::Free, moles, 0);
    problem.left.temperature = T;
    problem.pressure = atmospheres * 101325;
    return std::log2(initialFlame(gas.mechanism, problem, 0).global(leftMassFlux) /
                     gas.thermo.density(T, problem.pressure, problem.left.Y) / found);
  };
  EXPECT_NEAR(away(Gas::hydrogen(), "H2: 2, O2: 1, N2: 3.76", 600, 1, 7.25), 0, 2);
  EXPECT_NEAR(away(Gas::methane(), stoichiometric, 298, 40, 0.067), 0, 1);
  EXPECT_NEAR(away(Gas::methane(), "CH4: 1, O2: 2", 298, 1, 3.07), 0, 1);
  EXPECT_NEAR(away(Gas::hydrogen(), "H2: 0.6, O2: 1", 298, 1, 4.7), 0, 2);
  auto problem = oneStream(Gas::methane(), FlameType::Free);
  problem.left.massFlux = 0.7;
  EXPECT_EQ(initialFlame(Gas::methane().mechanism, problem, 0).global(leftMassFlux), 0.7) << "a given guess counts";
}

TEST(InitialFlame, BurnerFlamesHaveTheirMassFluxAndTheGivenTemperature) {
  const Gas& gas = Gas::methane();
  auto problem = oneStream(gas, FlameType::Burner);
  const double burnt = gas.equilibriumTemperature(problem.left);
  auto p = initialFlame(gas.mechanism, problem, 0);
  expectSound(gas, problem, p, 300, burnt);
  expectElementsMixed(gas, problem, p);
  EXPECT_EQ(p.at(p.points() - 1, FlameLayout::massFlux), problem.left.massFlux);
  problem.given = GivenTemperature{{0, 0.002, 0.01}, {500, 1700, 1500}};
  p = initialFlame(gas.mechanism, problem, 0);
  expectSound(gas, problem, p, 500, 1700);
  for (std::size_t i = 0; i < p.points(); ++i) {
    const double z = p.z[i];
    const double given = z < 0.002 ? 500 + 6e5 * z : (z < 0.01 ? 1700 - 25000 * (z - 0.002) : 1500);
    EXPECT_NEAR(p.temperature(i), given, 1e-9);
  }
}

TEST(InitialFlame, AFlameAtAWallBurnsAheadOfItAndStopsThere) {
  const Gas& gas = Gas::methane();
  auto problem = oneStream(gas, FlameType::Wall, stoichiometric, 1.0);
  const double burnt = gas.equilibriumTemperature(problem.left);
  for (const auto nozzles : {FlameNozzles::Plug, FlameNozzles::Potential}) {
    problem.nozzles = nozzles;
    problem.strainRate = 80;
    const auto p = initialFlame(gas.mechanism, problem, 0);
    expectSound(gas, problem, p, 300, burnt);
    expectElementsMixed(gas, problem, p);
    const std::size_t last = p.points() - 1;
    EXPECT_EQ(p.at(last, FlameLayout::massFlux), 0.0);
    EXPECT_EQ(p.at(last, FlameLayout::spread), 0.0);
    EXPECT_EQ(p.temperature(last), 400.0);
    EXPECT_LT(p.global(pressureGradient), 0.0);
    EXPECT_EQ(p.at(0, FlameLayout::spread) > 0, nozzles == FlameNozzles::Potential);
    EXPECT_GT(p.peakTemperature(), 0.8 * burnt);
    if (nozzles == FlameNozzles::Plug) {
      EXPECT_EQ(p.global(leftMassFlux), problem.left.massFlux);
    }
  }
}

TEST(InitialFlame, WhatCannotBurnFlowsAndMixesAndIsAnErrorOfAFreeFlame) {
  const Gas& gas = Gas::methane();
  for (const auto& [moles, part] :
       {std::pair{air, "no fuel"}, {"CH4: 1, N2: 1", "no oxidiser"}, {"CH4: 1, O2: 2, N2: 900", "burns to only"}}) {
    const auto free = oneStream(gas, FlameType::Free, moles);
    EXPECT_THAT(messageOf<InputError>([&] { static_cast<void>(initialFlame(gas.mechanism, free, 0)); }),
                ::testing::HasSubstr(part));
    EXPECT_THAT(inertReason(gas.mechanism, free), ::testing::HasSubstr(part));
    for (const auto type : {FlameType::Burner, FlameType::Wall}) {
      const auto problem = oneStream(gas, type, moles);
      expectSound(gas, problem, initialFlame(gas.mechanism, problem, 0), 300, 400);
    }
  }
  for (const auto& [left, right, part] :
       {std::tuple{"N2: 1", air, "neither has fuel"}, {"N2: 1", "CH4: 1", "neither has an oxidiser"}}) {
    const auto problem = counterflowProblem(gas, left, right);
    EXPECT_THAT(inertReason(gas.mechanism, problem), ::testing::HasSubstr(part));
    const auto p = initialFlame(gas.mechanism, problem, 0);
    expectSound(gas, problem, p, 300, 350);
    expectElementsMixed(gas, problem, p);
  }
  EXPECT_EQ(inertReason(gas.mechanism, counterflowProblem(gas)), "");
  InitialFlameOptions cold;
  cold.cold = true;
  const auto problem = counterflowProblem(gas);
  const auto p = initialFlame(gas.mechanism, problem, 0, cold);
  expectSound(gas, problem, p, 300, 350);
  expectElementsMixed(gas, problem, p);
  EXPECT_THROW(static_cast<void>(initialFlame(gas.mechanism, oneStream(gas, FlameType::Free), 0, cold)), InputError);
}

// Half a triangle's width above a kink the mean falls short by a sixth of the width times the change of slope.
TEST(GivenTemperature, IsSmoothedWithoutItsEndsAndStraightParts) {
  const double width = 2e-3, slope = 1e5;
  const GivenTemperature kinked{{0, 0.01, 0.02}, {300, 1300, 1300}};
  const GivenTemperature smooth = kinked.smoothed(width, 0.02);
  EXPECT_NEAR(smooth.at(0), 300, 1e-9);
  EXPECT_NEAR(smooth.at(0.02), 1300, 1e-9);
  for (const double z : {0.001, 0.005, 0.0079}) EXPECT_NEAR(smooth.at(z), 300 + slope * z, 1e-6) << z;
  EXPECT_NEAR(smooth.at(0.01), 1300 - slope * width / 6, 0.1);
  double largest = 0;
  for (std::size_t i = 1; i + 1 < smooth.z.size(); ++i)
    largest = std::max(largest, std::abs((smooth.T[i + 1] - smooth.T[i]) / (smooth.z[i + 1] - smooth.z[i]) -
                                         (smooth.T[i] - smooth.T[i - 1]) / (smooth.z[i] - smooth.z[i - 1])));
  EXPECT_LT(largest, 0.06 * slope) << "of a slope that falls by all of it over two widths of 20 points";
}

// The equilibrium of ethylene, soot's precursors, is warmer than a cold stream; on a burner or in a counterflow it
// flows and mixes all the same. Acetylene burns.
TEST(InitialFlame, WhatOnlyCracksBurnsOnlyWhereAFlameIsAskedFor) {
  const Gas gas("ethylene_abf2000_101.yaml");
  EXPECT_EQ(inertReason(gas.mechanism, oneStream(gas, FlameType::Free, "C2H4: 1")), "");
  EXPECT_NE(inertReason(gas.mechanism, oneStream(gas, FlameType::Burner, "C2H4: 1")), "");
  EXPECT_NE(inertReason(gas.mechanism, counterflowProblem(gas, "C2H4: 1", "N2: 1")), "");
  EXPECT_EQ(inertReason(gas.mechanism, oneStream(gas, FlameType::Burner, "C2H2: 0.2, N2: 0.8")), "");
  EXPECT_EQ(inertReason(gas.mechanism, counterflowProblem(gas, "C2H2: 0.4, N2: 0.6", "N2: 1")), "");
}

// Without fuel or without oxidiser: what its equilibrium is hotter than.
TEST(InitialFlame, WhatDecomposesToHotterProductsBurns) {
  const Gas& gas = Gas::hydrogen();
  for (const auto& [moles, burns] : {std::pair{"H2O2: 0.8, H2O: 0.2", true},
                                     {"H2O2: 0.01, H2O: 0.99", false},
                                     {"H2: 1", false},
                                     {"O2: 1, H2O: 1", false}}) {
    const auto free = oneStream(gas, FlameType::Free, moles);
    EXPECT_EQ(inertReason(gas.mechanism, free).empty(), burns) << moles;
    auto opposed = counterflowProblem(gas, moles, "N2: 1");
    EXPECT_EQ(inertReason(gas.mechanism, opposed).empty(), burns) << moles;
    std::swap(opposed.left, *opposed.right);
    EXPECT_EQ(inertReason(gas.mechanism, opposed).empty(), burns) << moles;
    if (!burns) continue;
    auto given = oneStream(gas, FlameType::Burner, moles);
    EXPECT_EQ(inertReason(gas.mechanism, given), "");
    given.given = GivenTemperature{{0, 0.01}, {300, 1500}};
    EXPECT_NE(inertReason(gas.mechanism, given), "") << "hot it is anyway";
    const double burnt = gas.equilibriumTemperature(free.left);
    EXPECT_NEAR(initialFlame(gas.mechanism, free, 0).peakTemperature(), burnt, 1);
    EXPECT_GT(initialFlame(gas.mechanism, opposed, 0).peakTemperature(), 0.8 * burnt);
  }
}

}  // namespace
}  // namespace lampblack::test
