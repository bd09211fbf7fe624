#include "particles/population/monte_carlo/initial_sample.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/population/exact_solutions/initial_distribution.hpp"

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

// Sizes as soot, aerosols and their inputs have them: wide, with two modes of most different numbers, tabulated.
std::vector<InitialPopulation> wideStarts() {
  const InitialPopulation aitken{Distribution::lognormal, 3.2e9, 4.2e-24, 1.45};
  const InitialPopulation accumulation{Distribution::lognormal, 2.9e9, 8.2e-22, 1.65};
  const InitialPopulation dust{Distribution::lognormal, 1e3, 5e-16, 2.2};
  const InitialPopulation small{Distribution::monodisperse, 1e12, 1e-24, 1},
      large{Distribution::monodisperse, 3e4, 1e-18, 1};
  const InitialPopulation table =
      tabulated({{1e-25, 1e-24, 2e9}, {1e-24, 3e-24, 0}, {3e-24, 1e-22, 5e8}, {1e-21, 1e-19, 2e3}});
  return {InitialPopulation{Distribution::lognormal, 1e11, 6.5e-23, 1.74},
          InitialPopulation{Distribution::lognormal, 1e11, 6.5e-23, 3},
          InitialPopulation{Distribution::exponential, 1e11, 6.5e-23, 1},
          sumOf({aitken, accumulation}),
          sumOf({aitken, dust, InitialPopulation{Distribution::exponential, 1e9, 1e-23, 1}}),
          sumOf({small, large}),
          table,
          sumOf({table, aitken})};
}

double weighted(const std::vector<InitialParticle>& particles, const std::function<double(double)>& f) {
  double sum = 0;
  for (const auto& [volume, weight] : particles) sum += weight * f(volume);
  return sum;
}

TEST(InitialSample, WeightsHoldTheMomentsOfAnyDistribution) {
  for (const InitialPopulation& initial : wideStarts()) {
    for (int repeat = 0; repeat < 5; ++repeat) {
      RandomStream random(5, repeat, 3);
      const auto particles = initialParticles(initial, 1000, InitialWeights::moments, random);
      ASSERT_EQ(particles.size(), 1000U);
      for (const int k : {0, 1, 2, 3}) {
        const double sum = weighted(particles, [&](double v) { return std::pow(v, k); });
        EXPECT_NEAR(sum / initialMoment(initial, k), 1, k < 2 ? 1e-11 : 1e-3) << initial.number << " M" << k;
        for (const auto& [v, weight] : particles)
          ASSERT_LE(weight * std::pow(v, k), 4.2e-3 * initialMoment(initial, k)) << v << " M" << k;
      }
    }
  }
}

TEST(InitialSample, WeightsAreUnbiased) {
  const auto starts = wideStarts();
  for (std::size_t which = 0; which < starts.size(); ++which) {
    const InitialPopulation& initial = starts[which];
    const double edge = 1.5 * initial.volume;
    std::vector<std::pair<std::function<double(double)>, double>> cases{
        {[&](double v) { return v < edge ? 1.0 : 0.0; }, initialNumber(initial, 0, edge)},
        {[](double v) { return std::cbrt(v); }, initialMoment(initial, 1.0 / 3)},
        {[](double v) { return v * v; }, initialMoment(initial, 2)},
        {[](double v) { return v * v * v; }, initialMoment(initial, 3)}};
    for (std::size_t c = 0; c < cases.size(); ++c) {
      double sum = 0, squares = 0;
      for (int repeat = 0; repeat < 60; ++repeat) {
        RandomStream random(17, repeat, static_cast<std::uint32_t>(which));
        const auto particles = initialParticles(initial, 500, InitialWeights::moments, random);
        const double away = weighted(particles, cases[c].first) / cases[c].second - 1;
        sum += away, squares += away * away;
      }
      // Where nothing is left to chance, to round-off.
      EXPECT_LT(std::abs(sum), 3.5 * std::sqrt(squares) + 1e-11) << which << " " << c;
      EXPECT_LT(std::sqrt(squares / 60), 0.01) << which << " " << c;
    }
  }
}

TEST(InitialSample, EachModeHasItsParticles) {
  RandomStream random(1, 2, 3);
  const InitialPopulation small{Distribution::monodisperse, 3e6, 1e-3, 1}, large{Distribution::monodisperse, 2e3, 7, 1};
  for (const InitialWeights weights : {InitialWeights::moments, InitialWeights::equal}) {
    std::map<double, std::pair<int, double>> found;
    for (const auto& [v, weight] : initialParticles(sumOf({small, large}), 3002, weights, random))
      ++found[v].first, found[v].second += weight;
    ASSERT_EQ(found.size(), 2U);
    EXPECT_NEAR(found[1e-3].second / 3e6, 1, 1e-12);
    EXPECT_NEAR(found[7].second / 2e3, 1, 1e-12);
    EXPECT_EQ(found[7].first > 100, weights == InitialWeights::moments) << "for they hold most of M1 to M3";
  }
  // One mode alone, and with others that have nobody, is what it always was, to the last bit.
  RandomStream one(1, 2, 3), other(1, 2, 3);
  const InitialPopulation lognormal{Distribution::lognormal, 1e12, 2e-24, 1.3};
  EXPECT_EQ(initialVolumes(sumOf({InitialPopulation{}, lognormal}), 100, one), initialVolumes(lognormal, 100, other));
}

TEST(InitialSample, EqualWeightsOfTablesAndModesAreUnbiased) {
  const InitialPopulation table = tabulated({{1, 2, 3}, {2, 8, 1}, {10, 12, 0.5}});
  const InitialPopulation modes = sumOf({table, InitialPopulation{Distribution::lognormal, 5, 0.3, 1.2}});
  for (const InitialPopulation& initial : {table, modes}) {
    double sum = 0, squares = 0;
    for (int repeat = 0; repeat < 100; ++repeat) {
      RandomStream random(19, repeat, 0);
      const auto volumes = initialVolumes(initial, 300, random);
      EXPECT_TRUE(std::is_sorted(volumes.begin(), volumes.end()));
      EXPECT_NEAR(moment(volumes, 1) * initial.number / initialMoment(initial, 1), 1, 1e-12);
      const double away = moment(volumes, 2) * initial.number / initialMoment(initial, 2) - 1;
      sum += away, squares += away * away;
    }
    EXPECT_LT(std::abs(sum), 3.5 * std::sqrt(squares));
    EXPECT_LT(std::sqrt(squares / 100), 0.01);
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
