// Moment methods where their closure is exact, and at their ends.
#include "core/errors.hpp"
#include "particles/population/gelation_error.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/population/moments/moment_fixtures.hpp"

namespace lampblack::test {
namespace {

constexpr auto uniform = BreakageOptions::Daughters::uniform;
constexpr auto equalPieces = BreakageOptions::Daughters::equal;

// Every moment that is known, after `time`. Tolerances of 1e-8 a step add up over some hundred steps, and to k times
// that in v^k where particles grow by decades.
void expectExact(const PopulationModel& model, const InitialPopulation& initial, double time,
                 const std::vector<Closure>& closures = everyClosure()) {
  const auto exact = exactSolution(model, initial);
  ASSERT_TRUE(exact);
  const auto expected = exact->moments(time);
  for (const auto& closure : closures) {
    const auto solver = makeMoments(model, initial, closure.options);
    solver->advance(0.3 * time);
    solver->advance(time);
    EXPECT_EQ(solver->time(), time);
    const auto m = solver->moments();
    for (std::size_t k = 0; k < 4; ++k) {
      if (!expected[k]) continue;
      EXPECT_NEAR(m[k] / *expected[k], 1, 1e-5) << exact->name() << ", " << closure.name << " M" << k;
    }
  }
}

TEST(MomentMethods, SimpleKernelsAreExact) {
  for (const auto& initial : {equalStart(), exponentialStart(), logNormalStart(1, 1, 1.3)}) {
    expectExact(coagulating(CollisionKernelType::constant), initial, 30);
    expectExact(coagulating(CollisionKernelType::additive), initial, 2);
    const auto gelling = coagulating(CollisionKernelType::multiplicative);
    expectExact(gelling, initial, 0.8 * exactSolution(gelling, initial)->gelationTime().value());
  }
  // In physical units.
  expectExact(coagulating(CollisionKernelType::constant, 1e-14), exponentialStart(1e17, 1e-26), 1e-2);
}

TEST(MomentMethods, SingleProcessesAreExact) {
  PopulationModel nucleation;
  nucleation.nucleation = steadyNuclei(1e18, 3e-28);
  expectExact(nucleation, {}, 1e-3);
  nucleation.nucleation->source = NucleationOptions::Source::precursor;
  nucleation.nucleation->rateConstant = 5e-6;
  nucleation.nucleation->precursor = 1e5;
  nucleation.nucleation->volume = 1;
  expectExact(nucleation, equalStart(3000, 1), 1e6);

  PopulationModel losses;
  losses.deposition = DepositionOptions{.rate = 1e-5, .exponent = 0};
  losses.dilution = 2e-5;
  expectExact(losses, exponentialStart(1e10, 1), 5e5);

  PopulationModel condensation;
  condensation.growth.condensation = 1;
  expectExact(condensation, exponentialStart(1e6, 1), 5);
}

TEST(MomentMethods, ProcessesTogetherAreExactWhereTheyClose) {
  auto model = coagulating(CollisionKernelType::constant, 1e-11);
  model.nucleation = steadyNuclei(1e12, 1);
  expectExact(model, equalStart(1e11, 1), 20);  // Wang (2025), case 9
  expectExact(model, {}, 20);
  for (const auto daughters : {uniform, equalPieces}) {
    auto both = coagulating(CollisionKernelType::constant);
    both.breakage = BreakageOptions{.rate = 0.5, .exponent = 0, .fragments = 2, .daughters = daughters};
    expectExact(both, equalStart(), 20);  // Wang (2025), cases 10 and 12
    both.deposition = DepositionOptions{.rate = 0.1, .exponent = 0};
    both.growth.condensation = 0.2;
    both.nucleation = steadyNuclei(0.3, 0.5);
    expectExact(both, exponentialStart(), 8);
  }
}

TEST(MomentMethods, NucleationFromATableHasItsKinksAndEnds) {
  auto model = coagulating(CollisionKernelType::constant, 1.0);
  model.nucleation.emplace();
  model.nucleation->source = NucleationOptions::Source::table;
  model.nucleation->times = {1, 2, 4};
  model.nucleation->rates = {0.5, 6, 6};
  model.nucleation->volume = 2;
  expectExact(model, {}, 9);
  const auto solver = makeMoments(model, {}, qmom(3));
  solver->advance(0.9);
  EXPECT_EQ(solver->moments()[0], 0);
  EXPECT_EQ(solver->geometricDeviation(), 1);
}

TEST(MomentMethods, VolumeIsConservedToRoundOff) {
  for (const auto type : {CollisionKernelType::freeMolecular, CollisionKernelType::continuum,
                          CollisionKernelType::transition, CollisionKernelType::shear}) {
    auto model = coagulating(type);
    model.breakage = BreakageOptions{.rate = 3, .exponent = 0, .fragments = 2, .daughters = uniform};
    for (const auto& closure : everyClosure()) {
      const auto solver = makeMoments(model, exponentialStart(1e16, 1e-25), closure.options);
      solver->advance(1);
      EXPECT_NEAR(solver->moments()[1] / 1e-9, 1, 1e-13) << closure.name;
    }
  }
}

TEST(MomentMethods, SurfaceGrowthOfEqualParticlesIsExact) {
  for (const double oxidation : {0.0, 0.15}) {
    PopulationModel model;
    model.growth.surfaceGrowth = 0.1;
    model.growth.oxidation = oxidation;
    expectExact(model, equalStart(), 3);
  }
}

TEST(MomentMethods, QuadratureEndsEqualParticlesWhenTheyAreGone) {
  PopulationModel model;
  model.growth.oxidation = 0.1;
  model.growth.smallestVolume = 0.01;
  const double gone = (std::cbrt(6 / M_PI) - std::cbrt(0.06 / M_PI)) / 0.2;  // s
  const auto solver = makeMoments(model, equalStart(), qmom(3));
  solver->advance(gone * (1 - 1e-5));
  EXPECT_NEAR(solver->moments()[0], 1, 1e-12);
  solver->advance(gone * (1 + 1e-5));
  EXPECT_EQ(solver->moments()[0], 0);
  EXPECT_EQ(solver->counters().vanished, 1U);
  EXPECT_THROW(makeMoments(model, equalStart(), momic(6))->advance(2 * gone), NumericsError);
}

TEST(MomentMethods, GelationIsNamedWithItsTime) {
  for (const auto& closure : everyClosure()) {
    const auto solver = makeMoments(coagulating(CollisionKernelType::multiplicative), equalStart(), closure.options);
    try {
      solver->advance(1.5);
      FAIL() << closure.name;
    } catch (const GelationError& error) {
      EXPECT_NEAR(error.time(), 1, 1e-5) << closure.name;
    }
  }
}

TEST(MomentMethods, WhatTheyCannotDoIsRefused) {
  const auto refused = [](const PopulationModel& model, const MomentOptions& options) {
    EXPECT_THROW(static_cast<void>(makeMoments(model, exponentialStart(1e16, 1e-25), options)), InputError);
  };
  const auto model = coagulating(CollisionKernelType::freeMolecular);
  for (const std::size_t count : {2U, 3U, 5U, 10U}) refused(model, {MomentMethod::qmom, count});
  for (const std::size_t count : {3U, 9U}) refused(model, {MomentMethod::momic, count});
  refused(model, {MomentMethod::qmom, 6, QuadratureInversion::wheeler, 0});
  refused(coagulating(CollisionKernelType::transitionFuchs), momic(6));
  refused(coagulating(CollisionKernelType::gravitational), momic(6));
  auto efficient = model;
  efficient.coagulation->efficiencyDiameter = 1e-9;
  refused(efficient, momic(6));
  auto breaking = model;
  breaking.breakage = BreakageOptions{.rate = 1, .exponent = 1};
  refused(breaking, momic(6));
  auto depositing = model;
  depositing.deposition = DepositionOptions{.rate = 1, .exponent = 1};
  refused(depositing, momic(6));
}

TEST(MomentMethods, DeviationOfALogNormalPopulation) {
  // MOMIC's closure is the log-normal distribution's own.
  const auto model = coagulating(CollisionKernelType::constant);
  EXPECT_NEAR(makeMoments(model, logNormalStart(1, 1, 1.4), momic(4))->geometricDeviation(), 1.4, 1e-12);
  EXPECT_NEAR(makeMoments(model, equalStart(), qmom(3))->geometricDeviation(), 1, 1e-12);
  EXPECT_TRUE(makeMoments(model, equalStart(), qmom(3))->numberInBins(std::vector<double>{0, 1}).empty());
}

// Two nodes of the exponential distribution, those of Gauss and Laguerre: v = 2 -+ sqrt(2) with the weights
// (2 +- sqrt(2))/4. Diameters go with v^(1/3), so that ln sigma_g is a third of the deviation of ln v. The nodes come
// from moments, with an error of some units of the last place.
TEST(MomentMethods, DeviationOfTheNodes) {
  const double root = std::sqrt(2.0), small = std::log(2 - root), large = std::log(2 + root);
  const double share = (2 + root) / 4, mean = share * small + (1 - share) * large;
  const double variance = share * std::pow(small - mean, 2) + (1 - share) * std::pow(large - mean, 2);
  const auto model = coagulating(CollisionKernelType::constant);
  for (const double number : {1.0, 1e16})
    EXPECT_NEAR(makeMoments(model, exponentialStart(number, 1e-24), qmom(2))->geometricDeviation(),
                std::exp(std::sqrt(variance) / 3), 1e-12);
}

}  // namespace
}  // namespace lampblack::test
