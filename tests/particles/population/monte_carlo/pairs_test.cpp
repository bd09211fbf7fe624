// The parts of the method that draws pairs, and its types of particles.
#include <gtest/gtest.h>

#include <cmath>

#include "../pairs_test_cases.hpp"
#include "core/errors.hpp"
#include "particles/population/monte_carlo/pair_solver.hpp"
#include "same_law.hpp"

namespace lampblack::test {
namespace {

using enum CollisionKernelType;

PairPopulation<Sphere> populationWith(const std::vector<std::pair<double, double>>& volumesAndWeights,
                                      const CollisionKernelOptions& kernel) {
  PairPopulation<Sphere> population(Sphere(1800), kernel);
  for (const auto& [volume, weight] : volumesAndWeights) population.add({volume}, weight);
  return population;
}

double massOf(const PairPopulation<Sphere>& population) {
  double mass = 0;
  population.forEach([&](const auto& entry) { mass += entry.weight * entry.particle.volume; });
  return mass;
}

// Terms that were left for later, through all that changes a population, are those of a population made anew.
TEST(PairPopulation, FindsTheTermsThatItLacks) {
  const auto kernel = *colliding(transition, 0).coagulation;
  auto population = populationWith({}, kernel);
  for (int k = 0; k < 300; ++k) population.add({1e-27 * (1 + k)}, 1 + k);
  population.findTerms();
  population.set(7, {5e-26}, 3);
  population.remove([](std::size_t k) { return k % 5 == 1; });
  population.add({3e-25}, 2);
  population.set(240, {4e-25}, 4);  // the one that was put in
  population.remove([](std::size_t k) { return k == 0; });
  population.add({6e-25}, 2);
  const auto expectTerms = [&](const CollisionKernelOptions& of) {
    population.findTerms();
    const PairKernel one(of);
    for (std::size_t k = 0; k < population.size(); ++k) {
      const auto terms = one.terms(kernelProperties(one.kernel(), population.type(), population.particle(k)));
      const auto& row = population.row(k);
      ASSERT_FLOAT_EQ(row.terms.size, terms.size) << k;
      ASSERT_FLOAT_EQ(row.terms.mobility, terms.mobility) << k;
      ASSERT_FLOAT_EQ(row.terms.inverseMass, terms.inverseMass) << k;
      ASSERT_FLOAT_EQ(row.volume, static_cast<float>(population.volume(k))) << k;
    }
  };
  EXPECT_EQ(population.size(), 241u);
  expectTerms(kernel);
  population.change([](auto& particle, double weight) {
    particle.volume *= 2;
    return weight > 20;
  });
  EXPECT_EQ(population.weight(0), 21);
  EXPECT_EQ(population.volume(0), 2e-27 * 21);
  expectTerms(kernel);
  CollisionKernelOptions hotter = kernel;
  hotter.gas.temperature = 2000;
  population.setKernel(hotter);
  expectTerms(hotter);
  population.clear();
  population.add({1e-26}, 1);
  expectTerms(hotter);
}

TEST(PairRates, AreTheSameOneByOneAndTogether) {
  auto population = populationWith({}, *colliding(transition, 0).coagulation);
  for (int k = 0; k < 40; ++k) population.add({1e-28 * std::pow(1.5, k)}, 1);
  population.findTerms();
  population.kernel().visit([&](const auto& form) {
    const PairRates rate(population.rows(), form);
    PlacesOfPairs i, j;
    for (std::uint32_t k = 0; k < pairsTogether; ++k) {
      i[k] = 5 * k;
      j[k] = 39 - 3 * k;
    }
    std::array<double, pairsTogether> rates;
    rate(i, j, rates);
    for (std::size_t k = 0; k < pairsTogether; ++k) {
      EXPECT_EQ(rates[k], rate(i[k], j[k])) << k;
      EXPECT_NEAR(rates[k] / population.rateOf(i[k], j[k]), 1, 1e-6) << k;
    }
  });
}

// One that stands for 1000 of volume 1 and one that stands for 0.001 of volume 1e6, with K = A (u + v): the rare one
// takes up many of the others at once in a candidate; neither meets its like. The rare one grows as exp(A M1 t).
TEST(PairSampling, TakesManyPartnersAtOnce) {
  const auto kernel = *colliding(additive, 1e-10).coagulation;
  std::vector<double> volume, number;
  std::uint64_t candidates = 0;
  for (std::uint64_t repeat = 0; repeat < 2000; ++repeat) {
    RandomStream random(36, repeat, 1);
    auto population = populationWith({{1, 1000}, {1e6, 1e-3}}, kernel);
    PairSampling<Sphere> sampling(0.2);
    PopulationCounters counters;
    sampling.advance(population, 2000, random, counters);
    EXPECT_NEAR(massOf(population), 2000, 1e-11 * 2000);
    volume.push_back(std::max(population.volume(0), population.volume(1)) - 1e6);
    number.push_back(population.number());
    candidates += counters.coagulations + counters.fictitious;
  }
  const Sample taken = summarise(volume);
  EXPECT_LT(std::abs(taken.z(1e6 * std::expm1(2e-4))), zLimit) << taken.mean;
  EXPECT_LT(candidates / 2000, 20u);  // far fewer than the 200 that are taken up
  const Sample left = summarise(number);
  EXPECT_LT(std::abs(left.z(1000.001 - 1e3 * std::expm1(2e-4))), zLimit) << left.mean;
}

// Three equal ones and K = A: dM2/dt = A M1^2, from the state that each candidate leaves, with pairs of a particle and
// itself. All 29 candidates meet these three.
TEST(PairSampling, TakesEachCandidateFromWhatTheOneBeforeLeft) {
  const auto kernel = *colliding(constant, 1).coagulation;
  std::vector<double> second;
  RandomStream random(36, 0, 1);
  PopulationCounters counters;
  for (int repeat = 0; repeat < 20000; ++repeat) {
    auto population = populationWith({{1, 1}, {1, 1}, {1, 1}}, kernel);
    PairSampling<Sphere>(0.2).advance(population, 1, random, counters);
    double sum = 0;
    population.forEach([&](const auto& entry) { sum += entry.weight * std::pow(entry.particle.volume, 2); });
    second.push_back(sum);
  }
  EXPECT_EQ(counters.coagulations + counters.fictitious, 29u * 20000u);
  const Sample sample = summarise(second);
  EXPECT_LT(std::abs(sample.z(12)), zLimit) << sample.mean;
}

// The mean of a candidate does not depend on how often candidates are drawn.
TEST(PairSampling, GivesTheSameMeansForAnyProbability) {
  const PopulationModel model = colliding(freeMolecular, 0);
  const auto initial = startOf(Distribution::monodisperse, 1e18, 5e-28);
  const auto samples = [&](double probability, std::uint64_t seed) {
    return outcomes(
        [&](std::uint64_t repeat) {
          auto options = pairsOf(400, repeat);
          options.pairProbability = probability;
          options.seed = seed;
          return makeMonteCarlo(model, initial, options);
        },
        400, 5e-4, {1e-28, 1.2e-27, 5e-27, 2e-26});
  };
  const auto fine = samples(0.04, 11);
  expectSameLaw(samples(0.2, 12), fine);
  expectSameLaw(samples(0.5, 13), fine);
}

TEST(PairSampling, FewPairsAreAboveTheProbability) {
  const PopulationModel model = colliding(freeMolecular, 0);
  const auto solver = makeMonteCarlo(model, startOf(Distribution::monodisperse, 1e18, 5e-28), pairsOf(2000));
  solver->advance(5e-3);
  const PopulationCounters& counters = solver->counters();
  EXPECT_GT(counters.coagulations, 2000u);
  EXPECT_LT(static_cast<double>(counters.limited), 0.005 * static_cast<double>(counters.fictitious));
  // And it does not pay with draws of pairs that hardly ever happen.
  EXPECT_LT(static_cast<double>(counters.fictitious), 25 * static_cast<double>(counters.coagulations));
}

TEST(PairMerging, MergesTheNearestAndKeepsNumberAndMass) {
  const auto kernel = *colliding(constant, 1).coagulation;
  auto population = populationWith({{8, 1}, {1, 1}, {4.01, 1}, {2, 1}, {4, 1}, {2.02, 3}, {1, 2}}, kernel);
  const double mass = massOf(population), number = population.number();
  PairMerging<Sphere> merging;
  EXPECT_EQ(merging.mergeDownTo(5, 100, population), 2u);
  EXPECT_EQ(population.size(), 5u);
  EXPECT_NEAR(massOf(population), mass, 1e-14 * mass);
  EXPECT_NEAR(population.number(), number, 1e-14 * number);
  std::vector<std::pair<double, double>> left;
  population.forEach([&](const auto& entry) { left.emplace_back(entry.particle.volume, entry.weight); });
  std::sort(left.begin(), left.end());
  const std::vector<std::pair<double, double>> expected{{1, 3}, {2, 1}, {2.02, 3}, {4.005, 2}, {8, 1}};
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(left[k].first, expected[k].first, 1e-14);
    EXPECT_EQ(left[k].second, expected[k].second);
  }
  // Not those that would stand for too many.
  EXPECT_EQ(merging.mergeDownTo(4, 3, population), 1u);
  double largest = 0;
  population.forEach([&](const auto& entry) { largest = std::max(largest, entry.weight); });
  EXPECT_EQ(largest, 3);
  EXPECT_EQ(merging.mergeDownTo(1, 1, population), 3u);
  EXPECT_NEAR(population.volume(0), mass / number, 1e-13);
}

// Of two that differ by less than the order by size tells (three parts in 1e5) the larger one may stand first.
TEST(PairMerging, MergesThoseThatAreNearlyAlikeInEitherOrder) {
  const auto kernel = *colliding(constant, 1).coagulation;
  for (const double first : {1.0, 1.000002}) {
    auto population = populationWith({{first, 1}, {2.000002 - first, 1}, {2, 1}}, kernel);
    EXPECT_EQ(PairMerging<Sphere>().mergeDownTo(2, 100, population), 1u);
    EXPECT_NEAR(population.volume(0), 1.000001, 1e-14);
    EXPECT_EQ(population.volume(1), 2);
  }
}

// Pairs far from one another, of which each loses four times as much as the next or all the same: as many are merged as
// are too many, those first that lose least.
TEST(PairMerging, MergesAsManyAsAreTooManyWhateverTheyLose) {
  const auto kernel = *colliding(constant, 1).coagulation;
  constexpr int pairs = 12;
  for (const bool isAlike : {false, true})
    for (int merged = 1; merged <= pairs; ++merged) {
      std::vector<std::pair<double, double>> all;
      for (int k = 0; k < pairs; ++k) {
        const double volume = std::ldexp(1.0, 3 * k);
        all.push_back({volume, 1});
        all.push_back({volume * (1 + std::ldexp(1.0, -3 - (isAlike ? 4 : k))), 1});
      }
      auto population = populationWith(all, kernel);
      PairMerging<Sphere> merging;
      EXPECT_EQ(merging.mergeDownTo(static_cast<std::size_t>(2 * pairs - merged), 100, population),
                static_cast<std::size_t>(merged));
      if (isAlike) continue;
      int nearest = 0;
      population.forEach([&](const auto& entry) {
        if (entry.weight == 2 && entry.particle.volume > std::ldexp(1.0, 3 * (pairs - merged))) ++nearest;
      });
      EXPECT_EQ(nearest, merged);
    }
}

// What stands for little beside its neighbour goes before nearer ones of equal numbers.
TEST(PairMerging, LooksAtWhatEachStandsFor) {
  const auto kernel = *colliding(constant, 1).coagulation;
  auto population = populationWith({{2, 100}, {1.1, 1}, {2.3, 1}, {1, 1}}, kernel);
  PairMerging<Sphere> merging;
  EXPECT_EQ(merging.mergeDownTo(3, 1000, population), 1u);
  double smallest = 3;
  population.forEach([&](const auto& entry) { smallest = std::min(smallest, entry.particle.volume); });
  EXPECT_EQ(smallest, 1);
}

TEST(PairMerging, HalvesTheHeaviest) {
  const auto kernel = *colliding(constant, 1).coagulation;
  auto population = populationWith({{1, 8}, {2, 6}, {3, 1}}, kernel);
  PairMerging<Sphere> merging;
  EXPECT_EQ(merging.halveUpTo(5, population), 2u);
  std::vector<double> weights;
  population.forEach([&](const auto& entry) { weights.push_back(entry.weight); });
  std::sort(weights.begin(), weights.end());
  EXPECT_EQ(weights, (std::vector<double>{1, 3, 3, 4, 4}));
}

// Particles that burn: those that vanish are made up for by halving.
TEST(Pairs, AreReplacedWhereTheyVanish) {
  PopulationModel model = colliding(freeMolecular, 0);
  model.growth.oxidation = 1e-6;
  model.growth.smallestVolume = 5e-29;
  const auto solver = makeMonteCarlo(model, startOf(Distribution::exponential, 1e17, 2e-27), pairsOf(400));
  solver->advance(7e-4);
  EXPECT_GT(solver->counters().vanished, 50u);
  EXPECT_GT(solver->counters().copies, 50u);
  EXPECT_GE(solver->particles(), 350u);
}

TEST(Pairs, AreTheSameForTheSameSeed) {
  PopulationModel model = colliding(freeMolecular, 0);
  model.nucleation.emplace();
  model.nucleation->rate = 1e22;
  model.nucleation->volume = 5e-28;
  const auto run = [&](std::uint64_t repeat) {
    const auto solver = makeMonteCarlo(model, {}, pairsOf(100, repeat));
    solver->advance(1e-3);
    return solver->moments();
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
}

// Against the direct simulation with many particles, for types of more than volume, with nucleation and growth.
template <class Type>
void expectLawOfDirectSimulation(const Type& type) {
  PopulationModel model = colliding(transition, 0);
  model.nucleation.emplace();
  model.nucleation->rate = 1e22;
  model.nucleation->volume = 5e-28;
  model.growth.surfaceGrowth = 1e-6;
  model.growth.step = 5e-6;  // with the methods' own the least bin is 2 to 3 % apart (docs/verification.md)
  model.dilution = 200;
  const std::vector<double> edges{1e-28, 1e-27, 1e-26, 1e-25, 1e-24};
  const auto pairs = outcomes(
      [&](std::uint64_t repeat) { return makeMonteCarlo(type, model, InitialPopulation{}, pairsOf(500, repeat)); }, 20,
      5e-4, edges);
  const auto direct = outcomes(
      [&](std::uint64_t repeat) {
        MonteCarloOptions options = pairsOf(1000, repeat);
        options.method = MonteCarloMethod::dsmc;
        options.seed = 37;
        options.expectedNumber = 1.5e18;
        return makeMonteCarlo(type, model, InitialPopulation{}, options);
      },
      20, 5e-4, edges);
  expectSameLaw(pairs, direct);
}

TEST(Pairs, HaveTheLawOfDirectSimulationForSpheres) {
  expectLawOfDirectSimulation(Sphere(1800));
}
TEST(Pairs, HaveTheLawOfDirectSimulationForFractals) {
  expectLawOfDirectSimulation(FractalAggregate(1800, 2e-9));
}
TEST(Pairs, HaveTheLawOfDirectSimulationForAggregates) {
  expectLawOfDirectSimulation(SurfaceVolume(1800));
}
TEST(Pairs, HaveTheLawOfDirectSimulationForComponents) {
  const std::vector<double> densities{1800, 3000}, nucleus{1, 0.5}, condensing{0, 1};
  expectLawOfDirectSimulation(Components(densities, nucleus, condensing));
}

// Surface and components are conserved by collisions and merging.
TEST(Pairs, KeepEveryComponent) {
  PopulationModel model = colliding(freeMolecular, 0);
  const std::vector<double> densities{1800, 3000}, nucleus{1, 0.5}, condensing{0, 1};
  const Components type(densities, nucleus, condensing);
  model.breakage = BreakageOptions{500, 0, 2, BreakageOptions::Daughters::uniform};
  PairProcess<Components> process(type, model, startOf(Distribution::exponential, 1e18, 5e-28), pairsOf(100));
  const auto masses = [&] {
    std::array<double, 2> sum{};
    process.forEachParticle([&](const auto& particle, double weight) {
      for (std::size_t k = 0; k < 2; ++k) sum[k] += weight * particle.mass[k];
    });
    return sum;
  };
  const auto before = masses();
  process.advance(1e-3);
  const auto after = masses();
  EXPECT_GT(process.counters().merges, 10u);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(after[k] / before[k], 1, 1e-12);
}

TEST(Pairs, SayWhatTheyCannotDo) {
  const auto initial = startOf(Distribution::monodisperse);
  const PopulationModel model = colliding(constant, 1);
  const auto refused = [&](const PopulationModel& asked, const MonteCarloOptions& options) {
    EXPECT_THROW((void)makeMonteCarlo(asked, initial, options), InputError);
  };
  auto options = pairsOf(1);
  refused(model, options);
  options = pairsOf(10);
  options.rates = EventRates::exact;
  refused(model, options);
  options = pairsOf(10);
  options.fraction = FractionFunction::hyperbolic;
  refused(model, options);
  for (const double probability : {0.0, 1.1}) {
    options = pairsOf(10);
    options.pairProbability = probability;
    refused(model, options);
  }
  options = pairsOf(10);
  options.splitChange = 0;
  refused(model, options);
  PopulationModel growing = model;
  growing.growth.condensation = 1;
  growing.growth.monomer = 0.1;
  for (const auto treatment : {GrowthOptions::Treatment::jumps, GrowthOptions::Treatment::deferred}) {
    growing.growth.treatment = treatment;
    growing.growth.smallestVolume = 0.01;
    refused(growing, pairsOf(10));
  }
}

}  // namespace
}  // namespace lampblack::test
