// The adaptive grid: its criteria on profiles that are formulas.
#include "flow/flame/flame_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "tests/every_module.hpp"
#include "tests/flow/flame/analytic_profile.hpp"

namespace lampblack::test {
namespace {

constexpr double length = 0.02;

// A flame front of 0.3 mm, with a radical in it and a species that is there only in traces.
AnalyticFlame flame() {
  const auto step = [](double z) { return 0.5 * (1 + std::tanh((z - 0.007) / 3e-4)); };
  return {
      [=](double) { return 0.4; },
      [=](double) { return 0.0; },
      [=](double z) { return 300 + 1900 * step(z); },
      {[=](double z) { return 0.2 * (1 - step(z)); }, [=](double z) { return 0.8 - 0.04 * step(z) * (1 - step(z)); },
       [=](double z) { return 0.2 * step(z) + 0.04 * step(z) * (1 - step(z)); },
       [](double z) { return 1e-12 * std::exp(-std::pow((z - 0.015) / 1e-5, 2)); }},
      {}};
}

using Active = std::array<bool, 7>;
constexpr Active all{true, true, true, true, true, true, true};

FlameProfile refined(const AnalyticFlame& f, const GridOptions& options, FlameProfile p,
                     std::vector<std::size_t> keep = {}, int most = 40) {
  for (int pass = 0; pass < most; ++pass) {
    const auto change = refineGrid(p, options, all, keep);
    if (!change.changed()) return p;
    p = f.on(change.z);
  }
  ADD_FAILURE() << "the grid still changes after " << most << " passes";
  return p;
}

// The largest change between neighbours over the range, and of slopes over theirs.
std::pair<double, double> worst(const FlameProfile& p, std::size_t c) {
  double low = 1e300, high = -1e300, lowSlope = 1e300, highSlope = -1e300, step = 0, bend = 0;
  const auto slope = [&](std::size_t i) { return (p.at(i + 1, c) - p.at(i, c)) / (p.z[i + 1] - p.z[i]); };
  for (std::size_t i = 0; i < p.points(); ++i) {
    low = std::min(low, p.at(i, c));
    high = std::max(high, p.at(i, c));
    if (i + 1 == p.points()) break;
    step = std::max(step, std::abs(p.at(i + 1, c) - p.at(i, c)));
    lowSlope = std::min(lowSlope, slope(i));
    highSlope = std::max(highSlope, slope(i));
    if (i > 0) bend = std::max(bend, std::abs(slope(i) - slope(i - 1)));
  }
  return {step / (high - low), bend / (highSlope - lowSlope)};
}

double worstRatio(const std::vector<double>& z) {
  double most = 1;
  for (std::size_t i = 1; i + 1 < z.size(); ++i) {
    const double r = (z[i + 1] - z[i]) / (z[i] - z[i - 1]);
    most = std::max({most, r, 1 / r});
  }
  return most;
}

TEST(FlameGrid, RepeatedRefinementMeetsEveryCriterion) {
  for (const auto& [slope, curve, ratio] : {std::array{0.06, 0.12, 3.0}, {0.02, 0.02, 2.0}, {0.3, 0.05, 2.0}}) {
    GridOptions options;
    options.slope = slope;
    options.curve = curve;
    options.ratio = ratio;
    const auto p = refined(flame(), options, flame().on(uniformPoints(0, length, 12)));
    for (std::size_t c : {2u, 3u, 4u, 5u}) {
      const auto [step, bend] = worst(p, c);
      EXPECT_LE(step, slope) << c;
      EXPECT_LE(bend, curve) << c;
    }
    EXPECT_LE(worstRatio(p.z), ratio * (1 + 1e-6));
    // At least as many points as the steps of the front need, and no needless fineness: halving the spacing stops
    // within a factor two of what the steepest place needs (largest slope 1/(2 * 0.3 mm) of the range).
    EXPECT_GE(static_cast<double>(p.points()), 1 / slope);
    double least = 1;
    for (std::size_t i = 0; i + 1 < p.points(); ++i) least = std::min(least, p.z[i + 1] - p.z[i]);
    EXPECT_GT(least, 0.1 * std::min(slope, curve) * 3e-4);
  }
}

TEST(FlameGrid, InsertsMidpointsOnlyWhereItIsSteep) {
  GridOptions options;
  options.curve = 1;
  const auto start = flame().on(uniformPoints(0, length, 41));
  const auto change = refineGrid(start, options, all, {});
  EXPECT_GT(change.inserted, 0u);
  EXPECT_EQ(change.removed, 0u);
  EXPECT_EQ(change.z.size(), start.points() + change.inserted);
  for (std::size_t i = 0; i < start.points(); ++i)
    EXPECT_TRUE(std::ranges::binary_search(change.z, start.z[i])) << "old points stay";
  for (double z : change.z) {
    if (std::ranges::binary_search(start.z, z)) continue;
    EXPECT_NEAR(z, 0.007, 2e-3) << "ten half-widths around the front, and the ratio's neighbours";
    const auto above = std::ranges::upper_bound(start.z, z);
    EXPECT_DOUBLE_EQ(z, 0.5 * (*above + *(above - 1)));
  }
}

TEST(FlameGrid, InactiveAndNegligibleComponentsAskForNothing) {
  GridOptions options;
  AnalyticFlame f = flame();
  f.temperature = [](double) { return 300.0; };
  f.species[0] = [](double) { return 0.2; };
  f.species[1] = [](double) { return 0.5; };
  f.species[2] = [](double) { return 0.3; };
  f.massFlux = [](double z) { return std::tanh((z - 0.01) / 1e-5); };
  // The trace: 1e-12 of 0.5 does not count, however steep.
  EXPECT_FALSE(refineGrid(f.on(uniformPoints(0, length, 401)), options, all, {}).changed());
  options.negligible = 1e-13;
  EXPECT_TRUE(refineGrid(f.on(uniformPoints(0, length, 401)), options, all, {}).changed());
  Active some = all;
  some[6] = false;
  EXPECT_FALSE(refineGrid(f.on(uniformPoints(0, length, 401)), options, some, {}).changed());
}

TEST(FlameGrid, AStraightLineNeedsNoPointsForItsCurve) {
  GridOptions options;
  options.slope = 1;
  options.curve = 0.02;
  AnalyticFlame f = flame();
  f.temperature = [](double z) { return 300 + 1e5 * z; };
  f.species = {[](double z) { return 20 * z; }, [](double z) { return 1 - 20 * z; }};
  const std::array<bool, 5> active{true, true, true, true, true};
  EXPECT_FALSE(refineGrid(f.on(uniformPoints(0, length, 9)), options, active, {}).changed());
}

TEST(FlameGrid, PruningTakesNeedlessPointsAndKeepsCriteriaEndsAndTheAnchor) {
  GridOptions options;
  options.slope = 0.08;
  options.curve = 0.12;
  options.prune = 0.03;
  const auto start = flame().on(uniformPoints(0, length, 801));
  const std::size_t anchor = 700;
  const auto first = refineGrid(start, options, all, std::array{anchor});
  EXPECT_GT(first.removed, 100u);
  // Never two neighbours in one pass.
  for (std::size_t i = 0; i + 1 < first.z.size(); ++i) EXPECT_LE(first.z[i + 1] - first.z[i], 2.001 * length / 800);

  FlameProfile p = start;
  std::size_t keep = anchor;
  for (int pass = 0; pass < 40; ++pass) {
    const auto change = refineGrid(p, options, all, std::array{keep});
    if (!change.changed()) break;
    p = flame().on(change.z);
    const auto found = std::ranges::lower_bound(p.z, start.z[anchor]);
    ASSERT_TRUE(found != p.z.end() && *found == start.z[anchor]);
    keep = static_cast<std::size_t>(found - p.z.begin());
  }
  EXPECT_FALSE(refineGrid(p, options, all, std::array{keep}).changed()) << "pruning and inserting come to an end";
  EXPECT_LT(p.points(), 200u);
  EXPECT_EQ(p.z.front(), 0.0);
  EXPECT_EQ(p.z.back(), length);
  EXPECT_LE(worstRatio(p.z), options.ratio * (1 + 1e-6));
  for (std::size_t c : {2u, 3u, 4u, 5u}) {
    const auto [step, bend] = worst(p, c);
    EXPECT_LE(step, options.slope);
    EXPECT_LE(bend, options.curve);
  }
}

TEST(FlameGrid, PruningLeavesAGridWhereAProfileIsFlat) {
  GridOptions options;
  options.slope = 0.2;
  options.curve = 0.3;
  options.prune = 0.1;
  AnalyticFlame flat = flame();
  flat.temperature = [](double) { return 300.0; };
  flat.species.assign(4, [](double) { return 0.25; });
  for (FlameProfile p = flat.on(uniformPoints(0, length, 40));; p = flat.on(refineGrid(p, options, all, {}).z)) {
    ASSERT_GE(p.points(), 5u);
    if (!refineGrid(p, options, all, {}).changed()) break;
  }
}

TEST(FlameGrid, SpacingStopsAtTheSmallest) {
  GridOptions options;
  options.smallestSpacing = 4e-5;
  const auto p = refined(flame(), options, flame().on(uniformPoints(0, length, 12)));
  double least = 1;
  for (std::size_t i = 0; i + 1 < p.points(); ++i) least = std::min(least, p.z[i + 1] - p.z[i]);
  EXPECT_GE(least, 4e-5);
  EXPECT_LT(least, 8e-5);
}

TEST(FlameGrid, TooManyPointsAreAnErrorAndSoAreSenselessCriteria) {
  GridOptions options;
  options.maximumPoints = 30;
  EXPECT_THROW(static_cast<void>(refined(flame(), options, flame().on(uniformPoints(0, length, 12)))), NumericsError);
  const auto start = flame().on(uniformPoints(0, length, 12));
  for (const auto& wrong : {GridOptions{.ratio = 1.9}, GridOptions{.slope = 0}, GridOptions{.curve = 1.1},
                            GridOptions{.prune = 0.07}, GridOptions{.slope = std::numeric_limits<double>::quiet_NaN()}})
    EXPECT_THROW(static_cast<void>(refineGrid(start, wrong, all, {})), InputError);
}

}  // namespace
}  // namespace lampblack::test
