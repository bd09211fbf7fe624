#include "particles/trajectory_ensemble.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/errors.hpp"
#include "particles/surface_chemistry.hpp"
#include "soot_fixtures.hpp"

namespace lampblack {
namespace {

TrajectorySample sampleAt(double time, const test::FlameGas& gas) {
  return {{time, gas.state, gas.pah}, {0, 0, 0.5 * time}, 0};
}

TEST(Trajectory, GrowthIntegratesTheGasInTime) {
  // OH rises linearly at constant temperature: the diameter falls with the integral of its flux, which the midpoint
  // rule takes exactly.
  const test::FlameGas cold(1800, 0, 0, 1e-3, 0.1, 0, 0, {}), rich(1800, 0, 0, 3e-3, 0.1, 0, 0, {});
  EnsembleOptions options;
  options.soot.coagulation = false;
  Ensemble e(options);
  const double d0 = 60e-9, mass = 1850 * constants::pi / 6 * d0 * d0 * d0, T = 1e-3;
  e.initialise(std::vector<double>{mass}, 0, 1e15);
  const auto history = marchTrajectory(e, {sampleAt(0, cold), sampleAt(0.3 * T, cold), sampleAt(T, rich)});
  const double perOH = 12.011e-3 * SurfaceChemistry(options.soot, 1800).rates(cold.state, 0.0).oxidationOH;
  const double dose = cold.state.OH * 0.3 * T + 0.5 * (cold.state.OH + rich.state.OH) * 0.7 * T;
  ASSERT_EQ(history.size(), 3u);
  EXPECT_NEAR(history[2].meanDiameter / (d0 - 2 * perOH * dose / 1850), 1, 1e-10);
  EXPECT_EQ(history[2].position[2], 0.5 * T);
  EXPECT_EQ(history[1].time, 0.3 * T);
}

TEST(Trajectory, DivergenceOfTheGasGrowsWithItsTime) {
  // Particles form at the start, where the gas does not yet spread, and are thinned by what follows. One interval over
  // which the divergence rises linearly is as good as many.
  const auto gasAt = [](double w) { return test::FlameGas(1700, 0, 0, 0, 0, 0, 0, {2e-5 * (1 - w)}); };
  EnsembleOptions options;
  options.soot = test::naphthalene();
  options.soot.coagulation = false;
  const auto numberAfter = [&](int intervals) {
    const double T = 1e-3;
    std::vector<TrajectorySample> samples;
    for (int k = 0; k <= intervals; ++k) {
      const double w = static_cast<double>(k) / intervals;
      samples.push_back(sampleAt(w * T, gasAt(w)));
      samples.back().divergence = w * 4 / T;
    }
    Ensemble e(options);
    return marchTrajectory(e, samples).back().numberDensity;
  };
  const double one = numberAfter(1), many = numberAfter(32);
  // Each is a sum over at most 4096 particles, at least half as many after a thinning: 1/sqrt(2048) = 2.2 % of chance;
  // three of the difference of two. The weights the other way round give twice the number.
  EXPECT_NEAR(one / many, 1, 3 * std::sqrt(2.0 / 2048));
}

TEST(Trajectory, HistoryHoldsDensitiesAndDistributions) {
  const test::FlameGas gas(1700, 1e-3, 0.03, 1e-4, 0.08, 1e-4, 0.03, {2e-5, 3e-6, 2e-6});
  EnsembleOptions options;
  options.capacity = 500;
  options.soot = test::threePah();
  std::vector<TrajectorySample> samples;
  for (int k = 0; k < 4; ++k) samples.push_back(sampleAt(1e-4 * k, gas));
  Ensemble e(options);
  const auto history = marchTrajectory(e, samples);
  EXPECT_EQ(history[0].numberDensity, 0);
  EXPECT_EQ(history[0].geometricStandardDeviation, 1);
  const auto& end = history.back();
  EXPECT_EQ(end.numberDensity, e.numberDensity());
  EXPECT_GT(end.volumeFraction, history[1].volumeFraction);
  EXPECT_NEAR(std::accumulate(end.distribution.begin(), end.distribution.end(), 0.0) * 0.05 / end.numberDensity, 1,
              1e-9);

  Ensemble again(options);
  EXPECT_EQ(marchTrajectory(again, samples).back().volumeFraction, end.volumeFraction);
}

TEST(Trajectory, MeaninglessSamplesAreRefused) {
  const test::FlameGas gas(1700, 0, 0, 0, 0, 0, 0, {1e-6});
  EnsembleOptions options;
  options.soot = test::naphthalene();
  Ensemble e(options);
  EXPECT_THROW((void)marchTrajectory(e, {}), InputError);
  EXPECT_THROW((void)marchTrajectory(e, {sampleAt(1, gas), sampleAt(0, gas)}), InputError);
  TrajectorySample wrong = sampleAt(1, gas);
  wrong.pah.clear();
  EXPECT_THROW((void)marchTrajectory(e, {sampleAt(0, gas), wrong}), InputError);
}

TEST(Trajectory, OneSampleIsARowOfTheEnsembleAsItIs) {
  EnsembleOptions options;
  options.soot = test::naphthalene();
  Ensemble e(options);
  const auto history = marchTrajectory(e, {sampleAt(0, test::FlameGas(1700, 0, 0, 0, 0, 0, 0, {1e-6}))});
  ASSERT_EQ(history.size(), 1u);
  EXPECT_EQ(history.front().volumeFraction, 0.0);
}

}  // namespace
}  // namespace lampblack
