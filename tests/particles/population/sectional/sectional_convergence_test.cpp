// Order of convergence in the number of sections, against exact solutions. The end of the grid stays, the number of
// sections doubles. Errors and orders are printed for the documentation.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "core/modules.hpp"
#include "particles/population/exact_solutions/exact_solution.hpp"
#include "particles/population/sectional/sectional_solver.hpp"
#include "tests/particles/population/sectional/sectional_fixtures.hpp"

namespace lampblack::particles {
namespace {

using Distribution = InitialPopulation::Distribution;

struct Case {
  std::string name;
  PopulationModel model;
  InitialPopulation initial;
  double smallest, largest, end;
  SectionGrowthScheme scheme = SectionGrowthScheme::limited;
  double order = 2;  // of M_2, M_3 and of the distribution
  double orderTolerance = 0.25;
  bool closedVolume = true;  // the equation of the volume needs M_1 alone
  bool closedNumber = true;  // the equation of the number needs M_0 and M_1 alone
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

struct Errors {
  double number, volume, second, third, distribution;
};

// Relative errors of the moments and of the number in bins, summed over them.
Errors errorsOf(const Case& c, const ExactSolution& exact, std::size_t sections) {
  auto options = test::gridOf(sections, c.smallest, c.largest);
  options.growth = c.scheme;
  SectionalSolver solver(c.model, c.initial, options);
  solver.advance(c.end);
  const auto moments = solver.moments();
  const auto expected = exact.moments(c.end);
  // Bins of a factor 2 around the mean; where sections are wider than bins the sum sees their steps.
  const double mean = moments[1] / moments[0];
  std::vector<double> edges;
  for (int k = -6; k <= 5; ++k) edges.push_back(mean * std::pow(2.0, k));
  const auto bins = solver.numberInBins(edges), exactBins = exact.numberInBins(c.end, edges);
  double difference = 0;
  for (std::size_t b = 0; b < exactBins.size(); ++b) difference += std::abs(bins[b] - exactBins[b]);
  return {moments[0] / *expected[0] - 1, (moments[1] + solver.left().overVolume) / *expected[1] - 1,
          moments[2] / *expected[2] - 1, moments[3] / *expected[3] - 1, difference / moments[0]};
}

class SectionalConvergence : public testing::TestWithParam<Case> {};

TEST_P(SectionalConvergence, HasItsOrder) {
  const Case& c = GetParam();
  const auto exact = exactSolution(c.model, c.initial);
  ASSERT_NE(exact, nullptr);
  std::printf("%s\n%8s %8s %9s %9s %9s %6s %9s %6s %9s %6s\n", c.name.c_str(), "sections", "spacing", "M0", "M1", "M2",
              "order", "M3", "order", "bins", "order");
  Errors before{}, twiceBefore{};
  for (const std::size_t sections : {25U, 50U, 100U, 200U}) {
    const Errors e = errorsOf(c, *exact, sections);
    // The spacing's logarithm is not quite halved.
    const auto intervals = [](std::size_t pivots) { return static_cast<double>(pivots - 1); };
    const double refined = std::log2(intervals(sections) / intervals(sections / 2));
    const double second = std::log2(before.second / e.second) / refined;
    const double third = std::log2(before.third / e.third) / refined;
    const double bins = std::log2(before.distribution / e.distribution) / refined;
    std::printf("%8zu %8.4f %9.1e %9.1e %9.2e %6.2f %9.2e %6.2f %9.2e %6.2f\n", sections,
                std::pow(c.largest / c.smallest, 1 / static_cast<double>(sections - 1)), e.number, e.volume, e.second,
                second, e.third, third, e.distribution, bins);
    // Number is as exact as the integration where its equation is closed; volume to round-off where it is constant.
    if (c.closedNumber) {
      EXPECT_NEAR(e.number, 0, 1e-6);
    }
    EXPECT_NEAR(e.volume, 0, c.model.growth.active() ? 1e-6 : 1e-12);
    if (sections == 200) {
      EXPECT_NEAR(second, c.order, c.orderTolerance);
      EXPECT_NEAR(third, c.order, c.orderTolerance);
      if (!c.closedNumber) {
        EXPECT_NEAR(std::log2(before.number / e.number) / refined, c.order, c.orderTolerance);
      }
      // Two doublings together: where the edges of bins are between pivots makes the error of each uneven.
      EXPECT_NEAR(0.5 * std::log2(twiceBefore.distribution / e.distribution), c.order, 0.35);
    }
    twiceBefore = before;
    before = e;
  }
}

Case caseOf(const std::string& name, double smallest, double largest, double end) {
  Case c{name, {}, {}, smallest, largest, end};
  c.initial.distribution = Distribution::exponential;
  c.initial.number = 1;
  c.initial.volume = 1;
  return c;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  const auto coagulation = [&](const std::string& name, CollisionKernelType type, double largest, double end) {
    all.push_back(caseOf(name, 1e-3, largest, end));
    all.back().model.coagulation.emplace();
    all.back().model.coagulation->type = type;
    all.back().model.coagulation->rate = 1;
  };
  coagulation("coagulation_constant", CollisionKernelType::constant, 1e4, 10);
  coagulation("coagulation_additive", CollisionKernelType::additive, 1e5, 1);
  coagulation("coagulation_multiplicative", CollisionKernelType::multiplicative, 1e4, 0.2);
  using Daughters = BreakageOptions::Daughters;
  all.push_back(caseOf("breakage_uniform_linear", 1e-4, 40, 10));
  all.back().model.breakage = BreakageOptions{1, 1, 2, Daughters::uniform};
  all.push_back(caseOf("breakage_uniform_square", 1e-4, 40, 10));
  all.back().model.breakage = BreakageOptions{1, 2, 2, Daughters::uniform};
  all.back().closedNumber = false;
  coagulation("coagulation_and_breakage_steady", CollisionKernelType::constant, 60, 10);
  all.back().model.breakage = BreakageOptions{0.5, 1, 2, Daughters::uniform};
  for (const auto scheme : {SectionGrowthScheme::upwind, SectionGrowthScheme::limited}) {
    const bool upwind = scheme == SectionGrowthScheme::upwind;
    all.push_back(caseOf(upwind ? "condensation_upwind" : "condensation_limited", 1e-3, upwind ? 1e5 : 1e3, 1));
    all.back().model.growth.condensation = 1;
    all.back().scheme = scheme;
    if (upwind) all.back().order = 1;
    if (upwind) all.back().orderTolerance = 0.45;  // the second-order part of (spacing^3 - 1) / (spacing - 1) - 3
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Cases, SectionalConvergence, testing::ValuesIn(cases()),
                         [](const auto& parameter) { return parameter.param.name; });

// Growth by surface: moments of order 2/3 are involved, of which the sections have too little while the scheme makes
// too much of the higher ones. The errors cancel in part, so that they have a bound of second order but no clean order.
TEST(SectionalGrowth, SurfaceGrowthAndOxidationAreOfTheOrderOfTheSquareOfTheSpacing) {
  for (const bool growing : {true, false}) {
    Case c = growing ? caseOf("growth", 1e-3, 1e4, 1) : caseOf("oxidation", 1e-6, 200, 1);
    c.initial.distribution = Distribution::lognormal;
    c.initial.geometricDeviation = growing ? 1.4 : 1.3;
    (growing ? c.model.growth.surfaceGrowth : c.model.growth.oxidation) = growing ? 0.5 : 0.1;
    const auto exact = exactSolution(c.model, c.initial);
    ASSERT_NE(exact, nullptr);
    for (const std::size_t sections : {100U, 200U, 400U}) {
      const Errors e = errorsOf(c, *exact, sections);
      const double square = std::pow(std::log(c.largest / c.smallest) / static_cast<double>(sections - 1), 2);
      std::printf("%s, %zu sections: errors over the square of ln(spacing): M0 %.1e, M1 %.3f, M2 %.3f, M3 %.3f\n",
                  c.name.c_str(), sections, e.number / square, e.volume / square, e.second / square, e.third / square);
      EXPECT_NEAR(e.number, 0, 1e-6);
      EXPECT_LT(std::abs(e.volume), 0.5 * square);
      EXPECT_LT(std::abs(e.second), 2 * square);
      EXPECT_LT(std::abs(e.third), 4.5 * square);
    }
  }
}

// Upwind condensation dv/dt = c v moves number at the same rate c / (spacing - 1) everywhere, so that the moments of
// the pivots are known: M_k grows with c (spacing^k - 1) / (spacing - 1) instead of c k.
TEST(SectionalGrowth, UpwindSpreadsAsItsTheorySays) {
  PopulationModel model;
  model.growth.condensation = 0.7;
  InitialPopulation initial;
  initial.distribution = Distribution::lognormal;
  initial.number = 2;
  initial.volume = 1;
  initial.geometricDeviation = 1.2;
  const double spacing = 1.2;
  auto options = test::spacedGrid(100, 0.01, spacing);
  options.growth = SectionGrowthScheme::upwind;
  SectionalSolver solver(model, initial, options);
  const auto before = solver.moments();
  solver.advance(2);
  const auto after = solver.moments();
  for (int k = 0; k < 4; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double rate = 0.7 * (std::pow(spacing, k) - 1) / (spacing - 1);
    EXPECT_NEAR(after[i] / before[i], std::exp(2 * rate), 1e-6 * std::exp(2 * rate)) << "M" << k;
  }
}

// Equal daughters of a monodisperse start: with pivots on all sizes of the chain the sections are exact.
TEST(SectionalBreakage, IsExactWherePivotsAreTheSizesOfTheChain) {
  PopulationModel model;
  model.breakage = BreakageOptions{1, 1, 2, BreakageOptions::Daughters::equal};
  InitialPopulation initial;
  initial.distribution = Distribution::monodisperse;
  initial.number = 1;
  initial.volume = 1;
  const auto exact = exactSolution(model, initial);
  ASSERT_NE(exact, nullptr);
  auto options = test::spacedGrid(40, std::pow(2.0, -39), 2);
  options.relativeTolerance = 1e-11;
  options.absoluteTolerance = 1e-14;
  SectionalSolver solver(model, initial, options);
  for (const double end : {1.0, 30.0}) {
    solver.advance(end);
    const auto moments = solver.moments();
    const auto expected = exact->moments(end);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(moments[k] / *expected[k], 1, 1e-9) << "M" << k << " at " << end;
  }
}

}  // namespace
}  // namespace lampblack::particles
