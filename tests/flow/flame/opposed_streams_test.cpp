// First profiles between two streams, and the mixing layer they are made from.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "flow/flame/initial_flame.hpp"
#include "flow/flame/mixing_profile.hpp"
#include "tests/every_module.hpp"
#include "tests/flow/flame/initial_flame_checks.hpp"

namespace lampblack::test {
namespace {

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
      std::size_t warm = 0;
      for (std::size_t i = 0; i < p.points(); ++i) warm += p.temperature(i) > 0.5 * burnt;
      EXPECT_GT(p.peakTemperature(), 0.95 * burnt);
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
  EXPECT_GT(p.peakTemperature(), 1850);
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
