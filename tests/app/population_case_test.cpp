// What population balance decks become: every choice of every key, and which of them have an exact solution.
#include "app/problems/population/population_case.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/population/comparison/comparison.hpp"
#include "particles/population/exact_solutions/initial_distribution.hpp"
#include "tests/scratch.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::app {
namespace {

const std::string kMonodisperse = "{distribution: monodisperse, number: 1 1/m^3, volume: 1 m^3}";
const std::string kExponential = "{distribution: exponential, number: 1 1/m^3, volume: 1 m^3}";
const std::string kOne = "{one: {type: dsmc, particles: 10}}";

// Lines of a deck with these processes and methods.
std::string deckOf(const std::string& processes, const std::string& methods = kOne,
                   const std::string& initial = kMonodisperse, const std::string& more = "") {
  return fmt::format(
      "problem: population_balance\ninitial: {}\nprocesses: {}\nmethods: {}\ntime: {{end: 1 s}}\nrepeats: 2\n{}\n",
      initial, processes, methods, more);
}

PopulationCase read(const std::string& text) {
  return readPopulationCase(Deck::parse(text, "deck.yaml", {}, populationSchema()));
}

TEST(PopulationCase, EveryKernelIsRead) {
  const std::string gas =
      "gas: {temperature: 300 K, pressure: 1 atm, viscosity: 1.8e-5 Pa s, mean_molecular_weight: 29 g/mol}";
  const std::string initial =
      "{distribution: lognormal, number: 1e6 1/cm^3, diameter: 10 nm, geometric_deviation: 1.5}";
  const auto kernel = [&](const std::string& text, const std::string& more) {
    return read(deckOf("{coagulation: {" + text + "}}", kOne, initial, more)).model.coagulation->type;
  };
  EXPECT_EQ(kernel("kernel: constant, rate: 1e-6 cm^3/s", ""), CollisionKernelType::constant);
  EXPECT_EQ(kernel("kernel: additive, rate: 1 1/s", ""), CollisionKernelType::additive);
  EXPECT_EQ(kernel("kernel: multiplicative, rate: 1 1/(m^3 s)", ""), CollisionKernelType::multiplicative);
  EXPECT_EQ(kernel("kernel: free_molecular, enhancement: 2.2", "gas: {temperature: 300 K}"),
            CollisionKernelType::freeMolecular);
  EXPECT_EQ(kernel("kernel: continuum", gas), CollisionKernelType::continuum);
  EXPECT_EQ(kernel("kernel: transition, efficiency_diameter: 2 nm, efficiency_exponent: 3", gas),
            CollisionKernelType::transition);
  EXPECT_EQ(kernel("kernel: transition_fuchs", gas), CollisionKernelType::transitionFuchs);
  EXPECT_EQ(kernel("kernel: shear, shear_rate: 100 1/s", ""), CollisionKernelType::shear);
  EXPECT_EQ(kernel("kernel: gravitational", gas), CollisionKernelType::gravitational);
}

TEST(PopulationCase, RatesAreInSI) {
  const PopulationCase made = read(
      deckOf("{coagulation: {kernel: constant, rate: 1e-6 cm^3/s}, nucleation: {rate: 1 1/cm^3/s, diameter: 1 nm}, "
             "breakage: {rate: 8 1/s, exponent: 1.5, reference_volume: 4 m^3}, deposition: {rate: 60 1/min}}"));
  EXPECT_DOUBLE_EQ(made.model.coagulation->rate, 1e-12);
  EXPECT_DOUBLE_EQ(made.model.nucleation->rate, 1e6);
  EXPECT_NEAR(made.model.nucleation->volume, 5.235987755982989e-28, 1e-42);
  EXPECT_DOUBLE_EQ(made.model.breakage->rate, 1);  // 8 / 4^1.5
  EXPECT_DOUBLE_EQ(made.model.deposition->rate, 1);
}

TEST(PopulationCase, EverySourceAndTreatmentIsRead) {
  for (const char* nucleation : {"{rate: 1 1/m^3/s, volume: 1 m^3}",
                                 "{source: precursor, rate_constant: 5e-6 1/s, precursor: 1e5 1/m^3, volume: 1}",
                                 "{source: table, times: [0 s, 1 s, 2 s], rates: [0, 1, 0.5], volume: 1 m^3}"})
    EXPECT_NO_THROW(read(deckOf(fmt::format("{{nucleation: {}}}", nucleation)))) << nucleation;
  for (const char* growth :
       {"{}", "{treatment: split, step: 1 ms}", "{treatment: deferred, step: 1 ms, smallest_volume: 1 nm^3}",
        "{treatment: jumps, monomer: 0.1 m^3}"})
    EXPECT_NO_THROW(read(deckOf(fmt::format("{{condensation: {{rate: 1 1/s}}, growth: {}}}", growth)))) << growth;
  for (const char* process :
       {"surface_growth: {rate: 1 nm/s}", "oxidation: {rate: 1 nm/s}", "dilution: {rate: -1 1/s}",
        "deposition: {rate: 1 1/s, exponent: -0.5}", "breakage: {rate: 1 1/s, exponent: 1, daughters: uniform}"})
    EXPECT_NO_THROW(read(deckOf(fmt::format("{{{}}}", process)))) << process;
}

TEST(PopulationCase, EveryMethodIsReadAndMade) {
  const std::string methods = R"(
  a: {type: dsmc, particles: 10, rates: exact}
  b: {type: constant_volume, particles: 10}
  c: {type: constant_number_mass, particles: 10, unbiased_moments: [M0, M1]}
  d: {type: constant_number_number, particles: 10}
  e: {type: mmc, particles: 10, unbiased_moments: []}
  f: {type: wfmc, particles: 10, fraction: constant, fraction_constant: 0.5}
  g: {type: samwfmc, particles: 10, fraction: hyperbolic, fraction_of: weights}
  h: {type: sammc, particles: 10, fraction: exponential, merging: absolute}
  i: {type: sammc, particles: 10, fraction: stepwise, fraction_of: volumes, merging: relative}
  j: {type: swa, particles: 10, weight_transfer: half, mass: mean}
  k: {type: hybrid, particles: 10, threshold: 5}
  l: {type: sectional, sections: 30, smallest: 1 m^3, spacing: 1.5, relative_tolerance: 1e-9}
  m: {type: sectional, sections: 30, smallest: 1 m^3, largest: 1e4 m^3}
  n: {type: qmom, moments: 4, inversion: product_difference}
  o: {type: momic, moments: 4})";
  const PopulationCase made = read(deckOf("{coagulation: {kernel: constant, rate: 1}}", methods));
  ASSERT_EQ(made.methods.size(), 15U);
  const auto monteCarlo = [&](std::size_t m) { return std::get<MonteCarloOptions>(made.methods[m].options); };
  EXPECT_EQ(monteCarlo(0).rates, EventRates::exact);
  EXPECT_EQ(made.methods[2].unbiased, (std::array<bool, 4>{true, true, false, false}));
  EXPECT_FALSE(made.methods[3].conservesMass);
  EXPECT_TRUE(made.methods[2].conservesMass);
  EXPECT_EQ(monteCarlo(5).fractionConstant, 0.5);
  EXPECT_EQ(monteCarlo(6).fractionOf, FractionOf::weights);
  EXPECT_EQ(monteCarlo(7).merging, MergingDifference::absolute);
  EXPECT_EQ(monteCarlo(8).fraction, FractionFunction::stepwise);
  EXPECT_EQ(monteCarlo(9).transfer, WeightTransfer::half);
  EXPECT_EQ(monteCarlo(10).threshold, 5U);
  EXPECT_TRUE(made.methods[11].deterministic());
  EXPECT_EQ(std::get<MomentOptions>(made.methods[13].options).inversion, QuadratureInversion::productDifference);
}

TEST(PopulationCase, AnEmptyStartIsFilledByNuclei) {
  const PopulationCase made =
      read(deckOf("{nucleation: {rate: 1 1/m^3/s, volume: 1 m^3}}",
                  "{one: {type: sammc, particles: 10, expected_number: 1 1/m^3, nucleation: random}}", "{}"));
  EXPECT_EQ(made.initial.distribution, InitialPopulation::Distribution::none);
  EXPECT_EQ(std::get<MonteCarloOptions>(made.methods[0].options).nucleation, NucleationSampling::random);
}

// What a deck's `initial` becomes, with files beside it.
InitialPopulation initialOf(const std::string& initial, const std::string& table = "") {
  const test::ScratchFolder folder;
  if (!table.empty()) static_cast<void>(folder.file("bins.csv", table));
  return readPopulationCase(Deck::parse(deckOf("{coagulation: {kernel: constant, rate: 1}}", kOne, initial),
                                        folder.path() / "deck.yaml", {}, populationSchema()))
      .initial;
}

TEST(PopulationCase, TheStartMayBeAListOfModes) {
  const InitialPopulation two = initialOf(R"(
  - {distribution: lognormal, number: 3200 1/cm^3, diameter: 20 nm, geometric_deviation: 1.45}
  - {distribution: lognormal, number: 2900 1/cm^3, diameter: 116 nm, geometric_deviation: 1.65})");
  ASSERT_EQ(two.modes.size(), 2U);
  EXPECT_DOUBLE_EQ(two.number, 6.1e9);
  EXPECT_DOUBLE_EQ(two.modes[1].geometricDeviation, 1.65);
  // Mean volumes by Hatch and Choate.
  const auto volumes = [](double number, double d, double s) {
    return number * std::acos(-1.0) / 6 * std::pow(d, 3) * std::exp(4.5 * std::pow(std::log(s), 2));
  };
  EXPECT_NEAR(initialMoment(two, 1) / (volumes(3.2e9, 20e-9, 1.45) + volumes(2.9e9, 116e-9, 1.65)), 1, 1e-12);
  const std::string one = "{distribution: exponential, number: 2 1/m^3, volume: 3 m^3}";
  EXPECT_EQ(initialOf("[" + one + "]").distribution, InitialPopulation::Distribution::exponential);
  EXPECT_EQ(initialOf("[{}, " + one + "]").number, 2);
}

TEST(PopulationCase, TheStartMayBeATable) {
  const std::string table = "{distribution: table, file: bins.csv}";
  const double pi6 = std::acos(-1.0) / 6;
  for (const std::string text : {"from [nm],to [nm],number [1/cm^3]\n10,20,1e3\n20,50,200\n",
                                 "# measured\nnumber[1/cm^3],To [nm],From [nm]\r200,50,20\r1e3,20,10\r",
                                 "from,to,number\n1e-8,2e-8,1e9\n2e-8,5e-8,2e8\n",
                                 "from (um),note,to (um),number (1/cm3)\n0.01,a,0.02,1000\n0.02,b,0.05,200\n"}) {
    const InitialPopulation made = initialOf(table, text);
    ASSERT_EQ(made.intervals.size(), 2U) << text;
    EXPECT_NEAR(made.number / 1.2e9, 1, 1e-12) << text;
    EXPECT_NEAR(made.intervals[0].from / (pi6 * 1e-24), 1, 1e-12) << text;
    EXPECT_NEAR(made.intervals[1].to / (pi6 * 1.25e-22), 1, 1e-12) << text;
  }
  EXPECT_NEAR(initialOf(table, "from [nm^3],to [nm^3],number [1/cm^3]\n10,20,1\n").intervals[0].to / 2e-26, 1, 1e-12);
  // Channels of a scanning mobility sizer, 16 a decade: each holds its density times the width of a channel.
  std::string channels = "Dp [nm],dN/dlogDp [1/cm^3]\n", natural = "diameter [nm],dN/dlnd [1/cm^3]\n";
  double number = 0;
  for (int i = 0; i < 33; ++i) {
    const double density = 1e4 * std::exp(-0.5 * std::pow((i - 16) / 5.0, 2));
    channels += fmt::format("{},{}\n", 10 * std::pow(10, i / 16.0), density);
    natural += fmt::format("{},{}\n", 10 * std::pow(10, i / 16.0), density / std::log(10.0));
    number += 1e6 * density / 16;
  }
  for (const std::string& text : {channels, natural}) {
    const InitialPopulation sizer = initialOf(table, text);
    EXPECT_NEAR(sizer.number / number, 1, 1e-12);
    EXPECT_NEAR(initialNumber(sizer, pi6 * 1e-24, pi6 * 1e-18) / (number - 1e6 * 1e4 * std::exp(-5.12) / 16), 1, 1e-9)
        << "but for half of the first and last channel";
  }
  EXPECT_EQ(
      initialOf("[" + table + ", {distribution: monodisperse, number: 1, diameter: 1 nm}]", channels).modes.size(), 2U);
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"from [nm],to [nm],number [1/cm^2]\n1,2,3\n",
            "bins.csv: the column 'number' is in 1/cm^2; expected a number per volume"},
           {"from [s],to [nm],number [1/cm^3]\n1,2,3\n", "the column 'from' is in s; expected a length"},
           {"from [nm],to [nm]\n1,2\n", "expected columns 'from', 'to' and 'number', or"},
           {"d [nm],dN/dlogd,dN/dlnd\n1,2,3\n", "expected columns"},
           {"from,to,number,d,dN/dlogd\n1,2,3,4,5\n", "expected columns"},
           {"d [nm],dN/dlogd [1/cm^3]\n1,2\n", "one has no width"},
           {"d [nm],dN/dlogd [1/cm^3]\n1,2\n1,3\n", "two rows have the same size"},
           {"d [nm],Dp [nm],dN/dlogd [1/cm^3]\n1,1,2\n", "two columns say the same, 'd [nm]' and 'Dp [nm]'"},
           {"from [nm],to [nm],number [1/cm^3]\n", "the table has no rows"},
           {"from [nm],to [nm],number [1/cm^3]\n1,2,3\n2,x,1\n", "line 3: expected a finite number as 'to', found 'x'"},
           {"from [nm],to [nm],number [1/cm^3]\n0,2,3\n", "line 2: expected a size above zero as 'from'"},
           {"from [nm],to [nm],number [1/cm^3]\n1,3,3\n2,4,1\n", "rise without overlap"},
           {"", "there is no such file"}}) {
    try {
      initialOf(table, text);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("initial.file: "), testing::HasSubstr(message)))
          << text;
    }
  }
}

// 10000 particles of one weight miss what one in 200000 holds, and particles of different weights do not.
TEST(PopulationCase, ASampleThatMissesMomentsIsTold) {
  const std::string initial =
      "{distribution: lognormal, number: 1e11 1/m^3, diameter: 50 nm, geometric_deviation: 1.74}";
  const PopulationCase made = read(deckOf("{coagulation: {kernel: constant, rate: 1e-15}}", R"(
  equal: {type: dsmc, particles: 10000}
  same: {type: sammc, particles: 1000, initial_weights: equal}
  weighted: {type: sammc, particles: 1000}
  other: {type: swa, particles: 1000}
  sections: {type: sectional, sections: 100, smallest: 1e-26 m^3, spacing: 1.25})",
                                          initial));
  ASSERT_EQ(made.warnings.size(), 2U);
  EXPECT_THAT(made.warnings[0], testing::MatchesRegex("methods.equal: the 10000 particles .*: M2 0\\.[678][0-9]*, M3 "
                                                      "0\\.[012][0-9]* times .*initial_weights: moments.*"));
  EXPECT_THAT(made.warnings[1], testing::HasSubstr("methods.same: the 1000 particles"));
  const auto expect = [&](std::size_t method, double tolerance) {
    const auto moments = makeSolver(made, made.methods[method], 3)->moments();
    for (const int k : {0, 1, 2, 3})
      EXPECT_NEAR(moments[static_cast<std::size_t>(k)] / initialMoment(made.initial, k), 1, tolerance)
          << method << " M" << k;
  };
  expect(2, 0.01);
  expect(3, 0.01);

  PopulationStatistics statistics;
  MethodStatistics method;
  method.name = "one";
  method.repeats.resize(20);
  FourMoments known{}, error{};
  for (std::size_t k = 0; k < 4; ++k) known[k] = initialMoment(made.initial, static_cast<double>(k));
  for (std::size_t k = 0; k < 4; ++k) error[k] = 0.002 * known[k];
  method.mean = {known};
  method.error = {error};
  statistics.methods = {method};
  EXPECT_TRUE(startsWithoutTruth(made, statistics).empty());
  statistics.methods[0].mean[0][2] *= 1.006;
  EXPECT_TRUE(startsWithoutTruth(made, statistics).empty()) << "within 3.3 errors, and below one per cent";
  statistics.methods[0].mean[0][2] = 0.98 * known[2];
  statistics.methods[0].mean[0][3] = 0.15 * known[3];
  const auto told = startsWithoutTruth(made, statistics);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_THAT(told[0], testing::HasSubstr("of which they are M2 0.98 +- 0.0066, M3 0.15 +- 0.0066;"));
  statistics.methods[0].error[0][3] = 0.5 * known[3];
  EXPECT_THAT(startsWithoutTruth(made, statistics).at(0), testing::Not(testing::HasSubstr("M3")));
}

TEST(PopulationCase, EveryParticleTypeHasItsSolvers) {
  for (const char* particles :
       {"{type: volume, density: 2 g/cm^3}", "{type: fractal, primary_diameter: 1 m, fractal_dimension: 2}",
        "{type: surface_volume, fractal_dimension: 1.8}",
        "{type: components, components: {carbon: {density: 1800, nucleus: 1}, ash: {density: 3000, condensing: 1}}}"}) {
    const PopulationCase made =
        read(deckOf("{coagulation: {kernel: constant, rate: 1}}", "{a: {type: dsmc}, b: {type: sammc}}", kMonodisperse,
                    fmt::format("particles: {}", particles)));
    // The kernel sees no diameter, so that the solution for spheres holds for all of them.
    ASSERT_NE(exactSolution(made), nullptr) << particles;
    const auto solver = makeSolver(made, made.methods[1], 0);
    solver->advance(1);
    EXPECT_NEAR(solver->moments()[1], 1, 1e-11) << particles;
  }
}

TEST(PopulationCase, SurfaceGrowthOfAggregatesHasNoSolutionOfSpheres) {
  const std::string growth = "{surface_growth: {rate: 1 m/s}}";
  EXPECT_EQ(exactSolution(read(deckOf(growth, kOne, kExponential, "particles: {type: surface_volume}"))), nullptr);
}

TEST(PopulationCase, SectionsAndMomentsAreOfSpheres) {
  EXPECT_THROW(read(deckOf("{coagulation: {kernel: constant, rate: 1}}", "{a: {type: qmom}}", kMonodisperse,
                           "particles: {type: surface_volume}")),
               InputError);
}

// The processes of the cases with a closed solution: coagulation from both starts with three kernels, nucleation,
// breakage, both with coagulation, deposition, condensation.
TEST(PopulationCase, ModelsWithAnExactSolutionAreRecognised) {
  for (const std::string& initial : {kMonodisperse, kExponential}) {
    for (const char* processes :
         {"{coagulation: {kernel: constant, rate: 1}}", "{coagulation: {kernel: additive, rate: 1}}",
          "{coagulation: {kernel: multiplicative, rate: 1}}",
          "{nucleation: {source: precursor, rate_constant: 1, precursor: 1, volume: 1}}",
          "{breakage: {rate: 1, exponent: 1, daughters: uniform}}",
          "{coagulation: {kernel: constant, rate: 1}, nucleation: {rate: 1, volume: 1}}",
          "{coagulation: {kernel: constant, rate: 1}, breakage: {rate: 0.25}}", "{deposition: {rate: 1}}",
          "{condensation: {rate: 1}}"}) {
      const PopulationCase made = read(deckOf(processes, kOne, initial));
      EXPECT_NE(exactSolution(made), nullptr) << processes << " from " << initial;
    }
  }
  EXPECT_NE(exactSolution(read(deckOf("{breakage: {rate: 1, exponent: 1}}"))), nullptr);
  EXPECT_NE(exactSolution(read(deckOf("{breakage: {rate: 1, exponent: 1.8, fragments: 12}}"))), nullptr);
  EXPECT_EQ(exactSolution(read(deckOf("{coagulation: {kernel: shear, shear_rate: 1}}"))), nullptr);
}

TEST(PopulationCase, ShippedDecksAreValid) {
  const std::filesystem::path folder = test::sourceFolder / "cases/population_balance";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no decks yet";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".yaml" || entry.path().filename().string().starts_with("study")) continue;
    EXPECT_NO_THROW(readPopulationCase(Deck::load(entry.path(), {}, populationSchema()))) << entry.path();
  }
}

}  // namespace
}  // namespace lampblack::app
