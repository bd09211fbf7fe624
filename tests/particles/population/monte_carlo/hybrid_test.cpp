#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../../statistics.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/population/gelation_error.hpp"
#include "particles/population/model/sphere.hpp"
#include "particles/population/monte_carlo/hybrid_solver.hpp"
#include "same_law.hpp"

namespace lampblack::particles {
namespace {

using test::Sample;
using test::summarise;
using test::zLimit;
using Distribution = InitialPopulation::Distribution;
using Process = JumpProcess<HybridMethod<Sphere>>;

PopulationModel coagulation(CollisionKernelType type) {
  PopulationModel model;
  model.coagulation.emplace();
  model.coagulation->type = type;
  model.coagulation->rate = 1;
  model.coagulation->gas.temperature = 1800;
  return model;
}

PopulationModel& withNucleation(PopulationModel& model, double rate, double volume = 1) {
  model.nucleation.emplace();
  model.nucleation->rate = rate;
  model.nucleation->volume = volume;
  return model;
}

PopulationModel& withJumps(PopulationModel& model, double condensation, double monomer = 1) {
  model.growth.condensation = condensation;
  model.growth.treatment = GrowthOptions::Treatment::jumps;
  model.growth.monomer = monomer;
  return model;
}

MonteCarloOptions hybridOptions(std::size_t particles, std::size_t threshold, double expected, int repeat = 0) {
  MonteCarloOptions options;
  options.method = MonteCarloMethod::hybrid;
  options.particles = particles;
  options.threshold = threshold;
  options.expectedNumber = expected;
  options.repeat = static_cast<std::uint64_t>(repeat);
  return options;
}

std::unique_ptr<PopulationSolver> make(const PopulationModel& model, const InitialPopulation& initial,
                                       const MonteCarloOptions& options) {
  return makeHybrid(Sphere(model.density), model, initial, options);
}

const HybridMethod<Sphere>& methodOf(const PopulationSolver& solver) {
  return dynamic_cast<const Process&>(solver).method();
}

// What comes out of many repeats: moments, then bins.
template <class Make>
std::vector<Sample> over(int repeats, double end, const std::vector<double>& edges, Make&& makeOne) {
  std::vector<std::vector<double>> values;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const auto solver = makeOne(repeat);
    solver->advance(end);
    std::size_t k = 0;
    const auto note = [&](double x) {
      if (values.size() == k) values.emplace_back();
      values[k++].push_back(x);
    };
    for (const double x : solver->moments()) note(x);
    for (const double x : solver->numberInBins(edges)) note(x);
  }
  std::vector<Sample> samples;
  for (const auto& column : values) samples.push_back(summarise(column));
  return samples;
}

// dM0/dt = J - A M0^2/2, dM2/dt = J + A M1^2, dM3/dt = J + 3 A M1 M2 with nuclei of volume 1.
struct ConstantKernelAndNucleation {
  double a = 1, rate = 1;
  [[nodiscard]] double m0(double t) const { return std::sqrt(2 * rate / a) * std::tanh(std::sqrt(a * rate / 2) * t); }
  [[nodiscard]] double m2(double t) const { return rate * t + a * rate * rate * t * t * t / 3; }
  [[nodiscard]] double m3(double t) const {
    return rate * t + 3 * a * rate * (rate * t * t * t / 3 + a * rate * rate * std::pow(t, 5) / 15);
  }
};

TEST(Hybrid, ConstantKernelAndNucleationHaveTheExactMoments) {
  PopulationModel model = coagulation(CollisionKernelType::constant);
  withNucleation(model, 1);
  const ConstantKernelAndNucleation exact;
  const double end = 6;
  for (const std::size_t threshold : {1u, 4u, 1000u}) {
    const auto samples =
        over(60, end, {}, [&](int repeat) { return make(model, {}, hybridOptions(400, threshold, 1.5, repeat)); });
    EXPECT_LT(std::abs(samples[0].z(exact.m0(end))), zLimit) << threshold;
    EXPECT_LT(std::abs(samples[2].z(exact.m2(end))), zLimit) << threshold;
    EXPECT_LT(std::abs(samples[3].z(exact.m3(end))), zLimit) << threshold;
  }
}

// From equal particles to the sizes of 1, 2 ... units: N_k = (t/2)^(k-1) / (1+t/2)^(k+1), below and above the
// threshold.
TEST(Hybrid, SizesOfTheConstantKernelAreExactAcrossTheThreshold) {
  const PopulationModel model = coagulation(CollisionKernelType::constant);
  const InitialPopulation initial{Distribution::monodisperse, 1.0, 1.0, 1};
  const double end = 4;
  const std::vector<double> edges = {0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5};
  const auto samples =
      over(100, end, edges, [&](int repeat) { return make(model, initial, hybridOptions(400, 3, 0, repeat)); });
  EXPECT_NEAR(samples[1].mean, 1, 1e-11);
  for (std::size_t k = 1; k < edges.size(); ++k) {
    const double size = static_cast<double>(k);
    const double exact = std::pow(end / 2, size - 1) / std::pow(1 + end / 2, size + 1);
    EXPECT_LT(std::abs(samples[3 + k].z(exact)), zLimit) << "size " << k;
  }
}

// The nuclei of soot coagulate and break; the direct simulation has room for all of them.
TEST(Hybrid, HasTheLawOfTheDirectSimulation) {
  const double nucleus = 4e-27, rate = 4e15, end = 1;
  PopulationModel model = coagulation(CollisionKernelType::freeMolecular);
  withNucleation(model, rate, nucleus);
  model.breakage = BreakageOptions{0.1 / nucleus, 1, 2, BreakageOptions::Daughters::uniform};
  const std::vector<double> edges = {0.1 * nucleus, 0.9 * nucleus, 1.5 * nucleus, 2.5 * nucleus,
                                     3.5 * nucleus, 6.5 * nucleus, 15 * nucleus,  50 * nucleus};
  const int repeats = 100;
  const auto direct = test::outcomes(
      [&](std::uint64_t repeat) {
        MonteCarloOptions options = hybridOptions(1000, 0, 2 * rate, static_cast<int>(repeat));
        options.method = MonteCarloMethod::dsmc;
        options.seed = 2;
        return makeMonteCarlo(model, {}, options);
      },
      repeats, end, edges);
  for (const std::size_t threshold : {2u, 8u}) {
    const auto hybrid = test::outcomes(
        [&](std::uint64_t repeat) {
          return make(model, {}, hybridOptions(300, threshold, 0.6 * rate, static_cast<int>(repeat)));
        },
        repeats, end, edges);
    test::expectSameLaw(direct, hybrid);
  }
}

TEST(Hybrid, ContractionAndDoublingLeaveMeansAsTheyAre) {
  PopulationModel model = coagulation(CollisionKernelType::constant);
  withNucleation(model, 1);
  const ConstantKernelAndNucleation exact;
  const double end = 3;
  std::uint64_t removals = 0;
  // Room for too few particles: the sample holds five times as many large ones when it starts to contract.
  const auto crowded = over(300, end, {}, [&](int repeat) {
    auto solver = make(model, {}, hybridOptions(40, 2, 0.15, repeat));
    solver->advance(end);
    removals += solver->counters().removals;
    return make(model, {}, hybridOptions(40, 2, 0.15, repeat));
  });
  EXPECT_GT(removals, 3000u);
  EXPECT_LT(std::abs(crowded[0].z(exact.m0(end))), zLimit);
  EXPECT_LT(std::abs(crowded[1].z(end)), zLimit);
  EXPECT_LT(std::abs(crowded[2].z(exact.m2(end))), zLimit);
  EXPECT_LT(std::abs(crowded[3].z(exact.m3(end))), zLimit);

  const PopulationModel alone = coagulation(CollisionKernelType::constant);
  const InitialPopulation initial{Distribution::monodisperse, 1.0, 1.0, 1};
  const auto doubled =
      over(200, 20, {}, [&](int repeat) { return make(alone, initial, hybridOptions(200, 5, 0, repeat)); });
  EXPECT_LT(std::abs(doubled[0].z(2.0 / 22)), zLimit);
  EXPECT_NEAR(doubled[1].mean, 1, 1e-11);
  EXPECT_LT(std::abs(doubled[2].z(21)), zLimit);
}

TEST(Hybrid, NumbersTakeWhatWouldOverflowTheEnsemble) {
  PopulationModel model = coagulation(CollisionKernelType::constant);
  withNucleation(model, 1);
  const auto solver = make(model, {}, hybridOptions(100, 10, 1e-3));
  solver->advance(0.5);
  const auto& method = methodOf(*solver);
  EXPECT_NEAR(static_cast<double>(solver->counters().nucleations), 0.5 / 1e-5, 1);
  EXPECT_EQ(solver->counters().removals, 0u);
  EXPECT_GT(method.population().countedParticles(), 30000u);
  EXPECT_LE(solver->particles(), 100u);
  // Memory is of the threshold and the capacity, not of the nuclei.
  EXPECT_LT(solver->bytes(), 20000u);
}

// Each of N monomers gains one at the rate c: a Yule process from every particle of one monomer; the mean of M_1 is
// e^(ct), the variance of the total e^(ct) (e^(ct) - 1) / N.
TEST(Hybrid, GrowthByJumpsHasMeanAndVarianceOfTheYuleProcess) {
  PopulationModel model;
  withJumps(model, 1);
  const InitialPopulation initial{Distribution::monodisperse, 1.0, 1.0, 1};
  const double end = 1.5, e = std::exp(end);
  const int repeats = 400;
  const std::size_t count = 50;
  const std::vector<double> edges = {0.5, 1.5, 2.5, 3.5, 4.5, 5.5};
  const auto samples =
      over(repeats, end, edges, [&](int repeat) { return make(model, initial, hybridOptions(count, 3, 0, repeat)); });
  EXPECT_NEAR(samples[0].mean, 1, 1e-12);
  EXPECT_LT(std::abs(samples[1].z(e)), zLimit);
  const double variance = samples[1].standardError * samples[1].standardError * repeats;
  EXPECT_LT(std::abs(variance / (e * (e - 1) / count) - 1), zLimit * std::sqrt(2.0 / repeats));
  // Geometric: P(k) = e^(-ct) (1 - e^(-ct))^(k-1).
  for (std::size_t k = 1; k < edges.size(); ++k) {
    EXPECT_LT(std::abs(samples[3 + k].z(std::pow(1 - 1 / e, static_cast<double>(k) - 1) / e)), zLimit) << k;
  }
}

// Evaporation by jumps: each of three monomers leaves at the rate c.
TEST(Hybrid, EvaporationByJumpsEmptiesTheSizesInTheRightOrder) {
  PopulationModel model;
  withJumps(model, -1);
  const InitialPopulation initial{Distribution::monodisperse, 1.0, 3.0, 1};
  const double end = 0.7, alive = std::exp(-end);
  const std::vector<double> edges = {0.5, 1.5, 2.5, 3.5};
  const auto samples =
      over(300, end, edges, [&](int repeat) { return make(model, initial, hybridOptions(100, 1, 0, repeat)); });
  EXPECT_LT(std::abs(samples[4].z(3 * alive * (1 - alive) * (1 - alive))), zLimit);
  EXPECT_LT(std::abs(samples[5].z(3 * alive * alive * (1 - alive))), zLimit);
  EXPECT_LT(std::abs(samples[6].z(alive * alive * alive)), zLimit);
}

TEST(Hybrid, BreakageReturnsPiecesToTheNumbers) {
  PopulationModel model;
  model.breakage = BreakageOptions{1, 1, 2, BreakageOptions::Daughters::equal};
  model.nucleation.emplace();
  model.nucleation->volume = 0.125;
  const InitialPopulation initial{Distribution::monodisperse, 1.0, 1.0, 1};
  // 1 is 8 units and a particle, 1/2 and 1/4 are numbers, 1/16 is half a unit and a particle again.
  const std::vector<double> edges = {0.7, 1.5};
  const auto samples =
      over(200, 1, edges, [&](int repeat) { return make(model, initial, hybridOptions(100, 4, 0, repeat)); });
  EXPECT_LT(std::abs(samples[0].z(2)), zLimit);
  EXPECT_LT(std::abs(samples[4].z(std::exp(-1))), zLimit);
  EXPECT_NEAR(samples[1].mean, 1, 1e-11);
}

TEST(Hybrid, DepositionTakesFromNumbersAndParticles) {
  PopulationModel model;
  model.deposition = DepositionOptions{0.5, 0};
  withNucleation(model, 2);
  const InitialPopulation initial{Distribution::exponential, 1.0, 5.0, 1};
  const auto samples =
      over(100, 2, {}, [&](int repeat) { return make(model, initial, hybridOptions(200, 4, 0, repeat)); });
  EXPECT_LT(std::abs(samples[0].z(std::exp(-1) + 4 * (1 - std::exp(-1)))), zLimit);
}

// Multiplicative kernel from equal particles: M2 = 1 / (1 - t), a gel at t = 1.
TEST(Hybrid, StopsWhereThePopulationGels) {
  const PopulationModel model = coagulation(CollisionKernelType::multiplicative);
  const InitialPopulation initial{Distribution::monodisperse, 1.0, 1.0, 1};
  const auto before =
      over(100, 0.3, {}, [&](int repeat) { return make(model, initial, hybridOptions(1000, 2, 0, repeat)); });
  EXPECT_LT(std::abs(before[0].z(0.85)), zLimit);
  EXPECT_LT(std::abs(before[2].z(1 / 0.7)), zLimit);
  std::vector<double> times;
  for (int repeat = 0; repeat < 20; ++repeat) {
    try {
      make(model, initial, hybridOptions(2000, 2, 0, repeat))->advance(3);
      ADD_FAILURE() << "no gel";
    } catch (const GelationError& error) {
      times.push_back(error.time());
    }
  }
  // The transition is O(N^(-1/3)) wide.
  EXPECT_NEAR(summarise(times).mean, 1, 2 * std::pow(2000.0, -1.0 / 3));
}

// In the transition regime the majorant is tuned to the population as it grows: same means as the direct simulation.
TEST(Hybrid, HasTheLawOfTheDirectSimulationInTheTransitionRegime) {
  PopulationModel model = coagulation(CollisionKernelType::transition);
  CarrierGas& gas = model.coagulation->gas;
  gas = {1800, 1e6, 2, 6e-5, 0.028};
  const double nucleus = 1e-23, rate = 1e15, end = 1;
  withNucleation(model, rate, nucleus);
  const auto direct = test::outcomes(
      [&](std::uint64_t repeat) {
        MonteCarloOptions options = hybridOptions(1000, 0, 2 * rate, static_cast<int>(repeat));
        options.method = MonteCarloMethod::dsmc;
        options.seed = 2;
        return makeMonteCarlo(model, {}, options);
      },
      60, end, {});
  const auto hybrid = test::outcomes(
      [&](std::uint64_t repeat) {
        return make(model, {}, hybridOptions(300, 5, 0.6 * rate, static_cast<int>(repeat)));
      },
      60, end, {});
  test::expectSameLaw(direct, hybrid);
  EXPECT_LT(hybrid[0].mean, 0.8 * rate);  // there is coagulation to speak of
}

TEST(Hybrid, WrongInputIsAClearError) {
  PopulationModel model = coagulation(CollisionKernelType::constant);
  withNucleation(model, 1);
  const auto message = [&](const MonteCarloOptions& options, const InitialPopulation& initial = {}) -> std::string {
    try {
      (void)make(model, initial, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(message(hybridOptions(100, 3, 1)), "none");
  EXPECT_THAT(message(hybridOptions(100, 0, 1)), testing::HasSubstr("threshold"));
  withJumps(model, 1, 0.3);
  EXPECT_THAT(message(hybridOptions(100, 3, 1)), testing::HasSubstr("whole number"));
  withJumps(model, 1, 0.25);
  EXPECT_EQ(message(hybridOptions(100, 3, 1)), "none");
  model.growth.treatment = GrowthOptions::Treatment::split;
  EXPECT_THAT(message(hybridOptions(100, 3, 1)), testing::HasSubstr("jumps"));
  model.growth = {};
  model.nucleation.reset();
  EXPECT_THAT(message(hybridOptions(100, 3, 1), {Distribution::exponential, 1.0, 1.0, 1}), testing::HasSubstr("unit"));
}

}  // namespace
}  // namespace lampblack::particles
