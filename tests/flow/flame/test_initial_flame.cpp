// First profiles of flames: what has to hold of them whatever the flame.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "chemistry/thermo/equilibrium.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/errors.hpp"
#include "flow/flame/initial_flame.hpp"
#include "flow/flame/mixing_profile.hpp"

namespace lampblack::test {
namespace {

struct Gas {
  explicit Gas(const std::string& file)
      : mechanism(Mechanism::fromFile(std::string(LAMPBLACK_SOURCE_DIR) + "/cases/mechanisms/" + file)),
        thermo(mechanism) {}
  static Gas& methane() {
    static Gas gas("methane_drm19_21.yaml");
    return gas;
  }
  static Gas& hydrogen() {
    static Gas gas("hydrogen_h2o2_10.yaml");
    return gas;
  }
  [[nodiscard]] FlameStream stream(std::string_view moles, double T, double speed = 0, double p = 101325) const {
    FlameStream s;
    s.temperature = T;
    const auto X = parseComposition(mechanism, moles);
    s.Y.resize(X.size());
    thermo.moleToMass(X, s.Y);
    s.massFlux = speed * thermo.density(T, p, s.Y);
    return s;
  }
  [[nodiscard]] double equilibriumTemperature(const FlameStream& s, double p = 101325) const {
    auto Y = s.Y;
    return Equilibrium(mechanism).atEnthalpyAndPressure(thermo.enthalpyMass(s.temperature, s.Y), p, Y);
  }
  // Mass fraction of an element.
  [[nodiscard]] double element(std::size_t e, std::span<const double> Y) const {
    double sum = 0;
    for (std::size_t k = 0; k < Y.size(); ++k)
      sum += mechanism.atoms(k, e) * mechanism.atomicWeight(e) * Y[k] / mechanism.molecularWeights()[k];
    return sum;
  }
  Mechanism mechanism;
  Thermo thermo;
};

constexpr const char* stoichiometric = "CH4: 1, O2: 2, N2: 7.52";
constexpr const char* air = "O2: 0.21, N2: 0.79";

FlameProblem counterflowProblem(const Gas& gas, const char* left = "CH4: 1", const char* right = air) {
  FlameProblem p;
  p.type = FlameType::Counterflow;
  p.left = gas.stream(left, 300, 0.3);
  p.right = gas.stream(right, 350, 0.25);
  return p;
}

FlameProblem oneStream(const Gas& gas, FlameType type, const char* moles = stoichiometric, double speed = 0.2) {
  FlameProblem p;
  p.type = type;
  p.left = gas.stream(moles, 300, speed);
  p.wallTemperature = 400;
  return p;
}

// Fractions between 0 and 1 that sum to 1, the streams at the ends, temperatures between `coldest` and `hottest`, and
// mass fluxes as finite volumes around the points have them.
void expectSound(const Gas& gas, const FlameProblem& problem, const FlameProfile& p, double coldest, double hottest) {
  EXPECT_EQ(p.z.front(), 0.0);
  EXPECT_EQ(p.z.back(), problem.length);
  double flux = p.global(leftMassFlux);
  double largest = std::abs(flux);
  for (std::size_t i = 0; i < p.points(); ++i) {
    double sum = 0;
    for (double Y : p.massFractions(i)) {
      sum += Y;
      EXPECT_GE(Y, 0.0);
      EXPECT_LE(Y, 1.0 + 1e-14);
    }
    EXPECT_NEAR(sum, 1.0, 1e-13) << i;
    EXPECT_GE(p.temperature(i), coldest * (1 - 1e-12)) << i;
    EXPECT_LE(p.temperature(i), hottest * (1 + 1e-9)) << i;
    EXPECT_GE(p.at(i, FlameLayout::spread), 0.0);
    const double low = i == 0 ? p.z[0] : 0.5 * (p.z[i - 1] + p.z[i]);
    const double high = i + 1 == p.points() ? p.z[i] : 0.5 * (p.z[i] + p.z[i + 1]);
    const double rho = gas.thermo.density(p.temperature(i), problem.pressure, p.massFractions(i));
    flux -= 2 * rho * p.at(i, FlameLayout::spread) * (high - low);
    largest = std::max(largest, std::abs(flux));
    EXPECT_NEAR(p.at(i, FlameLayout::massFlux), flux, 1e-12 * largest) << i;
    for (double s : p.scalars(i)) EXPECT_EQ(s, 0.0);
    if (i > 0) {
      EXPECT_GT(p.z[i], p.z[i - 1]);
    }
  }
  EXPECT_EQ(p.global(load), 1.0);
  for (std::size_t k = 0; k < p.layout.species; ++k) EXPECT_NEAR(p.massFractions(0)[k], problem.left.Y[k], 1e-14);
  if (!problem.given) {
    EXPECT_EQ(p.temperature(0), problem.left.temperature);
  }
  if (problem.right) {
    for (std::size_t k = 0; k < p.layout.species; ++k)
      EXPECT_NEAR(p.massFractions(p.points() - 1)[k], problem.right->Y[k], 1e-14);
    EXPECT_EQ(p.temperature(p.points() - 1), problem.right->temperature);
  }
}

// Largest difference of the elements from a straight line between those of the streams, over a share that falls.
void expectElementsMixed(const Gas& gas, const FlameProblem& problem, const FlameProfile& p) {
  const auto& left = problem.left.Y;
  const auto& right = problem.right ? problem.right->Y : problem.left.Y;
  // The element that differs most between the streams tells the share.
  std::size_t best = 0;
  for (std::size_t e = 1; e < gas.mechanism.numElements(); ++e)
    if (std::abs(gas.element(e, left) - gas.element(e, right)) >
        std::abs(gas.element(best, left) - gas.element(best, right)))
      best = e;
  double previous = 1;
  for (std::size_t i = 0; i < p.points(); ++i) {
    const auto Y = p.massFractions(i);
    const double difference = gas.element(best, left) - gas.element(best, right);
    const double share = difference == 0 ? 0 : (gas.element(best, Y) - gas.element(best, right)) / difference;
    EXPECT_LE(share, previous + 1e-9);
    previous = share;
    for (std::size_t e = 0; e < gas.mechanism.numElements(); ++e)
      // Equilibria keep their elements to about 1e-10.
      EXPECT_NEAR(gas.element(e, Y), share * gas.element(e, left) + (1 - share) * gas.element(e, right), 1e-9)
          << gas.mechanism.elementName(e) << " at point " << i;
  }
}

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
// 0.37 m/s and hydrogen 2.3 m/s in air, lean methane 0.11 m/s at equivalence ratio 0.6).
TEST(InitialFlame, SpeedIsOfTheRightOrder) {
  const auto speed = [](const Gas& gas, const char* moles) {
    const auto problem = oneStream(gas, FlameType::Free, moles, 0);
    return initialFlame(gas.mechanism, problem, 0).global(leftMassFlux) /
           gas.thermo.density(300, problem.pressure, problem.left.Y);
  };
  EXPECT_NEAR(std::log2(speed(Gas::methane(), stoichiometric) / 0.37), 0, 1);
  EXPECT_NEAR(std::log2(speed(Gas::methane(), "CH4: 0.6, O2: 2, N2: 7.52") / 0.11), 0, 1);
  EXPECT_NEAR(std::log2(speed(Gas::hydrogen(), "H2: 2, O2: 1, N2: 3.76") / 2.3), 0, 1);
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
    double hottest = 0;
    for (std::size_t i = 0; i <= last; ++i) hottest = std::max(hottest, p.temperature(i));
    EXPECT_GT(hottest, 0.8 * burnt);
    if (nozzles == FlameNozzles::Plug) {
      EXPECT_EQ(p.global(leftMassFlux), problem.left.massFlux);
    }
  }
}

TEST(InitialFlame, CounterflowDiffusionFlamesBurnAtStoichiometry) {
  for (const auto& [gas, fuel, oxidiser] : {std::tuple{&Gas::methane(), "CH4: 1", air},
                                            {&Gas::methane(), "CH4: 0.3, N2: 0.7", "O2: 1"},
                                            {&Gas::hydrogen(), "H2: 0.5, N2: 0.5", air}}) {
    for (const bool swapped : {false, true}) {
      auto problem = counterflowProblem(*gas, swapped ? oxidiser : fuel, swapped ? fuel : oxidiser);
      const auto p = initialFlame(gas->mechanism, problem, 2);
      // Methane (or nothing) over the air that burns it, by mass; the hottest is at most its equilibrium.
      const auto content = [&](const char* element, const std::vector<double>& Y) {
        const auto e = gas->mechanism.findElement(element);
        return e ? gas->element(*e, Y) / gas->mechanism.atomicWeight(*e) : 0.0;
      };
      const auto missing = [&](const std::vector<double>& Y) {
        return 2 * content("C", Y) + 0.5 * content("H", Y) - content("O", Y);
      };
      const double share = missing(problem.right->Y) / (missing(problem.right->Y) - missing(problem.left.Y));
      FlameStream mixed = problem.left;
      double h = share * gas->thermo.enthalpyMass(300, problem.left.Y) +
                 (1 - share) * gas->thermo.enthalpyMass(350, problem.right->Y);
      for (std::size_t k = 0; k < mixed.Y.size(); ++k)
        mixed.Y[k] = share * problem.left.Y[k] + (1 - share) * problem.right->Y[k];
      const double burnt = Equilibrium(gas->mechanism).atEnthalpyAndPressure(h, problem.pressure, mixed.Y);
      expectSound(*gas, problem, p, 300, burnt);
      expectElementsMixed(*gas, problem, p);
      EXPECT_EQ(p.global(leftMassFlux), problem.left.massFlux);
      EXPECT_EQ(p.at(p.points() - 1, FlameLayout::massFlux), -problem.right->massFlux);
      EXPECT_LT(p.global(pressureGradient), 0.0);
      double hottest = 0;
      std::size_t warm = 0;
      for (std::size_t i = 0; i < p.points(); ++i) {
        hottest = std::max(hottest, p.temperature(i));
        warm += p.temperature(i) > 0.5 * burnt;
      }
      EXPECT_GT(hottest, 0.95 * burnt);
      EXPECT_GE(warm, 10u);
    }
  }
}

TEST(InitialFlame, PotentialFlowHasItsStrainAtTheRightAndItsStagnationPlane) {
  const Gas& gas = Gas::methane();
  auto problem = counterflowProblem(gas);
  problem.nozzles = FlameNozzles::Potential;
  problem.strainRate = 100;
  problem.stagnationPlane = 0.009;
  const auto p = initialFlame(gas.mechanism, problem, 0);
  expectSound(gas, problem, p, 300, 3000);
  const double rightDensity = gas.thermo.density(350, problem.pressure, problem.right->Y);
  const double leftDensity = gas.thermo.density(300, problem.pressure, problem.left.Y);
  const std::size_t last = p.points() - 1;
  EXPECT_NEAR(p.at(last, FlameLayout::spread), 100, 1e-6);
  EXPECT_NEAR(p.at(0, FlameLayout::spread), 100 * std::sqrt(rightDensity / leftDensity), 1e-6);
  EXPECT_NEAR(p.global(pressureGradient), -rightDensity * 1e4, 1e-9 * rightDensity * 1e4);
  // The flux changes sign within an interval or two of the plane.
  std::size_t face = 0;
  while (p.at(face, FlameLayout::massFlux) > 0) ++face;
  EXPECT_NEAR(0.5 * (p.z[face] + p.z[face + 1]), 0.009, 1e-3);
}

TEST(InitialFlame, PremixedCounterflowsBurnInTwinsAndAgainstHotProducts) {
  const Gas& gas = Gas::methane();
  auto problem = counterflowProblem(gas, "CH4: 0.8, O2: 2, N2: 7.52", "CH4: 0.8, O2: 2, N2: 7.52");
  auto p = initialFlame(gas.mechanism, problem, 0);
  const double burnt = gas.equilibriumTemperature(*problem.right);
  expectSound(gas, problem, p, 300, burnt);
  EXPECT_GT(p.temperature(p.points() / 2), 0.9 * burnt);

  problem.right = gas.stream("N2: 1", 1800, 0.5);
  p = initialFlame(gas.mechanism, problem, 0);
  expectSound(gas, problem, p, 300, gas.equilibriumTemperature(problem.left) + 300);
  expectElementsMixed(gas, problem, p);
  double hottest = 0;
  for (std::size_t i = 0; i < p.points(); ++i) hottest = std::max(hottest, p.temperature(i));
  EXPECT_GT(hottest, 1850);
}

TEST(InitialFlame, WhatCannotBurnIsAnErrorUnlessItIsToBeCold) {
  const Gas& gas = Gas::methane();
  const auto fails = [&](const FlameProblem& problem, const char* part) {
    try {
      static_cast<void>(initialFlame(gas.mechanism, problem, 0));
      ADD_FAILURE() << "no error: " << part;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  for (const auto type : {FlameType::Free, FlameType::Burner, FlameType::Wall}) {
    fails(oneStream(gas, type, air), "no fuel");
    fails(oneStream(gas, type, "CH4: 1, N2: 1"), "no oxidiser");
    fails(oneStream(gas, type, "CH4: 1, O2: 2, N2: 900"), "burns to only");
    auto problem = oneStream(gas, type, "N2: 1");
    InitialFlameOptions cold;
    cold.cold = true;
    if (type == FlameType::Free) {
      EXPECT_THROW(static_cast<void>(initialFlame(gas.mechanism, problem, 0, cold)), InputError);
    } else {
      const auto p = initialFlame(gas.mechanism, problem, 0, cold);
      expectSound(gas, problem, p, 300, 400);
    }
  }
  fails(counterflowProblem(gas, "N2: 1", air), "neither has fuel");
  fails(counterflowProblem(gas, "N2: 1", "CH4: 1"), "neither has an oxidiser");
  InitialFlameOptions cold;
  cold.cold = true;
  const auto problem = counterflowProblem(gas);
  const auto p = initialFlame(gas.mechanism, problem, 0, cold);
  expectSound(gas, problem, p, 300, 350);
  expectElementsMixed(gas, problem, p);
}

// Constant properties: an error function around the stagnation plane.
TEST(MixingProfile, IsAnErrorFunctionInAPotentialFlowOfConstantProperties) {
  const double rho = 1.2, gamma = 3e-5, a = 100, plane = 0.004;
  const auto p =
      mixOpposedStreams({0.01, 0, 0, true, a, plane, [=](double) { return rho; }, [=](double) { return gamma; }});
  EXPECT_NEAR(p.lambda, -rho * a * a, 1e-9 * rho * a * a);
  EXPECT_NEAR(p.leftFlux, 2 * rho * a * plane, 1e-12);
  for (std::size_t i = 0; i < p.z.size(); ++i) {
    EXPECT_NEAR(p.spread[i], a, 1e-9);
    // Trapezia of 25 um across a layer of 0.5 mm err by (25/500)^2 / 12 of the share.
    EXPECT_NEAR(p.share[i], 0.5 * std::erfc((p.z[i] - plane) * std::sqrt(rho * a / gamma)), 5e-4);
  }
}

TEST(MixingProfile, PlugStreamsMeetByTheirMomentum) {
  // Densities as of two gases, mixed linearly by specific volume; no heat.
  const double left = 0.65, right = 1.17, U = 0.3, W = 0.2, length = 0.02;
  const auto p =
      mixOpposedStreams({length, left * U, right * W, false, 0, 0,
                         [=](double s) { return 1 / (s / left + (1 - s) / right); }, [](double) { return 1e-7; }});
  // rho U^2/zs^2 is alike on both sides; the layer is thin at this low diffusivity.
  const double plane = length * std::sqrt(left) * U / (std::sqrt(left) * U + std::sqrt(right) * W);
  EXPECT_NEAR(p.lambda, -left * U * U / (plane * plane), 0.01 * left * U * U / (plane * plane));
  std::size_t half = 0;
  while (p.share[half] > 0.5) ++half;
  EXPECT_NEAR(p.z[half], plane, 1e-4);
  EXPECT_EQ(p.share.front(), 1.0);
  EXPECT_NEAR(p.share.back(), 0.0, 1e-15);
  EXPECT_EQ(p.spread.front(), 0.0);
  EXPECT_EQ(p.spread.back(), 0.0);
}

}  // namespace
}  // namespace lampblack::test
