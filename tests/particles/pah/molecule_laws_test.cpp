// Laws of the jump process against closed forms and master equations (exponentials of the generator over all molecules
// of a number of rings, made by another program: docs/theory/pah.md). Repeats have 3.3 standard errors.
#include <gtest/gtest.h>

#include <map>

#include "core/running_mean.hpp"
#include "tests/effort.hpp"
#include "tests/particles/pah/pah_fixtures.hpp"

namespace lampblack::particles {
namespace {

using test::manyEvents, test::named, test::only, test::rateOf, test::referenceRates;

constexpr double bound = 3.3;  // standard errors

// Standard errors of a count from what is expected.
double score(std::size_t count, std::size_t repeats, double expected) {
  const auto n = static_cast<double>(repeats);
  return (static_cast<double>(count) - n * expected) / std::sqrt(n * expected * (1 - expected));
}

Molecule grownTo(const char* start, const PahRates& rates, double time, std::uint64_t repeat,
                 std::size_t mostRings = MoleculeGrowth::noLimit) {
  MoleculeGrowth growth(named(start), RandomStream(20240601, repeat, 0), mostRings);
  (void)growth.advance(rates, time, manyEvents);
  return growth.molecule();
}

// Four zigzags that know nothing of each other.
TEST(MoleculeLaws, RingsOfFiveOnPyreneAreBinomial) {
  for (const double temperature : {1500.0, 2100.0}) {
    PahRates rates = only(referenceRates(temperature), {PahProcess::G5R_ZZ, PahProcess::D5R_R5});
    const double a = rateOf(rates, PahProcess::G5R_ZZ), b = rateOf(rates, PahProcess::D5R_R5);
    for (const double tau : {0.1, 1.0, 10.0}) {
      const double q = a / (a + b) * (1 - std::exp(-tau));
      constexpr std::size_t repeats = 4000;
      std::array<std::size_t, 5> found{};
      for (std::size_t r = 0; r < repeats; ++r) ++found[grownTo("pyrene", rates, tau / (a + b), r).fiveRings()];
      for (std::size_t j = 0; j < 5; ++j) {
        const double choose[] = {1, 4, 6, 4, 1}, rest = static_cast<double>(4 - j);
        const double p = choose[j] * std::pow(q, static_cast<double>(j)) * std::pow(1 - q, rest);
        if (repeats * p < 10) continue;
        EXPECT_LT(std::abs(score(found[j], repeats, p)), bound) << temperature << " " << tau << " " << j;
      }
    }
  }
}

// Three armchairs that fill one by one.
TEST(MoleculeLaws, TriphenyleneGrowsToCoronene) {
  PahRates rates{};
  rateOf(rates, PahProcess::G6R_AC) = 1;
  for (const double time : {0.5, 2.0}) {
    constexpr std::size_t repeats = 4000;
    std::size_t full = 0;
    RunningMean carbon;
    for (std::size_t r = 0; r < repeats; ++r) {
      const Molecule molecule = grownTo("triphenylene", rates, time, r);
      full += molecule.carbon() == 24 ? 1U : 0U;
      carbon.add(static_cast<double>(molecule.carbon()));
    }
    const double u = 1 - std::exp(-time);
    EXPECT_LT(std::abs(score(full, repeats, u * u * u)), bound) << time;
    EXPECT_NEAR(carbon.mean(), 18 + 6 * u, bound * carbon.standardError()) << time;
  }
}

// Rings that are missing from coronene form independent sets of a hexagon.
TEST(MoleculeLaws, CoroneneThatLosesAndGrowsIsAHardCoreGas) {
  for (const double z : {0.1, 1.0, 10.0}) {
    PahRates rates{};
    rateOf(rates, PahProcess::G6R_AC) = 1;
    rateOf(rates, PahProcess::D6R_FE_AC) = z;
    const double exact = 24 - 2 * (6 * z + 18 * z * z + 6 * z * z * z) / (1 + 6 * z + 9 * z * z + 2 * z * z * z);
    constexpr std::size_t repeats = 4000;
    RunningMean carbon;
    // The slowest of the five kinds of molecules forgets within a few times 1/(1 + z).
    for (std::size_t r = 0; r < repeats; ++r)
      carbon.add(static_cast<double>(grownTo("coronene", rates, 20, r).carbon()));
    EXPECT_NEAR(carbon.mean(), exact, bound * carbon.standardError()) << z;
  }
}

struct MasterEquation {
  const char* start;
  double temperature, H, C2H2;
  bool all;  // eleven processes, or the first five
  std::size_t mostRings;
  double time, left, carbon, hydrogen, sixRings, fiveRings;
  std::map<std::size_t, double> ringNumber;  // probability of so many rings
};

const MasterEquation masterEquations[] = {{"pyrene",
                                           1500,
                                           0.01,
                                           0.1,
                                           false,
                                           9,
                                           5e-6,
                                           3.815529e-04,
                                           18.18044145,
                                           11.03193915,
                                           4.57425115,
                                           0,
                                           {{4, 0.61121019}, {5, 0.24981409}, {6, 0.10165728}, {7, 0.02838533}}},
                                          {"phenanthrene",
                                           2100,
                                           0.01,
                                           0.001,
                                           false,
                                           8,
                                           2e-4,
                                           6.447430e-05,
                                           6.37818505,
                                           6.16628588,
                                           1.10594959,
                                           0,
                                           {{1, 0.94239689}, {2, 0.03510327}, {4, 0.01823772}}},
                                          {"naphthalene",
                                           1800,
                                           0.001,
                                           0.1,
                                           false,
                                           8,
                                           5e-5,
                                           2.701723e-02,
                                           16.07966626,
                                           10.80692214,
                                           3.63637206,
                                           0,
                                           {{1, 0.09529521}, {2, 0.20332868}, {3, 0.20236166}, {4, 0.18829791}}},
                                          {"pyrene",
                                           1500,
                                           0.01,
                                           0.1,
                                           true,
                                           7,
                                           5e-6,
                                           1.311775e-02,
                                           18.32999742,
                                           10.93821240,
                                           4.51672391,
                                           0.17916860,
                                           {{4, 0.50457845}, {5, 0.31677591}, {6, 0.12659145}}},
                                          {"naphthalene",
                                           2100,
                                           0.01,
                                           0.001,
                                           true,
                                           6,
                                           1e-3,
                                           2.360062e-04,
                                           6.17724658,
                                           6.08587446,
                                           1.04520852,
                                           0.00047754,
                                           {{1, 0.96029020}, {2, 0.03574942}, {4, 0.00213921}}}};

TEST(MoleculeLaws, RunsHaveTheProbabilitiesOfTheMasterEquations) {
  constexpr std::size_t repeats = 20000;
  for (const MasterEquation& exact : masterEquations) {
    PahRates rates = referenceRates(exact.temperature, exact.H, 0.1, exact.C2H2);
    if (!exact.all)
      for (std::size_t p = 5; p < pahProcessCount; ++p) rates[p] = 0;
    RunningMean carbon, hydrogen, six, five;
    std::size_t left = 0;
    std::map<std::size_t, std::size_t> rings;
    for (std::size_t r = 0; r < repeats; ++r) {
      const Molecule molecule = grownTo(exact.start, rates, exact.time, r, exact.mostRings);
      if (molecule.rings() > exact.mostRings) {
        ++left;
        continue;
      }
      carbon.add(static_cast<double>(molecule.carbon()));
      hydrogen.add(static_cast<double>(molecule.hydrogen()));
      six.add(static_cast<double>(molecule.sixRings()));
      five.add(static_cast<double>(molecule.fiveRings()));
      ++rings[molecule.rings()];
    }
    std::string scores;
    const auto compare = [&](const std::string& what, double z) {
      EXPECT_LT(std::abs(z), bound) << exact.start << " " << exact.temperature << ": " << what;
      scores += what + " " + std::to_string(z) + ", ";
    };
    const auto compareMean = [&](const char* what, const RunningMean& mean, double value) {
      if (mean.standardError() > 0) compare(what, (mean.mean() - value) / mean.standardError());
    };
    compareMean("C", carbon, exact.carbon);
    compareMean("H", hydrogen, exact.hydrogen);
    compareMean("six-rings", six, exact.sixRings);
    // Where there are few rings of five, their number is as Poisson's and the scatter of a sample says little.
    if (exact.fiveRings * static_cast<double>(repeats) > 30) compareMean("five-rings", five, exact.fiveRings);
    for (const auto& [number, p] : exact.ringNumber)
      compare(std::to_string(number) + " rings", score(rings[number], repeats, p));
    if (exact.left * static_cast<double>(repeats) > 10) compare("left", score(left, repeats, exact.left));
    if (lampblack::test::isLongRun())
      std::printf("%s, %g K, %s: %s\n", exact.start, exact.temperature, exact.all ? "eleven" : "five", scores.c_str());
  }
}

}  // namespace
}  // namespace lampblack::particles
