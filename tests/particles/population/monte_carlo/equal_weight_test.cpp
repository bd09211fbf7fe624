// The methods with equal weights against exact solutions: each moment at the end is the mean over repeats, and has to
// lie within zLimit standard errors of the exact one.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "../../statistics.hpp"
#include "core/modules.hpp"
#include "particles/population/gelation_error.hpp"
#include "particles/population/monte_carlo_options.hpp"

namespace lampblack::particles {
namespace {

using Distribution = InitialPopulation::Distribution;
using Method = MonteCarloMethod;
using test::Sample;
using test::summarise;
using test::zLimit;

constexpr InitialPopulation monodisperse{Distribution::monodisperse, 1.0, 1.0, 1};
constexpr InitialPopulation exponential{Distribution::exponential, 1.0, 1.0, 1};

PopulationModel coagulation(CollisionKernelType type) {
  PopulationModel model;
  model.coagulation.emplace();
  model.coagulation->type = type;
  model.coagulation->rate = 1;
  return model;
}

MonteCarloOptions options(Method method, std::size_t particles, std::uint64_t repeat = 0) {
  MonteCarloOptions result;
  result.method = method;
  result.particles = particles;
  result.repeat = repeat;
  return result;
}

std::array<Sample, 4> momentsOver(int repeats, Method method, std::size_t particles, const PopulationModel& model,
                                  const InitialPopulation& initial, double end,
                                  EventRates rates = EventRates::majorant) {
  std::array<std::vector<double>, 4> values;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    MonteCarloOptions chosen = options(method, particles, static_cast<std::uint64_t>(repeat));
    chosen.rates = rates;
    const auto solver = makeMonteCarlo(model, initial, chosen);
    solver->advance(end / 3);
    solver->advance(end);
    const auto moments = solver->moments();
    for (std::size_t k = 0; k < 4; ++k) values[k].push_back(moments[k]);
  }
  return {summarise(values[0]), summarise(values[1]), summarise(values[2]), summarise(values[3])};
}

void expectMoment(const Sample& sample, double exact, const char* what) {
  if (sample.standardError < 1e-12 * std::abs(exact)) {
    EXPECT_NEAR(sample.mean, exact, 1e-11 * std::abs(exact)) << what;
  } else {
    EXPECT_LT(std::abs(sample.z(exact)), zLimit) << what << ": " << sample.mean << " for " << exact;
  }
}

std::string nameOf(Method method) {
  switch (method) {
    case Method::dsmc:
      return "Dsmc";
    case Method::constantVolume:
      return "ConstantVolume";
    case Method::constantNumberByMass:
      return "ConstantNumberByMass";
    default:
      return "ConstantNumberByNumber";
  }
}

class EqualWeight : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, EqualWeight,
                         testing::Values(Method::dsmc, Method::constantVolume, Method::constantNumberByMass,
                                         Method::constantNumberByNumber),
                         [](const auto& chosen) { return nameOf(chosen.param); });

// M0 = 2/(2+t), M2 = M2(0) + t, M3 = M3(0) + 3 M2(0) t + 3 t^2/2: three doublings.
TEST_P(EqualWeight, ConstantKernelHasTheExactMoments) {
  const double t = 12;
  const auto moments = momentsOver(100, GetParam(), 500, coagulation(CollisionKernelType::constant), monodisperse, t);
  expectMoment(moments[0], 2 / (2 + t), "M0");
  expectMoment(moments[1], 1, "M1");
  expectMoment(moments[2], 1 + t, "M2");
  expectMoment(moments[3], 1 + 3 * t + 1.5 * t * t, "M3");
}

TEST_P(EqualWeight, AdditiveKernelHasTheExactMoments) {
  const double t = 1;
  const auto moments = momentsOver(100, GetParam(), 1000, coagulation(CollisionKernelType::additive), exponential, t);
  expectMoment(moments[0], std::exp(-t), "M0");
  expectMoment(moments[1], 1, "M1");
  expectMoment(moments[2], 2 * std::exp(2 * t), "M2");
}

TEST_P(EqualWeight, UniformBreakageHasTheExactMoments) {
  PopulationModel model;
  model.breakage = BreakageOptions{1, 1, 2, BreakageOptions::Daughters::uniform};
  const double t = 6;
  const auto moments = momentsOver(100, GetParam(), 500, model, monodisperse, t);
  expectMoment(moments[0], 1 + t, "M0");
  expectMoment(moments[1], 1, "M1");
  // Of n = e^(-t x) (delta(x-1) + 2t + t^2 (1-x)) on [0, 1].
  const double e = std::exp(-t);
  double second = e;
  constexpr int points = 20000;
  for (int k = 0; k < points; ++k) {
    const double x = (k + 0.5) / points;
    second += x * x * std::exp(-t * x) * (2 * t + t * t * (1 - x)) / points;
  }
  expectMoment(moments[2], second, "M2");
}

TEST_P(EqualWeight, TwelveDaughtersConserveWhatTheyShould) {
  PopulationModel model;
  model.breakage = BreakageOptions{1, 0, 12, BreakageOptions::Daughters::equal};
  const double t = 0.3;
  const auto moments = momentsOver(60, GetParam(), 500, model, exponential, t);
  expectMoment(moments[0], std::exp(11 * t), "M0");
  expectMoment(moments[1], 1, "M1");
  expectMoment(moments[2], 2 * std::exp((12.0 / 144 - 1) * t), "M2");
}

TEST_P(EqualWeight, NucleationAndCoagulationReachTheSteadyNumber) {
  PopulationModel model = coagulation(CollisionKernelType::constant);
  model.nucleation.emplace();
  model.nucleation->rate = 2;
  model.nucleation->volume = 0.5;
  const double t = 3, steady = 2;  // dM0/dt = J - M0^2/2
  const double start = std::atanh(0.5);
  const auto moments = momentsOver(100, GetParam(), 500, model, monodisperse, t);
  expectMoment(moments[0], steady * std::tanh(t + start), "M0");  // sqrt(J/2) = 1
  expectMoment(moments[1], 1 + t, "M1");
  // dM2/dt = J v^2 + M1^2
  expectMoment(moments[2], 1 + 0.5 * t + t + t * t + t * t * t / 3, "M2");
}

TEST_P(EqualWeight, APrecursorFillsAnEmptyEnsemble) {
  PopulationModel model;
  model.nucleation.emplace();
  model.nucleation->source = NucleationOptions::Source::precursor;
  model.nucleation->rateConstant = 1;
  model.nucleation->precursor = 10;
  MonteCarloOptions chosen = options(GetParam(), 400);
  chosen.expectedNumber = 1;
  const auto solver = makeMonteCarlo(model, InitialPopulation{}, chosen);
  // Evenly spaced nuclei and equal volumes: nothing is random but the offset, less than the weight of a nucleus. That
  // weight is at most 10/400 times 2 with a full ensemble.
  for (const double t : {0.01, 0.2, 3.0}) {
    solver->advance(t);
    EXPECT_NEAR(solver->moments()[0], 10 * (1 - std::exp(-t)), 10.0 / 200);
    EXPECT_NEAR(solver->moments()[1], solver->moments()[0], 1e-12);
  }
}

TEST_P(EqualWeight, DepositionAndDilution) {
  PopulationModel model;
  model.deposition = DepositionOptions{1, 0};
  model.dilution = 0.5;
  const auto moments = momentsOver(100, GetParam(), 200, model, exponential, 2);
  expectMoment(moments[0], std::exp(-3), "M0");
  expectMoment(moments[1], std::exp(-3), "M1");
}

// dv/dt = s v multiplies every volume: exact by splitting, in the mean by jumps.
TEST_P(EqualWeight, CondensationBySplittingAndByJumps) {
  PopulationModel model;
  model.growth.condensation = 0.5;
  auto moments = momentsOver(2, GetParam(), 500, model, monodisperse, 2);
  EXPECT_NEAR(moments[1].mean, std::exp(1), 1e-12);
  EXPECT_NEAR(moments[3].mean, std::exp(3), 1e-11);
  model.growth.treatment = GrowthOptions::Treatment::jumps;
  model.growth.monomer = 0.1;
  moments = momentsOver(60, GetParam(), 200, model, monodisperse, 2);
  EXPECT_NEAR(moments[0].mean, 1, 1e-14);
  expectMoment(moments[1], std::exp(1), "M1");
  // dM2/dt = s (2 M2 + m M1)
  expectMoment(moments[2], std::exp(2) + 0.1 * (std::exp(2) - std::exp(1)), "M2");
}

TEST_P(EqualWeight, OxidationLosesWhatFallsBelowTheSmallestVolume) {
  PopulationModel model;
  model.growth.oxidation = 0.1;  // dd/dt = -0.2
  model.growth.smallestVolume = 0.1;
  const auto solver = makeMonteCarlo(model, exponential, options(GetParam(), 2000));
  solver->advance(1);
  // Those with d(0)^3 pi/6 > x are left.
  const double pi = 3.14159265358979, x = pi / 6 * std::pow(std::cbrt(6 / pi * 0.1) + 0.2, 3);
  EXPECT_NEAR(static_cast<double>(solver->counters().vanished), 2000 * (1 - std::exp(-x)), 2);  // stratified sample
}

TEST(EqualWeightMass, IsConstantOverAMillionEvents) {
  for (const Method method : {Method::dsmc, Method::constantVolume, Method::constantNumberByMass}) {
    PopulationModel model = coagulation(CollisionKernelType::additive);
    if (method == Method::constantNumberByMass)
      model.breakage = BreakageOptions{5, 1, 2, BreakageOptions::Daughters::equal};
    const auto solver = makeMonteCarlo(model, exponential, options(method, 20000));
    while (solver->counters().events() < (method == Method::constantNumberByMass ? 1000000 : 50000)) {
      solver->advance(solver->time() + 0.5);
      ASSERT_NEAR(solver->moments()[1], 1, 1e-11) << nameOf(method);
    }
  }
}

TEST(EqualWeightNumber, StaysInItsRange) {
  PopulationModel model = coagulation(CollisionKernelType::constant);
  model.breakage = BreakageOptions{0.5, 0, 2, BreakageOptions::Daughters::equal};
  for (const Method method : {Method::constantNumberByMass, Method::constantNumberByNumber}) {
    const auto solver = makeMonteCarlo(model, exponential, options(method, 100));
    for (int step = 1; step < 100; ++step) {
      solver->advance(0.05 * step);
      ASSERT_EQ(solver->particles(), 100u);
    }
    EXPECT_EQ(solver->counters().copies, solver->counters().coagulations);
    EXPECT_EQ(solver->counters().removals, solver->counters().breakages);
  }
  for (const Method method : {Method::dsmc, Method::constantVolume}) {
    PopulationModel growing = model;
    growing.breakage->rate = 5;
    for (const auto& chosen : {model, growing, coagulation(CollisionKernelType::constant)}) {
      const auto solver = makeMonteCarlo(chosen, exponential, options(method, 100));
      for (int step = 1; step < 400; ++step) {
        solver->advance(0.05 * step);
        ASSERT_GE(solver->particles(), 50u);
        ASSERT_LE(solver->particles(), method == Method::dsmc ? 100u : 200u);
      }
    }
  }
}

TEST(EqualWeightRates, FictitiousJumpsAndExactRatesHaveTheSameLaw) {
  PopulationModel model;
  model.coagulation.emplace();
  model.coagulation->type = CollisionKernelType::freeMolecular;
  model.coagulation->gas.temperature = 1800;
  const InitialPopulation initial{Distribution::lognormal, 1e18, 4e-27, 1.3};
  const auto fast = momentsOver(100, Method::dsmc, 100, model, initial, 3e-3);
  const auto exact = momentsOver(100, Method::dsmc, 100, model, initial, 3e-3, EventRates::exact);
  EXPECT_LT(fast[0].mean, 0.5 * initial.number);
  for (const std::size_t k : {0, 2, 3}) {
    const double error = std::hypot(fast[k].standardError, exact[k].standardError);
    EXPECT_LT(std::abs(fast[k].mean - exact[k].mean), zLimit * error) << k;
  }
}

// The multiplicative kernel gels at t = 1/M2(0). At t (1 + x) the largest particle has the share 2 x + O(x^2) from a
// monodisperse and 4/3 x + O(x^2) from an exponential start, so that 2 N^(-1/3) is reached N^(-1/3) and 1.5 N^(-1/3)
// late in the limit, with a spread and corrections of the same order.
TEST_P(EqualWeight, GelationStopsAtItsTime) {
  const PopulationModel model = coagulation(CollisionKernelType::multiplicative);
  for (const auto& [initial, gel] : {std::pair{monodisperse, 1.0}, std::pair{exponential, 0.5}}) {
    for (const std::size_t particles : {1000, 8000}) {
      constexpr int repeats = 8;
      double mean = 0;
      for (std::uint64_t repeat = 0; repeat < repeats; ++repeat) {
        const auto solver = makeMonteCarlo(model, initial, options(GetParam(), particles, repeat));
        try {
          solver->advance(10);
          ADD_FAILURE() << "no gelation";
        } catch (const GelationError& error) {
          mean += error.time() / repeats;
        }
      }
      EXPECT_NEAR(mean / gel, 1 + 1.5 / std::cbrt(particles), 1.5 / std::cbrt(particles)) << particles;
    }
  }
}

// The case of Wang (2025) stops at 60 % of the time of gelation.
TEST(EqualWeightGelation, DoesNotStopEarly) {
  const PopulationModel model = coagulation(CollisionKernelType::multiplicative);
  for (std::uint64_t repeat = 0; repeat < 200; ++repeat) {
    const auto solver = makeMonteCarlo(model, exponential, options(Method::dsmc, 2000, repeat));
    ASSERT_NO_THROW(solver->advance(0.3));
  }
}

TEST(EqualWeightGelation, KernelsThatDoNotGelNeverStop) {
  const auto solver =
      makeMonteCarlo(coagulation(CollisionKernelType::constant), monodisperse, options(Method::dsmc, 4));
  EXPECT_NO_THROW(solver->advance(100));
}

}  // namespace
}  // namespace lampblack::particles
