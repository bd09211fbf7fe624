#include "particles/population/monte_carlo/initial_sample.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "core/modules.hpp"

namespace lampblack::particles {
namespace {

using Distribution = InitialPopulation::Distribution;

double moment(const std::vector<double>& volumes, int k) {
  double sum = 0;
  for (const double v : volumes) sum += std::pow(v, k);
  return sum / static_cast<double>(volumes.size());
}

TEST(InitialSample, TheNormalQuantileInvertsTheNormalDistribution) {
  for (const double p : {1e-300, 1e-20, 1e-6, 0.02, 0.074, 0.076, 0.3, 0.5, 0.7, 0.924, 0.926, 0.999}) {
    // erfc amplifies a relative error of x by x^2: up to 1400 times.
    EXPECT_NEAR(0.5 * std::erfc(-normalQuantile(p) / std::sqrt(2.0)) / p, 1, 1e-12) << p;
  }
}

TEST(InitialSample, MeanVolumesAreExact) {
  RandomStream random(1, 2, 3);
  const InitialPopulation lognormal{Distribution::lognormal, 1e12, 2e-24, 1.3};
  const double sigma = 3 * std::log(1.3);
  EXPECT_NEAR(moment(initialVolumes(lognormal, 1000, random), 1) / (2e-24 * std::exp(sigma * sigma / 2)), 1, 1e-13);
  const InitialPopulation exponential{Distribution::exponential, 1e12, 3.0, 1};
  EXPECT_NEAR(moment(initialVolumes(exponential, 1000, random), 1), 3, 1e-12);
  const InitialPopulation monodisperse{Distribution::monodisperse, 1e12, 3.0, 1};
  EXPECT_EQ(moment(initialVolumes(monodisperse, 1000, random), 1), 3);
}

TEST(InitialSample, HigherMomentsAreUnbiased) {
  const InitialPopulation exponential{Distribution::exponential, 1.0, 1.0, 1};
  const InitialPopulation lognormal{Distribution::lognormal, 1.0, 1.0, 1.2};
  const double s2 = std::pow(3 * std::log(1.2), 2);
  for (const int k : {2, 3}) {
    double sumE = 0, squaresE = 0, sumL = 0, squaresL = 0;
    constexpr int repeats = 100;
    for (int repeat = 0; repeat < repeats; ++repeat) {
      RandomStream random(11, repeat, 3);
      const double e = moment(initialVolumes(exponential, 1000, random), k) / std::tgamma(k + 1.0) - 1;
      const double l = moment(initialVolumes(lognormal, 1000, random), k) / std::exp(0.5 * k * k * s2) - 1;
      sumE += e, squaresE += e * e, sumL += l, squaresL += l * l;
    }
    // z-scores, the standard error estimated from the repeats.
    EXPECT_LT(std::abs(sumE) / std::sqrt(squaresE), 3.5) << k;
    EXPECT_LT(std::abs(sumL) / std::sqrt(squaresL), 3.5) << k;
    // Independent draws would have a relative deviation of sqrt(5/1000) = 7 % in the second moment.
    if (k == 2) {
      EXPECT_LT(std::sqrt(squaresE / repeats), 0.02);
    }
  }
}

TEST(InitialSample, AnEmptyStartNeedsAnExpectedNumber) {
  RandomStream random(1, 2, 3);
  MonteCarloOptions options;
  options.particles = 100;
  EXPECT_TRUE(initialVolumes(InitialPopulation{}, 100, random).empty());
  EXPECT_THROW((void)initialWeight(InitialPopulation{}, options), InputError);
  options.expectedNumber = 5e3;
  EXPECT_DOUBLE_EQ(initialWeight(InitialPopulation{}, options), 50);
  EXPECT_DOUBLE_EQ(initialWeight({Distribution::monodisperse, 1e4, 1.0, 1}, options), 100);
}

}  // namespace
}  // namespace lampblack::particles
