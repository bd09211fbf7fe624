// A stochastic population along a path through a known gas.
#include "particles/stochastic/population_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/ensemble/soot_ensemble.hpp"
#include "particles/soot/surface_chemistry.hpp"
#include "tests/particles/soot_fixtures.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::particles {
namespace {

SootEnsemble sootOf(const EnsembleOptions& options) {
  static const Mechanism mechanism =
      Mechanism::fromFile(test::sourcePath("cases/mechanisms/ethylene_abf2000_101.yaml"));
  return {mechanism, options};
}

// Of a column, by its name without the material.
double valueOf(const PathRecord& record, const std::string& name) {
  const auto columns = sootOf({}).columns();
  const auto found = std::ranges::find(columns, "soot_" + name, &Quantity::name);
  return record.values.at(static_cast<std::size_t>(found - columns.begin()));
}

GasSample sampleAt(double time, const test::FlameGas& gas) {
  return {time, gas.state, gas.concentrations};
}

// OH rises linearly at constant temperature: the diameter falls with the integral of its flux, which the midpoint rule
// takes exactly.
TEST(ParticlePath, OxidationIntegratesTheGasInTime) {
  const test::FlameGas cold(1800, 0, 0, 1e-3, 0.1, 0, 0, {}), rich(1800, 0, 0, 3e-3, 0.1, 0, 0, {});
  EnsembleOptions options;
  options.soot.coagulation = false;
  SootEnsemble soot = sootOf(options);
  const double d0 = 60e-9, mass = 1850 * constants::pi / 6 * d0 * d0 * d0, T = 1e-3;
  soot.ensemble().initialise(test::equalSpheres(1, mass, 0, 1e15));
  const auto result = marchPath(soot, {{sampleAt(0, cold), sampleAt(0.3 * T, cold), sampleAt(T, rich)}, {{}, {}}});
  const double perOH = 12.011e-3 * SurfaceChemistry(options.soot, 1800).rates(cold.concentrations, 0.0).oxidationOH;
  const double dose = cold[SootSpecies::OH] * 0.3 * T + 0.5 * (cold[SootSpecies::OH] + rich[SootSpecies::OH]) * 0.7 * T;
  ASSERT_EQ(result.records.size(), 3U);
  EXPECT_NEAR(valueOf(result.records[2], "mobility_diameter") / (d0 - 2 * perOH * dose / 1850), 1, 1e-10);
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
    SootEnsemble soot = sootOf(options);
    return valueOf(marchPath(soot, path).records.back(), "number_density");
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
  SootEnsemble soot = sootOf(options);
  const SizeBins bins;
  const auto records = marchPath(soot, path, {bins}).records;
  EXPECT_EQ(valueOf(records[0], "number_density"), 0);
  EXPECT_EQ(valueOf(records[0], "geometric_deviation"), 1);
  const auto& end = records.back();
  const Ensemble::Totals totals = soot.ensemble().totals();
  EXPECT_EQ(valueOf(end, "number_density"), totals.number);
  EXPECT_EQ(valueOf(end, "mass"), totals.mass());
  EXPECT_EQ(valueOf(end, "mass_squared"), 1850.0 * 1850.0 * soot.ensemble().moment(2));
  EXPECT_EQ(valueOf(end, "mass_cubed"), 1850.0 * 1850.0 * 1850.0 * soot.ensemble().moment(3));
  EXPECT_EQ(valueOf(end, "coagulation_events"), static_cast<double>(soot.ensemble().counters().coagulations));
  EXPECT_GT(valueOf(end, "coagulation_events"), 0);
  EXPECT_EQ(valueOf(end, "primaries"), 1.0) << "of spheres";
  EXPECT_GT(valueOf(end, "volume_fraction"), valueOf(records[1], "volume_fraction"));
  EXPECT_NEAR(std::accumulate(end.distribution.begin(), end.distribution.end(), 0.0) * 0.05 / totals.number, 1, 1e-9);
  ASSERT_EQ(bins.edges().size(), end.distribution.size() + 1);
  EXPECT_NEAR(bins.edges().front() / 1e-10, std::pow(10.0, 0.8), 1e-9);
  EXPECT_NEAR(bins.edges().back() / 1e-7, std::pow(10.0, 0.8), 1e-9);

  SootEnsemble again = sootOf(options);
  EXPECT_EQ(marchPath(again, path).records.back().values, end.values);
}

// A concentration that doubles divides an interval into five where it makes a difference to soot: H, OH, O2, C2H2, PAH.
TEST(ParticlePath, IsDividedByTheSpeciesThatMatter) {
  EnsembleOptions options;
  options.soot = test::jumpsOnly(false, false);
  for (std::size_t k = 0; k < SootSpecies::fixed + options.soot.pah.size(); ++k) {
    GasSample from = sampleAt(0, test::FlameGas(1700, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, {1e-6, 1e-6, 1e-6}));
    GasSample to = from;
    to.time = 1e-4;
    from.concentrations[SootSpecies::CO] = to.concentrations[SootSpecies::CO] = 1e-3;
    to.concentrations[k] *= 2;
    SootEnsemble soot = sootOf(options);
    soot.ensemble().initialise(test::equalSpheres(8, 1e-21, 0, 1e15));
    (void)marchPath(soot, {{from, to}, {{}}});
    const bool matters = k != SootSpecies::H2 && k != SootSpecies::H2O && k != SootSpecies::CO;
    EXPECT_EQ(soot.ensemble().counters().splitSteps, matters ? 5U : 1U) << k;
  }
}

TEST(ParticlePath, MeaninglessPathsAreRefused) {
  const test::FlameGas gas(1700, 0, 0, 0, 0, 0, 0, {1e-6});
  EnsembleOptions options;
  options.soot = test::naphthalene();
  SootEnsemble soot = sootOf(options);
  EXPECT_THROW((void)marchPath(soot, {}), InputError);
  EXPECT_THROW((void)marchPath(soot, {{sampleAt(0, gas), sampleAt(1, gas)}, {}}), InputError);
  EXPECT_THROW((void)marchPath(soot, {{sampleAt(1, gas), sampleAt(0, gas)}, {{}}}), InputError);
  GasSample wrong = sampleAt(1, gas);
  wrong.concentrations.pop_back();
  EXPECT_THROW((void)marchPath(soot, {{sampleAt(0, gas), wrong}, {{}}}), InputError);
}

TEST(ParticlePath, OnePointIsARowOfThePopulationAsItIs) {
  EnsembleOptions options;
  options.soot = test::naphthalene();
  SootEnsemble soot = sootOf(options);
  const auto result = marchPath(soot, {{sampleAt(0, test::FlameGas(1700, 0, 0, 0, 0, 0, 0, {1e-6}))}, {}});
  ASSERT_EQ(result.records.size(), 1U);
  EXPECT_EQ(valueOf(result.records.front(), "volume_fraction"), 0.0);
}

}  // namespace
}  // namespace lampblack::particles
