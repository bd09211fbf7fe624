// The method that draws pairs against exact solutions.
#include <gtest/gtest.h>

#include <cmath>

#include "../pairs_test_cases.hpp"

namespace lampblack::test {
namespace {

using enum CollisionKernelType;

void expectMass(const std::array<std::vector<double>, 4>& moments, double exact) {
  for (const double m1 : moments[1]) EXPECT_NEAR(m1, exact, 1e-11 * exact);
}

// tau = A N0 t = 10: M0 = 1/6, m2 = 1 + tau, m3 = 1 + 3 tau + 3 tau^2 / 2 from equal particles.
TEST(Pairs, AreRightForTheConstantKernel) {
  const auto m = momentsAt(10, colliding(constant, 1), startOf(Distribution::monodisperse), pairsOf(500), 400);
  expectMoment(m, 0, 1.0 / 6);
  expectMoment(m, 2, 11);
  expectMoment(m, 3, 181);
  expectMass(m, 1);
}

TEST(Pairs, AreRightForTheConstantKernelFromASpread) {
  const auto m = momentsAt(4, colliding(constant, 1), startOf(Distribution::exponential), pairsOf(300), 200);
  expectMoment(m, 0, 1.0 / 3);
  expectMoment(m, 2, 6);
  expectMoment(m, 3, 54);
  expectMass(m, 1);
}

// M0 and M2 of the additive kernel are linear in themselves: no bias at all, however few particles there are, if those
// of one numerical particle meet; without them M2 would be 1/N and more off. What candidates in time leave of errors
// goes with their probability.
TEST(Pairs, MeetWithinANumericalParticle) {
  const double tau = 0.5;
  for (const std::size_t particles : {2u, 5u}) {
    auto options = pairsOf(particles);
    options.pairProbability = 0.01;
    const auto m = momentsAt(tau, colliding(additive, 1), startOf(Distribution::monodisperse), options, 10000);
    expectMoment(m, 0, std::exp(-tau));
    expectMoment(m, 2, std::exp(2 * tau));
    expectMass(m, 1);
  }
}

TEST(Pairs, AreRightForTheAdditiveKernel) {
  const double tau = 0.8;
  const auto m = momentsAt(tau, colliding(additive, 1), startOf(Distribution::monodisperse), pairsOf(500), 400);
  expectMoment(m, 0, std::exp(-tau));
  expectMoment(m, 2, std::exp(2 * tau));
  expectMoment(m, 3, 3 * std::exp(4 * tau) - 2 * std::exp(3 * tau));
}

// tau = A N0 v0^2 t = 0.5, half way to the gel: M0 = 1 - tau/2, M2 = 1/(1 - tau), M3 = 1/(1 - tau)^3.
TEST(Pairs, AreRightForTheMultiplicativeKernel) {
  const auto m = momentsAt(0.5, colliding(multiplicative, 1), startOf(Distribution::monodisperse), pairsOf(2000), 100);
  expectMoment(m, 0, 0.75);
  expectMoment(m, 2, 2);
  expectMoment(m, 3, 8);
}

// dM0/dt = -M0^2/2: the mean is low by the relative variance, which goes with 1/N.
TEST(Pairs, ErrWithTheInverseOfTheirNumber) {
  const auto error = [](std::size_t particles, std::uint64_t repeats) {
    const auto m =
        momentsAt(10, colliding(constant, 1), startOf(Distribution::monodisperse), pairsOf(particles), repeats);
    const Sample sample = summarise(m[0]);
    const double variance = std::pow(6 * sample.standardError, 2) * static_cast<double>(repeats);
    EXPECT_NEAR(6 * sample.mean - 1, -variance, 0.5 * variance) << particles;
    return 6 * sample.mean - 1;
  };
  EXPECT_NEAR(std::log2(error(8, 8000) / error(32, 8000)) / 2, 1, 0.4);
}

// A tanh for constant kernel and constant nucleation; M1 and M2 are polynomials.
TEST(Pairs, AreRightWithNucleation) {
  PopulationModel model = colliding(constant, 0.1);
  model.nucleation.emplace();
  model.nucleation->rate = 10;
  const double end = 2, limit = std::sqrt(2 * 10 / 0.1);
  auto options = pairsOf(500);
  options.splitChange = 0.05;
  const auto m = momentsAt(end, model, startOf(Distribution::monodisperse), options, 200);
  expectMoment(m, 0, limit * std::tanh(std::atanh(1 / limit) + std::sqrt(0.5) * end));
  expectMass(m, 21);
  expectMoment(m, 2, 21 + 0.1 * (std::pow(21, 3) - 1) / 30);
}

// From nothing, where weights rise from step to step: M0 = sqrt(2 J/A) tanh(sqrt(J A/2) t), M2 = J t + A J^2 t^3 / 3.
TEST(Pairs, AreRightFromNothing) {
  PopulationModel model = colliding(constant, 0.1);
  model.nucleation.emplace();
  model.nucleation->rate = 10;
  const double end = 0.6;
  const auto m = momentsAt(end, model, {}, pairsOf(500), 200);
  expectMoment(m, 0, std::sqrt(200) * std::tanh(std::sqrt(0.5) * end));
  expectMoment(m, 2, 10 * end + 10 * std::pow(end, 3) / 3);
  const auto solver = makeMonteCarlo(model, {}, pairsOf(500));
  solver->advance(end);
  EXPECT_LT(static_cast<double>(solver->counters().limited), 0.02 * static_cast<double>(solver->counters().fictitious));
  EXPECT_GT(solver->particles(), 400u);
}

// Nuclei alone, from nothing, to the last bits.
TEST(Pairs, NucleateWithoutNoise) {
  PopulationModel model;
  model.nucleation.emplace();
  model.nucleation->source = NucleationOptions::Source::precursor;
  model.nucleation->rateConstant = 2;
  model.nucleation->precursor = 1e5;
  const auto m = momentsAt(1.5, model, {}, pairsOf(100), 2);
  const double exact = 1e5 * -std::expm1(-3.0);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(m[k][0], exact, 1e-11 * exact);
}

// M0 = 1 + t for uniform halves at the rate v, however they are merged.
TEST(Pairs, BreakWithoutBias) {
  PopulationModel model;
  model.breakage = BreakageOptions{1, 1, 2, BreakageOptions::Daughters::uniform};
  const auto m = momentsAt(8, model, startOf(Distribution::monodisperse), pairsOf(300), 200);
  expectMoment(m, 0, 9);
  expectMass(m, 1);
}

// Constant kernel with breakage at a constant rate: dM0/dt = b M0 - A M0^2/2.
TEST(Pairs, BreakAndCollide) {
  PopulationModel model = colliding(constant, 1);
  model.breakage = BreakageOptions{0.5, 0, 2, BreakageOptions::Daughters::uniform};
  const auto m = momentsAt(3, model, startOf(Distribution::monodisperse, 2), pairsOf(300), 60);
  const double e = std::exp(1.5);
  expectMoment(m, 0, 2 * e / (1 + 2 * (e - 1)));
  expectMass(m, 2);
}

// Twelve pieces at a constant rate: M0 = exp(11 t).
TEST(Pairs, EqualFragmentsStayTogether) {
  PopulationModel model;
  model.breakage = BreakageOptions{1, 0, 12, BreakageOptions::Daughters::equal};
  const auto m = momentsAt(0.2, model, startOf(Distribution::monodisperse), pairsOf(200), 200);
  expectMoment(m, 0, std::exp(2.2));
  expectMass(m, 1);
  expectMoment(m, 2, std::exp((1.0 / 12 - 1) * 0.2));
}

// Deposition at a rate that goes with the volume, of an exponential distribution: M0 = 1 / (1 + D t).
TEST(Pairs, AreDeposited) {
  PopulationModel model;
  model.deposition = DepositionOptions{1, 1};
  const auto m = momentsAt(2, model, startOf(Distribution::exponential), pairsOf(300), 40);
  expectMoment(m, 0, 1.0 / 3);
  expectMoment(m, 1, 1.0 / 9);
}

TEST(Pairs, GrowAndAreDiluted) {
  PopulationModel model;
  model.growth.condensation = 1;
  model.dilution = 0.5;
  const auto m = momentsAt(1, model, startOf(Distribution::monodisperse), pairsOf(100), 1);
  for (std::size_t k = 0; k < 4; ++k) {
    const double exact = std::exp(static_cast<double>(k) - 0.5);
    EXPECT_NEAR(m[k][0], exact, 1e-11 * exact);
  }
}

// Additive kernel and condensation at the rate c, in steps h: ln M0 is off by the part (c h)^2 / 24 of itself, as the
// integral of exp(c t) is taken by the midpoint rule.
TEST(Pairs, SplittingIsOfSecondOrder) {
  PopulationModel model = colliding(additive, 0.3);
  model.growth.condensation = 1;
  const double exact = -0.3 * (std::exp(2) - 1);
  for (const double step : {1.0, 2.0}) {
    model.growth.step = step;
    auto options = pairsOf(300);
    options.splitChange = 100;
    const auto m = momentsAt(2, model, startOf(Distribution::monodisperse), options, 150);
    // Of the midpoints' sum over the integral: 1 - (c h)^2 / 24 + ...
    expectMoment(m, 0, std::exp(exact * 0.5 * step / std::sinh(0.5 * step)));
  }
}

// Twice the step, four times the error, with nucleation and in steps that the method chooses.
TEST(Pairs, ChosenStepsAreOfSecondOrder) {
  PopulationModel model = colliding(constant, 0.1);
  model.nucleation.emplace();
  model.nucleation->rate = 10;
  const double end = 2, limit = std::sqrt(2 * 10 / 0.1);
  const double exact = limit * std::tanh(std::atanh(1 / limit) + std::sqrt(0.5) * end);
  std::vector<double> errors;
  for (const double change : {0.3334, 0.6667}) {  // six and three steps
    auto options = pairsOf(300);
    options.splitChange = change;
    const auto m = momentsAt(end, model, startOf(Distribution::monodisperse), options, 1000);
    errors.push_back(summarise(m[0]).mean / exact - 1);
  }
  EXPECT_NEAR(std::log2(errors[1] / errors[0]), 2, 0.5) << errors[0] << " " << errors[1];
}

}  // namespace
}  // namespace lampblack::test
