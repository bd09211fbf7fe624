// Stochastic soot along a path through a known gas.
#include "particles/ensemble/ensemble_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/soot/surface_chemistry.hpp"
#include "tests/particles/soot_fixtures.hpp"

namespace lampblack::particles {
namespace {

GasSample sampleAt(double time, const test::FlameGas& gas) {
  return {time, gas.state, gas.concentrations};
}

// OH rises linearly at constant temperature: the diameter falls with the integral of its flux, which the midpoint rule
// takes exactly.
TEST(ParticlePath, OxidationIntegratesTheGasInTime) {
  const test::FlameGas cold(1800, 0, 0, 1e-3, 0.1, 0, 0, {}), rich(1800, 0, 0, 3e-3, 0.1, 0, 0, {});
  EnsembleOptions options;
  options.soot.coagulation = false;
  const auto soot = makeEnsemble(options);
  const double d0 = 60e-9, mass = 1850 * constants::pi / 6 * d0 * d0 * d0, T = 1e-3;
  soot->initialise(test::equalSpheres(1, mass, 0, 1e15));
  const auto result = marchPath(*soot, {{sampleAt(0, cold), sampleAt(0.3 * T, cold), sampleAt(T, rich)}, {{}, {}}});
  const double perOH = 12.011e-3 * SurfaceChemistry(options.soot, 1800).rates(cold.concentrations, 0.0).oxidationOH;
  const double dose = cold[SootSpecies::OH] * 0.3 * T + 0.5 * (cold[SootSpecies::OH] + rich[SootSpecies::OH]) * 0.7 * T;
  ASSERT_EQ(result.records.size(), 3U);
  EXPECT_NEAR(result.records[2].totals.meanDiameter() / (d0 - 2 * perOH * dose / 1850), 1, 1e-10);
}

// Particles form at the start, where the gas does not yet spread, and are thinned by what follows. One interval over
// which the divergence rises linearly is as good as many.
TEST(ParticlePath, DivergenceGrowsWithTheTimeOfItsInterval) {
  const auto gasAt = [](double w) { return test::FlameGas(1700, 0, 0, 0, 0, 0, 0, {2e-5 * (1 - w)}); };
  EnsembleOptions options;
  options.soot = test::naphthalene();
  options.soot.coagulation = false;
  const auto numberAfter = [&](int intervals) {
    const double T = 1e-3;
    ParticlePath path;
    for (int k = 0; k <= intervals; ++k) {
      const double w = static_cast<double>(k) / intervals;
      path.points.push_back(sampleAt(w * T, gasAt(w)));
      if (k > 0) path.divergence.push_back({4 / T * (w - 1.0 / intervals), 4 / T * w});
    }
    return marchPath(*makeEnsemble(options), path).records.back().totals.number;
  };
  // Both are the same but for what a part of the one long interval holds constant, and one nucleus in 2000. The mean
  // divergence all along gives a fifth less, the ends exchanged half.
  EXPECT_NEAR(numberAfter(1) / numberAfter(32), 1, 0.02);
}

TEST(ParticlePath, RecordsHoldDensitiesAndDistributions) {
  const test::FlameGas gas(1700, 1e-3, 0.03, 1e-4, 0.08, 1e-4, 0.03, {2e-5, 3e-6, 2e-6});
  EnsembleOptions options;
  options.particles = 500;
  options.soot = test::threePah();
  ParticlePath path;
  for (int k = 0; k < 4; ++k) path.points.push_back(sampleAt(1e-4 * k, gas));
  path.divergence.assign(3, {10, 10});
  const auto soot = makeEnsemble(options);
  const SizeBins bins;
  const auto records = marchPath(*soot, path, {bins}).records;
  EXPECT_EQ(records[0].totals.number, 0);
  EXPECT_EQ(records[0].geometricDeviation, 1);
  const auto& end = records.back();
  EXPECT_EQ(end.totals.number, soot->totals().number);
  EXPECT_GT(end.volumeFraction, records[1].volumeFraction);
  EXPECT_NEAR(std::accumulate(end.distribution.begin(), end.distribution.end(), 0.0) * 0.05 / end.totals.number, 1,
              1e-9);
  ASSERT_EQ(bins.edges().size(), end.distribution.size() + 1);
  EXPECT_NEAR(bins.edges().front() / 1e-10, std::pow(10.0, 0.8), 1e-9);
  EXPECT_NEAR(bins.edges().back() / 1e-7, std::pow(10.0, 0.8), 1e-9);

  EXPECT_EQ(marchPath(*makeEnsemble(options), path).records.back().volumeFraction, end.volumeFraction);
}

TEST(ParticlePath, MeaninglessPathsAreRefused) {
  const test::FlameGas gas(1700, 0, 0, 0, 0, 0, 0, {1e-6});
  EnsembleOptions options;
  options.soot = test::naphthalene();
  const auto soot = makeEnsemble(options);
  EXPECT_THROW((void)marchPath(*soot, {}), InputError);
  EXPECT_THROW((void)marchPath(*soot, {{sampleAt(0, gas), sampleAt(1, gas)}, {}}), InputError);
  EXPECT_THROW((void)marchPath(*soot, {{sampleAt(1, gas), sampleAt(0, gas)}, {{}}}), InputError);
  GasSample wrong = sampleAt(1, gas);
  wrong.concentrations.pop_back();
  EXPECT_THROW((void)marchPath(*soot, {{sampleAt(0, gas), wrong}, {{}}}), InputError);
}

TEST(ParticlePath, OnePointIsARowOfThePopulationAsItIs) {
  EnsembleOptions options;
  options.soot = test::naphthalene();
  const auto result =
      marchPath(*makeEnsemble(options), {{sampleAt(0, test::FlameGas(1700, 0, 0, 0, 0, 0, 0, {1e-6}))}, {}});
  ASSERT_EQ(result.records.size(), 1U);
  EXPECT_EQ(result.records.front().volumeFraction, 0.0);
}

}  // namespace
}  // namespace lampblack::particles
