// The sectional method as a solver: its start, its ends, its budgets over time.
#include "particles/population/sectional/sectional_solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/population/exact_solutions/initial_distribution.hpp"
#include "particles/population/gelation_error.hpp"
#include "particles/population/model/nucleation_schedule.hpp"
#include "particles/population/sectional/initial_sections.hpp"
#include "tests/particles/population/sectional/sectional_fixtures.hpp"

namespace lampblack::particles {
namespace {

using Distribution = InitialPopulation::Distribution;

PopulationModel coagulating(CollisionKernelType type, double rate = 1) {
  PopulationModel model;
  model.coagulation.emplace();
  model.coagulation->type = type;
  model.coagulation->rate = rate;
  return model;
}

InitialPopulation start(Distribution distribution, double volume = 1, double deviation = 1.3) {
  InitialPopulation initial;
  initial.distribution = distribution;
  initial.number = 3;
  initial.volume = volume;
  initial.geometricDeviation = deviation;
  return initial;
}

template <class Error>
std::string messageOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(InitialSections, HoldNumberAndVolumeOfTheDistribution) {
  const SectionGrid grid(test::spacedGrid(100, 0.02, 1.15));
  for (const auto& initial : {start(Distribution::monodisperse, 3.3), start(Distribution::exponential, 0.7),
                              start(Distribution::lognormal, 2.0), start(Distribution::lognormal, 1.0, 1.001),
                              start(Distribution::lognormal, 1.0, 1.0)}) {
    const std::vector<double> y = initialSections(grid, initial, 1e-6);
    const double sigma = 3 * std::log(initial.geometricDeviation);
    const double mean =
        initial.volume * (initial.distribution == Distribution::lognormal ? std::exp(0.5 * sigma * sigma) : 1);
    EXPECT_NEAR(test::numberOf(grid.layout(), y), 3, 1e-14 * 3);
    EXPECT_NEAR(test::volumeOf(grid, y), 3 * mean, 1e-13 * 3 * mean);
    for (const double number : y) EXPECT_GE(number, 0);
  }
}

TEST(InitialSections, HoldTablesAndModes) {
  const SectionGrid grid(test::spacedGrid(100, 0.02, 1.15));
  const InitialPopulation table = tabulated({{0.01, 0.3, 2}, {0.3, 0.31, 1}, {1, 40, 0.5}});
  const InitialPopulation sum = sumOf({table, start(Distribution::monodisperse, 3.3),
                                       start(Distribution::lognormal, 2.0), start(Distribution::exponential, 0.7)});
  for (const InitialPopulation& initial : {table, sum}) {
    const std::vector<double> y = initialSections(grid, initial, 1e-6);
    EXPECT_NEAR(test::numberOf(grid.layout(), y) / initial.number, 1, 1e-13);
    EXPECT_NEAR(test::volumeOf(grid, y) / (initial.number * initial.volume), 1, 1e-13);
    for (const double number : y) EXPECT_GE(number, 0);
  }
  const std::vector<double> y = initialSections(grid, table, 1e-6);
  double below = 0;
  for (std::size_t k = 0; k <= grid.last() && grid.volume(k) < 0.5; ++k) below += y[k];
  EXPECT_NEAR(below, 3, 1e-13) << "nothing lies between 0.31 and 1";
  EXPECT_THAT(messageOf<InputError>([&] {
                (void)initialSections(grid, tabulated({{1e3, 1e5, 1}}), 1e-6);
              }),
              testing::HasSubstr("0.8 of its volume"));
}

// Each interval is divided by its own mean: the moments of pivots exceed the exact ones by the variance this adds,
// which for the exponential is the integral of (v - a)(b - v) n over all intervals.
TEST(InitialSections, SpreadTheSecondMomentByTheSquareOfTheSpacing) {
  double before = 0;
  for (const std::size_t sections : {50U, 100U, 200U}) {
    const SectionGrid grid(test::gridOf(sections, 1e-4, 60));
    const std::vector<double> y = initialSections(grid, start(Distribution::exponential), 1e-6);
    double second = 0;
    for (std::size_t k = 1; k <= grid.last(); ++k) second += y[k] * grid.volume(k) * grid.volume(k);
    const double error = second / 6 - 1;
    EXPECT_GT(error, 0);
    const double spacing = std::log(grid.spacing());
    if (before > 0) {
      EXPECT_NEAR(before / (error / (spacing * spacing)), 1, 0.05);
    }
    before = error / (spacing * spacing);
  }
}

TEST(InitialSections, CountWhatLiesBeyondTheGridOrRefuseIt) {
  const SectionGrid grid(test::gridOf(50, 0.01, 16));
  const std::vector<double> y = initialSections(grid, start(Distribution::exponential), 1e-4);
  EXPECT_NEAR(y[grid.layout().overNumber()], 3 * std::exp(-16), 1e-13 * 3 * std::exp(-16));
  EXPECT_NEAR(y[grid.layout().overVolume()] * 16, 3 * 17 * std::exp(-16), 1e-13 * 51 * std::exp(-16));
  EXPECT_THAT(messageOf<InputError>([&] { (void)initialSections(grid, start(Distribution::exponential), 1e-6); }),
              testing::HasSubstr("ends too early"));
  EXPECT_THAT(
      messageOf<InputError>([&] { (void)initialSections(grid, start(Distribution::monodisperse, 1e-3), 1e-6); }),
      testing::HasSubstr("outside the sectional grid"));
  EXPECT_THAT(messageOf<InputError>([&] { (void)initialSections(grid, start(Distribution::monodisperse, 17), 1e-6); }),
              testing::HasSubstr("outside the sectional grid"));
}

TEST(SectionGridInput, IsChecked) {
  EXPECT_THROW(SectionGrid(test::gridOf(19, 1, 100)), InputError);
  EXPECT_THROW(SectionGrid(test::gridOf(401, 1, 100)), InputError);
  EXPECT_THROW(SectionGrid(test::gridOf(50, 0, 100)), InputError);
  EXPECT_THROW(SectionGrid(test::gridOf(50, 1, 1)), InputError);
  EXPECT_THROW(SectionGrid(test::spacedGrid(50, 1, 1)), InputError);
  EXPECT_THROW(SectionGrid(test::spacedGrid(50, 1, 0)), InputError);
  EXPECT_THROW(SectionGrid(test::spacedGrid(400, 1, 1e9)), InputError);
  auto both = test::spacedGrid(50, 1, 2);
  both.largest = 100;
  EXPECT_THROW(SectionGrid{both}, InputError);
  EXPECT_DOUBLE_EQ(SectionGrid(test::gridOf(21, 1, 1 << 20)).volume(11), 1024);
}

// All processes together, with gains and losses of both moments known in closed form: dM0/dt has no closed form, but
// number counted in and out has. Newton's iteration keeps linear invariants up to the solution of its equations.
TEST(SectionalBudgets, VolumeStaysToRoundOffThroughCoagulationAndBreakage) {
  for (const auto type : {CollisionKernelType::constant, CollisionKernelType::additive}) {
    PopulationModel model = coagulating(type);
    model.breakage = BreakageOptions{0.5, 1, 2, BreakageOptions::Daughters::uniform};
    SectionalSolver solver(model, start(Distribution::exponential), test::gridOf(80, 1e-5, 1e4));
    solver.advance(2);
    solver.advance(10);
    const auto left = solver.left();
    EXPECT_NEAR((solver.moments()[1] + left.overVolume) / 3, 1, 1e-12);
    EXPECT_EQ(left.vanishedNumber, 0);
    EXPECT_EQ(solver.time(), 10);
  }
}

TEST(SectionalBudgets, EverythingThatLeavesIsCounted) {
  // Oxidation at both ends of what is left: number is kept, volume falls by exactly what is oxidised and vanishes.
  PopulationModel model;
  model.growth.condensation = -0.8;
  model.growth.smallestVolume = 0.02;
  SectionalSolver solver(model, start(Distribution::lognormal), test::gridOf(60, 0.03, 300));
  const double volume = solver.moments()[1];
  double taken = 0;
  // dM1/dt = -0.8 M1 - what vanishes; integrated by the trapezoidal rule over M1 itself in small pieces.
  const int pieces = 2000;
  double before = volume;
  for (int k = 1; k <= pieces; ++k) {
    solver.advance(6.0 * k / pieces);
    const double now = solver.moments()[1];
    taken += 0.8 * 6.0 / pieces * 0.5 * (before + now);
    before = now;
  }
  const auto left = solver.left();
  EXPECT_NEAR((solver.moments()[0] + left.vanishedNumber) / 3, 1, 1e-12);
  EXPECT_GT(left.vanishedNumber, 1.0);
  EXPECT_NEAR((before + left.vanishedVolume + taken) / volume, 1, 1e-5);  // the rule's error is 0.8^2 (6/2000)^2 / 12
}

// Every particle breaks at the same rate, whatever its size: most of the number ends up far below the first pivot. The
// section at zero keeps it, and its coagulation and breakage, so that the number still follows its exact equation.
TEST(SectionalBudgets, NumberBelowTheFirstPivotIsNotLost) {
  PopulationModel model = coagulating(CollisionKernelType::constant);
  InitialPopulation initial = start(Distribution::exponential);
  initial.number = 1;
  for (const auto daughters : {BreakageOptions::Daughters::equal, BreakageOptions::Daughters::uniform}) {
    model.breakage = BreakageOptions{10, 0, 2, daughters};
    SectionalSolver solver(model, initial, test::gridOf(40, 1e-2, 100));
    solver.advance(0.5);
    // dM0/dt = 10 M0 - M0^2 / 2.
    const double growth = std::exp(5.0), exact = growth / (1 + (growth - 1) / 20);
    EXPECT_NEAR(solver.moments()[0], exact, 1e-6 * exact);
    EXPECT_NEAR(solver.moments()[1] + solver.left().overVolume, 1, 1e-12);
    EXPECT_GT(solver.numbers()[0], 0.1 * exact);
  }
}

// Constants like those of a flame: nuclei of 1 nm, surface growth, coagulation from the free-molecular regime into the
// transition, over nine decades of volume.
TEST(SectionalSoot, NucleationGrowthAndCoagulationTogether) {
  PopulationModel model = coagulating(CollisionKernelType::transition);
  model.coagulation->enhancement = 2.2;
  model.coagulation->gas = {1700, 101325, 0.2, 6e-5, 0.028};
  NucleationOptions nuclei;
  nuclei.source = NucleationOptions::Source::precursor;
  nuclei.rateConstant = 100;
  nuclei.precursor = 1e20;
  nuclei.volume = 1e-27;
  model.nucleation = nuclei;
  model.growth.surfaceGrowth = 2e-7;
  const auto run = [&](std::size_t sections) {
    SectionalSolver solver(model, {}, test::gridOf(sections, 1e-27, 1e-18));
    solver.advance(0.05);
    for (const double number : solver.numbers()) EXPECT_GT(number, -1e-10 * solver.moments()[0]);
    EXPECT_LT(solver.left().overVolume, 1e-9 * solver.moments()[1]);
    return solver.moments();
  };
  // Second order in the spacing: of the difference of two levels a third is left in the finer one.
  const auto coarse = run(31), medium = run(61), fine = run(121);
  for (const std::size_t k : {0U, 1U}) {
    const double order = std::log2(std::abs((coarse[k] - medium[k]) / (medium[k] - fine[k])));
    EXPECT_NEAR(order, 2, 0.75) << "M" << k;
    EXPECT_LT(std::abs(medium[k] - fine[k]) / 3, 0.005 * fine[k]) << "M" << k;
  }
}

TEST(SectionalNucleation, GivesTheNumberAndVolumeOfTheSchedule) {
  NucleationOptions table;
  table.source = NucleationOptions::Source::table;
  table.times = {0.5, 1, 1.001, 3};
  table.rates = {2, 3, 40, 40};
  NucleationOptions precursor;
  precursor.source = NucleationOptions::Source::precursor;
  precursor.rateConstant = 2;
  precursor.precursor = 1e12;
  for (auto nucleation : {table, precursor}) {
    nucleation.volume = 1.37;
    PopulationModel model;
    model.nucleation = nucleation;
    SectionalSolver solver(model, {}, test::spacedGrid(20, 1, 1.5));
    const NucleationSchedule schedule(nucleation);
    for (const double end : {0.4, 0.7, 2.0, 5.0}) {
      solver.advance(end);
      const double exact = schedule.cumulative(end);
      // The tolerance of the integration, 1e-8, over some hundred steps.
      EXPECT_NEAR(solver.moments()[0], exact, 1e-6 * exact) << end;
      EXPECT_NEAR(solver.moments()[1], 1.37 * solver.moments()[0], 1e-13 * 1.37 * exact) << end;
    }
  }
}

// The multiplicative kernel gels at 1 / (A M2(0)). The fixed pivot technique makes too much of the second moment by a
// part of the square of the spacing, and gels earlier by such a part.
TEST(SectionalGelation, IsReportedAtItsTime) {
  const auto lead = [](std::size_t sections) {
    SectionalSolver solver(coagulating(CollisionKernelType::multiplicative), start(Distribution::monodisperse),
                           test::gridOf(sections, 1, 1e8));
    double time = 0;
    try {
      solver.advance(1);
    } catch (const GelationError& error) {
      time = error.time();
    }
    return 1 - 3 * time;
  };
  const double coarse = lead(100), fine = lead(200);
  EXPECT_GT(fine, 0);
  EXPECT_LT(fine, 0.01);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.3);
}

TEST(SectionalEnd, SaysThatTheGridIsTooShort) {
  SectionalSolver solver(coagulating(CollisionKernelType::constant), start(Distribution::monodisperse),
                         test::gridOf(50, 1, 100));
  const std::string message = messageOf<NumericsError>([&] { solver.advance(100); });
  EXPECT_THAT(message, testing::HasSubstr("ends too early"));
  EXPECT_THAT(message, testing::Not(testing::HasSubstr("gels")));
}

TEST(SectionalBins, KeepNumberAndVolume) {
  SectionalSolver solver(coagulating(CollisionKernelType::constant), start(Distribution::exponential),
                         test::gridOf(60, 1e-3, 1e4));
  solver.advance(2);
  // Fine bins: the volume of a bin is that of its middle.
  std::vector<double> edges{0};
  for (double v = 5e-4; v < 2e4; v *= 1.0002) edges.push_back(v);
  const std::vector<double> bins = solver.numberInBins(edges);
  double number = 0, volume = 0;
  for (std::size_t b = 0; b < bins.size(); ++b) {
    number += bins[b];
    if (b > 0) volume += bins[b] * 0.5 * (edges[b] + edges[b + 1]);
  }
  EXPECT_NEAR(number, solver.moments()[0], 1e-12);
  EXPECT_NEAR(volume, solver.moments()[1], 1e-7 * volume);
}

TEST(SectionalSpread, IsTheOneOfTheLognormal) {
  SectionalSolver solver({}, start(Distribution::lognormal, 1, 1.5), test::gridOf(400, 1e-4, 1e5));
  // The split between pivots adds ln(spacing)^2 / 6 to the variance of ln v.
  const double spacing = std::log(1e9) / 399;
  const double sigma = std::log(1.5);
  EXPECT_NEAR(std::log(solver.geometricDeviation()), std::sqrt(sigma * sigma + spacing * spacing / 54), 1e-6);
}

// A day of a laboratory's aerosol: 60 of the sections lie above all particles, up to 1e15 times the mean volume. What
// the integrator leaves there, of either sign, must not make the third moment.
TEST(SectionalSolver, SectionsAboveAllParticlesWeighNothing) {
  PopulationModel model;
  model.density = 1000;
  model.coagulation.emplace();
  model.coagulation->type = CollisionKernelType::transitionFuchs;
  model.coagulation->gas = {.temperature = 288, .pressure = 1e5, .viscosity = 1.78e-5, .meanMolecularWeight = 28.97e-3};
  const InitialPopulation initial{Distribution::lognormal, 1e11, std::acos(-1.0) / 6 * std::pow(50e-9, 3), 1.74};
  SectionalSolver enough(model, initial, test::spacedGrid(120, 1e-26, 1.25));
  SectionalSolver many(model, initial, test::spacedGrid(160, 1e-26, 1.25));
  for (int hour = 2; hour <= 24; hour += 2) {
    enough.advance(3600 * hour);
    many.advance(3600 * hour);
    const auto expected = enough.moments(), found = many.moments();
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(found[k] / expected[k], 1, 1e-7) << "M" << k << ", hour " << hour;
  }
  EXPECT_NEAR(many.moments()[3] / 8.84e-51, 1, 5e-4) << "as a tolerance of 1e-20 has it";
  EXPECT_NEAR(many.moments()[1] / initialMoment(initial, 1), 1, 1e-11);
}

}  // namespace
}  // namespace lampblack::particles
