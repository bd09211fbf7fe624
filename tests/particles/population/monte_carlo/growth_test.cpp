// Treatments of continuous growth: by splitting, deferred, and by jumps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/population/monte_carlo_options.hpp"
#include "same_law.hpp"

namespace lampblack::particles {
namespace {

using Treatment = GrowthOptions::Treatment;
using Distribution = InitialPopulation::Distribution;
using test::outcomes;
using test::Sample;
using test::zLimit;

constexpr InitialPopulation monodisperse{Distribution::monodisperse, 1.0, 1.0, 1};
constexpr InitialPopulation exponential{Distribution::exponential, 1.0, 1.0, 1};

PopulationModel coagulation(CollisionKernelType type) {
  PopulationModel model;
  model.coagulation.emplace();
  model.coagulation->type = type;
  model.coagulation->rate = 1;
  return model;
}

std::vector<Sample> run(PopulationModel model, Treatment treatment, double step, const InitialPopulation& initial,
                        std::size_t particles, int repeats, double end, MonteCarloMethod method,
                        std::uint64_t seed = 1) {
  model.growth.treatment = treatment;
  model.growth.step = step;
  return outcomes(
      [&](std::uint64_t repeat) {
        MonteCarloOptions options;
        options.method = method;
        options.particles = particles;
        options.seed = seed;
        options.repeat = repeat;
        return makeMonteCarlo(model, initial, options);
      },
      repeats, end, {});
}

class DeferredGrowth : public testing::TestWithParam<MonteCarloMethod> {};
INSTANTIATE_TEST_SUITE_P(Methods, DeferredGrowth,
                         testing::Values(MonteCarloMethod::dsmc, MonteCarloMethod::constantVolume,
                                         MonteCarloMethod::constantNumberByNumber, MonteCarloMethod::sammc,
                                         MonteCarloMethod::swa));

// dM0/dt = -M0 M1 with M1 = e^(ct), so that M0 = exp(-(e^(ct) - 1)/c). One step in which volumes grow by a factor of
// 4.5: splitting takes M1 from the middle of the step, e^(c/2), and is off by exp(0.2) in M0.
TEST_P(DeferredGrowth, HasNoErrorOfTheStep) {
  PopulationModel model = coagulation(CollisionKernelType::additive);
  const double c = 1.5, end = 1, integral = std::expm1(c * end) / c;
  model.growth.condensation = c;
  const auto one = run(model, Treatment::deferred, 10, monodisperse, 300, 40, end, GetParam());
  EXPECT_LT(std::abs(one[0].z(std::exp(-integral))), zLimit);
  const auto split = run(model, Treatment::split, 10, monodisperse, 300, 40, end, GetParam());
  EXPECT_LT(std::abs(split[0].z(std::exp(-std::exp(0.5 * c)))), zLimit);
  EXPECT_GT(std::abs(split[0].z(std::exp(-integral))), 5);
  const auto chosen = run(model, Treatment::deferred, 0, monodisperse, 300, 40, end, GetParam());
  EXPECT_LT(std::abs(chosen[0].z(std::exp(-integral))), zLimit);
}

// Everything at once, in three steps, against splitting in fifty.
TEST_P(DeferredGrowth, HasTheLawOfSplittingInItsLimit) {
  PopulationModel model = coagulation(CollisionKernelType::freeMolecular);
  const double nucleus = 4e-27, number = 2e15, diameter = std::cbrt(nucleus);
  model.coagulation->gas.temperature = 1800;
  model.growth.surfaceGrowth = 1.5 * diameter;
  model.nucleation.emplace();
  model.nucleation->rate = number;
  model.nucleation->volume = nucleus;
  model.breakage = BreakageOptions{0.1 / nucleus, 1, 2, BreakageOptions::Daughters::uniform};
  model.deposition = DepositionOptions{0.2 * diameter, -1.0 / 3};
  const InitialPopulation initial{Distribution::lognormal, number, nucleus, 1.3};
  const auto fine = run(model, Treatment::split, 0.02, initial, 100, 60, 1, GetParam(), 1);
  const auto deferred = run(model, Treatment::deferred, 0.35, initial, 100, 60, 1, GetParam(), 2);
  test::expectSameLaw(fine, deferred);
}

// Oxidation until particles vanish.
TEST(Growth, DeferredHasTheLawOfSplittingWhereParticlesVanish) {
  PopulationModel model = coagulation(CollisionKernelType::freeMolecular);
  const double nucleus = 4e-27, number = 2e15, diameter = std::cbrt(nucleus);
  model.coagulation->gas.temperature = 1800;
  model.growth.oxidation = 0.6 * diameter;
  model.growth.smallestVolume = 0.1 * nucleus;
  const InitialPopulation initial{Distribution::lognormal, number, nucleus, 1.3};
  const auto fine = run(model, Treatment::split, 0.01, initial, 200, 60, 0.8, MonteCarloMethod::dsmc, 1);
  const auto deferred = run(model, Treatment::deferred, 0.27, initial, 200, 60, 0.8, MonteCarloMethod::dsmc, 2);
  EXPECT_LT(fine[0].mean, 0.5 * number);
  test::expectSameLaw(fine, deferred);
}

class BurnOut : public testing::TestWithParam<MonteCarloMethod> {
 protected:
  // Equal particles of 20 nm that lose 1e-7 m/s of radius: gone at 0.1 s.
  static constexpr double diameter = 20e-9, number = 1e16, speed = 1e-7;
  static std::unique_ptr<PopulationSolver> solver(double kernel) {
    PopulationModel model = coagulation(CollisionKernelType::constant);
    model.coagulation->rate = kernel;
    model.growth.oxidation = speed;
    const double volume = constants::pi / 6 * diameter * diameter * diameter;
    MonteCarloOptions options;
    options.method = GetParam();
    options.particles = 200;
    return makeMonteCarlo(model, {Distribution::monodisperse, number, volume, 1}, options);
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, BurnOut,
                         testing::Values(MonteCarloMethod::dsmc, MonteCarloMethod::constantVolume,
                                         MonteCarloMethod::constantNumberByMass,
                                         MonteCarloMethod::constantNumberByNumber, MonteCarloMethod::mmc,
                                         MonteCarloMethod::wfmc, MonteCarloMethod::samwfmc, MonteCarloMethod::sammc,
                                         MonteCarloMethod::swa));

// Collisions that never happen: d = d0 - 2 k t for all, then nothing.
TEST_P(BurnOut, FollowsTheShrinkingSphereToItsEnd) {
  const auto population = solver(1e-30);
  const double volume = constants::pi / 6 * diameter * diameter * diameter;
  for (const double part : {0.3, 0.9, 0.999}) {
    population->advance(part * diameter / (2 * speed));
    const auto moments = population->moments();
    EXPECT_NEAR(moments[0] / number, 1, 1e-12) << part;
    EXPECT_NEAR(moments[1] / (number * volume * std::pow(1 - part, 3)), 1, 1e-9) << part;
  }
  population->advance(1.001 * diameter / (2 * speed));
  EXPECT_EQ(population->moments()[0], 0);
  EXPECT_EQ(population->particles(), 0u);
  EXPECT_LT(population->counters().splitSteps, 100u);
}

// Collisions at 10 1/s, which do not depend on the size: dM0/dt = -K M0^2 / 2 until the first particles vanish. What
// has coagulated is larger and burns longer; a particle of the volume of k at the start is gone at k^(1/3) 0.1 s.
TEST_P(BurnOut, WithCollisionsEnds) {
  const auto population = solver(1e-15);
  population->advance(0.099);
  const double exact = number / (1 + 0.5 * 10 * 0.099);
  // 200 particles of equal weights scatter by less than 1/sqrt(200); 5 of these.
  EXPECT_NEAR(population->moments()[0] / exact, 1, 5 / std::sqrt(200.0));
  EXPECT_LT(population->counters().splitSteps, 3000u);
  population->advance(1);
  EXPECT_EQ(population->moments()[0], 0);
  // One in a thousand jumps in a step, at no more than 10 1/s for most of the time.
  EXPECT_LT(population->counters().splitSteps, 20000u);
}

TEST(Growth, ByJumpsHasMeanAndVarianceOfTheYuleProcess) {
  PopulationModel model;
  model.growth.condensation = 1;
  model.growth.monomer = 0.5;
  const double end = 1, e = std::exp(end);
  const int count = 40, repeats = 500;
  // 2 monomers in each of 40 particles, each monomer gaining one at the rate c: Var M1 = e (e - 1) 2 (1/2)^2 / 40.
  const auto samples = run(model, Treatment::jumps, 0, monodisperse, count, repeats, end, MonteCarloMethod::dsmc);
  EXPECT_NEAR(samples[0].mean, 1, 1e-12);
  EXPECT_LT(std::abs(samples[1].z(e)), zLimit);
  const double variance = samples[1].standardError * samples[1].standardError * repeats;
  EXPECT_LT(std::abs(variance / (0.5 * e * (e - 1) / count) - 1), zLimit * std::sqrt(2.0 / repeats));
}

TEST(Growth, ByJumpsTendsToContinuousGrowth) {
  PopulationModel model = coagulation(CollisionKernelType::constant);
  model.growth.surfaceGrowth = 0.2;
  model.growth.monomer = 0.05;
  const auto split = run(model, Treatment::split, 0.05, monodisperse, 100, 60, 2, MonteCarloMethod::dsmc, 1);
  const auto jumps = run(model, Treatment::jumps, 0, monodisperse, 100, 60, 2, MonteCarloMethod::dsmc, 2);
  test::expectSameLaw(split, jumps);
}

TEST(Growth, DeferredNeedsBoundsThatHold) {
  PopulationModel model = coagulation(CollisionKernelType::constant);
  model.growth.treatment = Treatment::deferred;
  model.growth.oxidation = 1;
  MonteCarloOptions options;
  const auto message = [&]() -> std::string {
    try {
      (void)makeMonteCarlo(model, monodisperse, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(message(), testing::HasSubstr("smallest volume"));
  model.growth.smallestVolume = 0.1;
  EXPECT_EQ(message(), "none");
  options.rates = EventRates::exact;
  EXPECT_THAT(message(), testing::HasSubstr("majorant"));
}

}  // namespace
}  // namespace lampblack::particles
