// Nucleation, growth, deposition and dilution without interaction.
#include "particles/population/exact_solutions/initial_distribution.hpp"
#include "particles/population/model/sphere.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/population/exact_solutions/exact_support.hpp"

namespace lampblack::test {
namespace {

TEST(ExactTransported, NucleationAlone) {
  // Wang (2025), case 1.
  PopulationModel model;
  model.nucleation = precursorNuclei(5e-6, 1e5, 1);
  const auto solution = exactSolution(model, equalStart(3000, 1));
  for (const double time : {0.0, 1e3, 2e5, 1e9}) {
    const double expected = 3000 - 1e5 * std::expm1(-5e-6 * time);
    for (const auto& m : solution->moments(time)) EXPECT_NEAR(*m / expected, 1, 1e-12) << time;
    EXPECT_NEAR(solution->numberInBins(time, std::vector<double>{0.5, 1, 1.5}).at(1) / expected, 1, 1e-12);
  }
  model.nucleation = {.source = NucleationOptions::Source::table, .times = {1, 2, 4}, .rates = {1, 3, 5}, .volume = 2};
  EXPECT_NEAR(*exactSolution(model, {})->moments(3)[0], 2 + 3.5, 1e-13);
  EXPECT_NEAR(*exactSolution(model, {})->moments(9)[2], 4 * 10, 1e-12);
}

TEST(ExactTransported, LossesOfEveryKind) {
  PopulationModel model;
  model.dilution = 0.3;
  model.deposition = DepositionOptions{.rate = 0.2, .exponent = 0};
  const auto m = exactSolution(model, exponentialStart(2, 3))->moments(2);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(*m[k], 2 * std::pow(3.0, k) * std::tgamma(k + 1) * std::exp(-1.0), 1e-12 * *m[k]);
  }
  // A rate 0.2 v leaves exp(-v/3 - 0.4 v): again exponential.
  model.deposition->exponent = 1;
  const auto sized = exactSolution(model, exponentialStart(2, 3));
  const double mean = 1 / (1 / 3.0 + 0.4), left = 2 * std::exp(-0.6) * mean / 3;
  EXPECT_NEAR(*sized->moments(2)[0] / left, 1, 1e-13);
  EXPECT_NEAR(*sized->moments(2)[3] / (left * 6 * mean * mean * mean), 1, 1e-13);
  EXPECT_NEAR(sized->numberInBins(2, std::vector<double>{1, 2}).at(0),
              left * (std::exp(-1 / mean) - std::exp(-2 / mean)), 1e-14);
}

TEST(ExactTransported, LinearCondensation) {
  PopulationModel model;
  model.growth.condensation = 1;
  for (const auto& initial :
       {equalStart(1e6, 2), exponentialStart(1e6, 2), start(InitialPopulation::Distribution::lognormal, 1e6, 2, 1.5)}) {
    const auto solution = exactSolution(model, initial);
    const auto m = solution->moments(3);
    for (std::size_t k = 0; k < 4; ++k) {
      const double order = static_cast<double>(k);
      EXPECT_NEAR(*m[k] / (initialMoment(initial, order) * std::exp(3 * order)), 1, 1e-13);
    }
    EXPECT_NEAR(sum(solution->numberInBins(3, geometricEdges(1e-9, 1e12, 2))) / 1e6, 1, 1e-13);
  }
}

TEST(ExactTransported, SurfaceGrowthIsABinomialInTheDiameter) {
  PopulationModel model;
  model.growth.surfaceGrowth = 0.05;
  const double time = 2, shift = 2 * 0.05 * time, c = 6 / M_PI;
  for (const auto& initial :
       {exponentialStart(1, 0.3), start(InitialPopulation::Distribution::lognormal, 1, 0.3, 1.4)}) {
    const auto m = exactSolution(model, initial)->moments(time);
    for (const int k : {1, 2, 3}) {
      double expected = 0, binomial = 1;
      for (int j = 0; j <= 3 * k; ++j) {  // of (d + shift)^(3k), j powers of d
        expected += binomial * std::pow(c, j / 3.0) * initialMoment(initial, j / 3.0) * std::pow(shift, 3 * k - j);
        binomial *= (3.0 * k - j) / (j + 1);
      }
      EXPECT_NEAR(*m[static_cast<std::size_t>(k)] / (expected * std::pow(c, -k)), 1, 1e-12) << k;
    }
  }
}

TEST(ExactTransported, OxidationRemovesTheSmallestFirst) {
  PopulationModel model;
  model.growth.oxidation = 0.05;
  model.growth.smallestVolume = 0.01;
  const auto solution = exactSolution(model, exponentialStart());
  const Sphere sphere(1);
  const double time = 3, d = std::cbrt(6 / M_PI * 0.01) + 2 * 0.05 * time, v = M_PI / 6 * d * d * d;
  const auto m = solution->moments(time);
  EXPECT_NEAR(*m[0], std::exp(-v), 1e-13);
  const double m1 =
      simpson([&](double x) { return std::exp(-x) * sphere.grown({x}, 0, -0.05, time).volume; }, v, 45, 20000);
  EXPECT_NEAR(*m[1] / m1, 1, 1e-9);
  EXPECT_NEAR(sum(solution->numberInBins(time, geometricEdges(1e-9, 100, 1.3))) / *m[0], 1, 1e-13);
  EXPECT_EQ(solution->numberInBins(time, std::vector<double>{0.001, 0.0099}).at(0), 0.0);
}

TEST(ExactTransported, NucleiGrowAfterTheyAppear) {
  const Sphere sphere(1);
  struct Case {
    double condensation, surfaceGrowth, oxidation;
  };
  for (const auto& c : {Case{0.5, 0, 0}, Case{0, 0.1, 0}, Case{0.5, 0.1, 0}, Case{-0.5, 0.1, 0}, Case{0, 0, 0.1},
                        Case{-0.3, 0, 0.1}, Case{1.0, 0, 0.1}}) {
    PopulationModel model;
    model.nucleation = steadyNuclei(7, 1);
    model.dilution = 0.2;
    model.growth.condensation = c.condensation;
    model.growth.surfaceGrowth = c.surfaceGrowth;
    model.growth.oxidation = c.oxidation;
    const auto solution = exactSolution(model, {});
    const double time = 8;
    const int steps = 200000;  // midpoint rule over the age
    std::array<double, 4> expected{};
    const std::vector<double> edges{0, 0.1, 0.3, 0.9, 1, 1.1, 2, 5, 20, 1e9};
    std::vector<double> bins(edges.size() - 1, 0.0);
    for (int i = 0; i < steps; ++i) {
      const double age = (i + 0.5) * time / steps;
      const double v = sphere.grown({1}, c.condensation, c.surfaceGrowth - c.oxidation, age).volume;
      if (!(v > 0)) continue;
      const double number = 7 * std::exp(-0.2 * age) * time / steps;
      for (std::size_t k = 0; k < 4; ++k) expected[k] += number * std::pow(v, k);
      for (std::size_t k = 0; k < bins.size(); ++k) {
        if (v >= edges[k] && v < edges[k + 1]) bins[k] += number;
      }
    }
    const auto m = solution->moments(time);
    const auto numbers = solution->numberInBins(time, edges);
    // One step of the rule at an edge: 7 * 8 / 2e5 = 3e-4.
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(*m[k] / expected[k], 1, 1e-4) << solution->name() << k;
    for (std::size_t k = 0; k < bins.size(); ++k) EXPECT_NEAR(numbers[k], bins[k], 3e-4) << solution->name() << k;
  }
}

TEST(ExactTransported, LogNormalMomentsAndNumbers) {
  const auto initial = start(InitialPopulation::Distribution::lognormal, 2, 3, 1.3);
  EXPECT_NEAR(initialNumber(initial, 0, 3), 1, 1e-14);
  const double far = initialNumber(initial, 3000, HUGE_VAL);
  EXPECT_NEAR(far / std::erfc(std::log(1000) / (std::sqrt(2.0) * 3 * std::log(1.3))), 1, 1e-12);
  for (const double order : {0.5, 2.0, 3.0}) {
    EXPECT_NEAR(initialIntegral(initial, 0, HUGE_VAL, [&](double v) { return std::pow(v, order); }) /
                    initialMoment(initial, order),
                1, 1e-13);
  }
}

}  // namespace
}  // namespace lampblack::test
