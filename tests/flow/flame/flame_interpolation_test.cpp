// Profiles on other grids.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "flow/flame/flame_grid.hpp"
#include "tests/every_module.hpp"
#include "tests/flow/flame/analytic_profile.hpp"

namespace lampblack::test {
namespace {

constexpr double length = 0.02;

AnalyticFlame flame() {
  const auto step = [](double z) { return 0.5 * (1 + std::tanh((z - 0.007) / 1e-3)); };
  return {
      [=](double z) { return 0.4 - 30 * z; },
      [=](double z) { return 100 * std::sin(z * std::numbers::pi / length); },
      [=](double z) { return 300 + 1900 * step(z); },
      {[=](double z) { return 0.2 * (1 - step(z)); }, [=](double z) { return 0.8 - 0.04 * step(z) * (1 - step(z)); },
       [=](double z) { return 0.2 * step(z) + 0.04 * step(z) * (1 - step(z)); }},
      {[=](double z) { return step(z) * step(z); }}};
}

// Points that are dense around the middle and lie nowhere in particular.
std::vector<double> uneven(std::size_t n) {
  auto z = uniformPoints(0, 1, n);
  for (double& x : z) x = length * (x + 0.08 * std::sin(2 * std::numbers::pi * x) * (1 + 0.3 * x));
  z.back() = length;
  return z;
}

TEST(FlameInterpolation, MeetsThePointsExactly) {
  const auto p = flame().on(uneven(31));
  const auto q = onGrid(p, p.z);
  for (std::size_t i = 0; i < p.points(); ++i)
    for (std::size_t c = FlameLayout::spread; c < p.layout.width(); ++c) EXPECT_EQ(q.at(i, c), p.at(i, c));
  EXPECT_EQ(q.global(pressureGradient), -7.0);
  EXPECT_EQ(q.global(load), 1.0);
}

TEST(FlameInterpolation, IsExactForStraightLinesOfPointsAndOfFluxesOnFaces) {
  AnalyticFlame f = flame();
  f.spread = [](double z) { return 3 + 1e3 * z; };
  f.temperature = [](double z) { return 2000 - 4e4 * z; };
  f.species = {[](double z) { return 0.1 + 20 * z; }, [](double z) { return 0.9 - 20 * z; }};
  f.scalars = {[](double z) { return 5 * z; }};
  const auto z = uneven(57);
  const auto got = onGrid(f.on(uneven(14)), z);
  const auto want = f.on(z);
  for (std::size_t i = 0; i < z.size(); ++i)
    for (std::size_t c = 0; c < got.layout.width(); ++c)
      // A few roundings of the largest value of the line.
      EXPECT_NEAR(got.at(i, c), want.at(i, c), 2e-14 * std::max(1.0, std::abs(want.at(0, c)))) << i << " " << c;
  EXPECT_NEAR(got.global(leftMassFlux), want.global(leftMassFlux), 1e-15);
}

TEST(FlameInterpolation, RisesAndFallsWithItsDataAndAddsNoExtremes) {
  AnalyticFlame f = flame();
  // Steeper than the grid: the data are a step over one interval, a spike of one point, and a plateau.
  f.temperature = [](double z) { return z < 0.0071 ? 300.0 : 2200.0; };
  f.species = {[](double z) { return std::abs(z - 0.01) < 5e-4 ? 0.3 : 0.0; },
               [](double z) { return std::abs(z - 0.01) < 5e-4 ? 0.7 : 1.0; }};
  const auto p = f.on(uniformPoints(0, length, 21));
  const auto q = onGrid(p, uniformPoints(0, length, 1733));
  for (std::size_t i = 0; i < q.points(); ++i) {
    if (i > 0) {
      EXPECT_GE(q.temperature(i), q.temperature(i - 1) - 1e-9);
    }
    EXPECT_GE(q.massFractions(i)[0], 0.0);
    EXPECT_LE(q.massFractions(i)[0], 0.3 * (1 + 1e-14));
    EXPECT_NEAR(q.massFractions(i)[0] + q.massFractions(i)[1], 1.0, 4e-16);
  }
}

TEST(FlameInterpolation, MassFractionsKeepTheirSumAndErrorsFallAtLeastQuadratically) {
  const auto z = uneven(1999);
  const auto want = flame().on(z);
  double previous[7] = {};
  for (std::size_t n : {41u, 81u, 161u}) {
    const auto got = onGrid(flame().on(uneven(n)), z);
    double error[7] = {};
    for (std::size_t i = 0; i < z.size(); ++i) {
      double sum = 0;
      for (double y : got.massFractions(i)) {
        sum += y;
        EXPECT_GE(y, 0.0);
      }
      EXPECT_NEAR(sum, 1.0, 1e-15);
      for (std::size_t c = 1; c < 7; ++c) error[c] = std::max(error[c], std::abs(got.at(i, c) - want.at(i, c)));
    }
    for (std::size_t c = 1; c < 7; ++c) {
      // Extremes are cut off by a parabola's height, which is second order: a factor 4. Elsewhere it is third order.
      if (n > 41) {
        EXPECT_LT(error[c], (c == 2 || c == 6 ? previous[c] / 6 : previous[c] / 3.5)) << c << " " << n;
      }
      previous[c] = error[c];
    }
  }
}

TEST(FlameInterpolation, StaysConstantBeyondTheEnds) {
  const auto p = flame().on(uneven(21));
  const auto q = onGrid(p, std::vector<double>{-0.01, 0.0, 0.01, length, 0.03});
  for (std::size_t c = FlameLayout::spread; c < p.layout.width(); ++c) {
    EXPECT_NEAR(q.at(0, c), p.at(0, c), 1e-13 * std::abs(p.at(0, c)));
    EXPECT_NEAR(q.at(4, c), p.at(20, c), 1e-13 * std::abs(p.at(20, c)));
  }
  EXPECT_EQ(q.global(leftMassFlux), p.global(leftMassFlux));
  EXPECT_EQ(q.at(4, FlameLayout::massFlux), p.at(20, FlameLayout::massFlux));
}

TEST(FlameInterpolation, RefusesGridsThatDoNotRise) {
  const auto p = flame().on(uneven(21));
  EXPECT_THROW(static_cast<void>(onGrid(p, std::vector<double>{0.0})), InputError);
  EXPECT_THROW(static_cast<void>(onGrid(p, std::vector<double>{0.0, 0.01, 0.01})), InputError);
}

TEST(FlameWidening, AddsFlatEndsAndMovesTheRest) {
  AnalyticFlame f = flame();
  f.massFlux = [](double) { return 0.4; };
  const auto p = f.on(uneven(21));
  const auto q = widened(p, 0.01, 0.04);
  EXPECT_EQ(q.z.front(), 0.0);
  EXPECT_NEAR(q.z.back(), 0.07, 1e-15);
  const auto found = std::ranges::lower_bound(q.z, 0.01 - 1e-12);
  const auto first = static_cast<std::size_t>(found - q.z.begin());
  ASSERT_GT(first, 1u);
  ASSERT_LT(first + p.points(), q.points());
  for (std::size_t i = 0; i < q.points(); ++i) {
    const std::size_t from = std::clamp(i, first, first + p.points() - 1) - first;
    for (std::size_t c = 0; c < p.layout.width(); ++c)
      EXPECT_NEAR(q.at(i, c), p.at(from, c), 1e-13 * std::abs(p.at(from, c))) << i << " " << c;
    if (i >= first && i < first + p.points()) {
      EXPECT_NEAR(q.z[i], p.z[i - first] + 0.01, 1e-15);
    }
    if (i >= 2) {
      EXPECT_LT((q.z[i] - q.z[i - 1]) / (q.z[i - 1] - q.z[i - 2]), 2.0);
    }
  }
  EXPECT_EQ(q.global(leftMassFlux), 0.4);
  EXPECT_THROW(static_cast<void>(widened(p, -1e-3, 0)), InputError);
}

}  // namespace
}  // namespace lampblack::test
