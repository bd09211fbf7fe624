// Several processes at once.
#include "particles/population/exact_solutions/extrapolation.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/population/exact_solutions/exact_support.hpp"

namespace lampblack::test {
namespace {

constexpr auto constant = CollisionKernelType::constant;
constexpr auto equalPieces = BreakageOptions::Daughters::equal;
constexpr auto uniform = BreakageOptions::Daughters::uniform;

TEST(ExactCombined, CoagulationAndConstantNucleation) {
  // Wang (2025), case 9: N0 = 1e11 /m3, A = 1e-11 m3/s, J = 1e12 /m3/s; dM0/dt = J - A M0^2/2 is a tanh.
  auto model = coagulating(constant, 1e-11);
  model.nucleation = steadyNuclei(1e12, 1);
  const auto solution = exactSolution(model, equalStart(1e11, 1));
  const double limit = std::sqrt(2 * 1e12 / 1e-11), speed = std::sqrt(1e12 * 1e-11 / 2);
  for (const double time : {0.0, 0.1, 1.0, 30.0}) {
    const auto m = solution->moments(time);
    EXPECT_NEAR(*m[0] / (limit * std::tanh(speed * time + std::atanh(1e11 / limit))), 1, 1e-12) << time;
    const double m1 = 1e11 + 1e12 * time;
    EXPECT_NEAR(*m[1] / m1, 1, 1e-13);
    // The integral of A M1^2 + J.
    const double m2 = 1e11 + 1e12 * time + 1e-11 * (m1 * m1 * m1 - 1e33) / (3 * 1e12);
    EXPECT_NEAR(*m[2] / m2, 1, 1e-12) << time;
  }
  EXPECT_TRUE(solution->numberInBins(1, std::vector<double>{0, 2}).empty());
}

TEST(ExactCombined, CoagulationAndADecayingPrecursor) {
  // With z = exp(-K t), dM0/dt = J0 z - A M0^2/2 is solved by Bessel functions; here Runge-Kutta with many steps.
  auto model = coagulating(constant, 1e-3);
  model.nucleation = precursorNuclei(20, 5e4, 1);
  const auto m = exactSolution(model, equalStart(100, 1))->moments(0.5);
  double y = 100;
  const int steps = 200000;
  const double h = 0.5 / steps;
  const auto f = [](double t, double n) { return 1e6 * std::exp(-20 * t) - 0.5e-3 * n * n; };
  for (int i = 0; i < steps; ++i) {
    const double t = i * h, k1 = f(t, y), k2 = f(t + h / 2, y + h / 2 * k1), k3 = f(t + h / 2, y + h / 2 * k2),
                 k4 = f(t + h, y + h * k3);
    y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  EXPECT_NEAR(*m[0] / y, 1, 1e-11);
  EXPECT_NEAR(*m[1] / (100 + 5e4 * -std::expm1(-10.0)), 1, 1e-12);
}

TEST(ExactCombined, NucleationFromATableStopsAtItsEnd) {
  auto model = coagulating(constant, 1.0);
  model.nucleation = {.source = NucleationOptions::Source::table, .times = {1, 2, 4}, .rates = {0, 6, 6}, .volume = 2};
  const auto solution = exactSolution(model, {});
  EXPECT_EQ(*solution->moments(0.9)[0], 0.0);
  EXPECT_NEAR(*solution->moments(10)[1], 2 * 15, 1e-11);
  // Afterwards pure coagulation: 1/M0 grows by A t / 2.
  EXPECT_NEAR(1 / *solution->moments(9)[0] - 1 / *solution->moments(5)[0], 2, 1e-12);
}

TEST(ExactCombined, CoagulationAndBreakageAtAConstantRate) {
  for (const auto daughters : {equalPieces, uniform}) {
    for (const double rate : {0.25, 0.5, 10.0}) {
      auto model = coagulating(constant);
      model.breakage = BreakageOptions{.rate = rate, .fragments = 2, .daughters = daughters};
      const auto solution = exactSolution(model, exponentialStart());
      for (const double time : {0.3, 5.0, 40.0}) {
        const auto m = solution->moments(time);
        const double number = 2 * rate / (1 + (2 * rate - 1) * std::exp(-rate * time));  // logistic
        EXPECT_NEAR(*m[0] / number, 1, 1e-12) << rate << ' ' << time;
        EXPECT_NEAR(*m[1], 1, 1e-12);
        // dM2/dt = 1 - q M2, q = rate/2 of equal and rate/3 of uniform pieces.
        const double q = rate * (daughters == equalPieces ? 0.5 : 1 / 3.0);
        EXPECT_NEAR(*m[2], 1 / q + (2 - 1 / q) * std::exp(-q * time), 1e-11) << rate << ' ' << time;
      }
    }
  }
}

TEST(ExactCombined, CoagulationAndLinearBreakageKeepAnExponential) {
  // Wang (2025), case 15 is stationary.
  auto model = coagulating(constant);
  model.breakage = BreakageOptions{.rate = 0.5, .exponent = 1, .fragments = 2, .daughters = uniform};
  const auto still = exactSolution(model, exponentialStart());
  const auto m = still->moments(20);
  EXPECT_NEAR(*m[0], 1, 1e-12);
  EXPECT_NEAR(*m[2], 2, 1e-12);
  EXPECT_NEAR(*m[3], 6, 1e-11);
  // Any other balance moves, with the population balance obeyed.
  model.breakage->rate = 2;
  const auto moving = exactSolution(model, exponentialStart());
  const double time = 0.3;
  for (const double v : {0.2, 1.0, 3.0}) {
    const auto n = [&](double u) { return density(*moving, time, u, 1e-4); };
    const double pairs =
        0.5 * simpson([&](double u) { return n(u) * n(v - u); }, 1e-4, v - 1e-4, 400) + 1e-4 * n(1e-4) * n(v - 1e-4);
    const double pieces = 2 * 2 * simpson(n, v, 40, 2000);
    const double losses = (*moving->moments(time)[0] + 2 * v) * n(v);
    EXPECT_NEAR(dndt(*moving, time, v), pairs + pieces - losses, 2e-5) << v;
  }
}

TEST(ExactCombined, LossesAndCondensationChangeTheClock) {
  // Against the equations of the moments, integrated; the additive kernel, where all of them matter.
  auto model = coagulating(CollisionKernelType::additive, 0.7);
  model.deposition = DepositionOptions{.rate = 0.2, .exponent = 0};
  model.dilution = 0.1;
  model.growth.condensation = 0.4;
  const auto solution = exactSolution(model, exponentialStart(2, 0.5));
  const exact::MomentRates rates = [](double, const exact::FourMoments& m) {
    return exact::FourMoments{-0.3 * m[0] - 0.7 * m[0] * m[1], (0.4 - 0.3) * m[1],
                              (0.8 - 0.3) * m[2] + 2 * 0.7 * m[1] * m[2],
                              (1.2 - 0.3) * m[3] + 3 * 0.7 * (m[1] * m[3] + m[2] * m[2])};
  };
  const auto expected = exact::extrapolated(rates, 0, 1.5, {2, 1, 2 * 2 * 0.25, 2 * 6 * 0.125});
  const auto m = solution->moments(1.5);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(*m[k] / expected[k], 1, 1e-12) << k;
  EXPECT_NEAR(sum(solution->numberInBins(1.5, geometricEdges(1e-9, 1e6, 1.5))) / *m[0], 1, 1e-12);
  // Gelation is put off by losses, for ever by strong ones.
  auto gelling = coagulating(CollisionKernelType::multiplicative);
  gelling.dilution = 0.5;
  EXPECT_NEAR(exactSolution(gelling, equalStart())->gelationTime().value(), 2 * std::log(2.0), 1e-14);
  gelling.dilution = 1.5;
  EXPECT_FALSE(exactSolution(gelling, equalStart())->gelationTime());
}

TEST(ExactCombined, CondensationByJumpsIsAYuleProcess) {
  // Particles of k0 monomers that gain one at the rate s k: k is negative binomial with p = exp(-s t), and its
  // cumulants are k0/p, k0 q/p^2, k0 q (1 + q)/p^3.
  PopulationModel model;
  model.growth.condensation = 0.5;
  model.growth.treatment = GrowthOptions::Treatment::jumps;
  model.growth.monomer = 0.2;
  const double k0 = 3, p = std::exp(-0.5 * 2.0), q = 1 - p;
  const double mean = k0 / p, variance = k0 * q / (p * p), third = k0 * q * (1 + q) / (p * p * p);
  const auto m = exactSolution(model, equalStart(7, k0 * 0.2))->moments(2);
  EXPECT_NEAR(*m[0], 7, 1e-12);
  EXPECT_NEAR(*m[1] / (7 * 0.2 * mean), 1, 1e-12);
  EXPECT_NEAR(*m[2] / (7 * 0.04 * (variance + mean * mean)), 1, 1e-12);
  EXPECT_NEAR(*m[3] / (7 * 0.008 * (third + 3 * mean * variance + mean * mean * mean)), 1, 1e-12);
}

TEST(ExactCombined, AConstantEfficiencyIsPartOfTheRate) {
  auto model = coagulating(constant, 4);
  model.coagulation->efficiency = 0.25;
  EXPECT_NEAR(*exactSolution(model, equalStart())->moments(2)[0], 0.5, 1e-15);
  model.coagulation->efficiencyDiameter = 1;
  EXPECT_FALSE(exactSolution(model, equalStart()));
}

TEST(ExactCombined, WhatIsNotClosedHasNoSolution) {
  EXPECT_FALSE(exactSolution(coagulating(CollisionKernelType::freeMolecular), equalStart()));
  auto model = coagulating(constant);
  model.growth.surfaceGrowth = 1;
  EXPECT_FALSE(exactSolution(model, equalStart()));
  model.growth.surfaceGrowth = 0;
  model.breakage = BreakageOptions{.rate = 1, .exponent = 2};
  EXPECT_FALSE(exactSolution(model, equalStart()));
  model.breakage->exponent = 1;  // the number alone
  const auto m = exactSolution(model, equalStart())->moments(1);
  EXPECT_TRUE(m[0] && m[1] && !m[2] && !m[3]);
}

}  // namespace
}  // namespace lampblack::test
