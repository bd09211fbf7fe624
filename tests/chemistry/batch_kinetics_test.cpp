#include "chemistry/kinetics/batch_kinetics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "chemistry/kinetics/kinetics.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "tests/chemistry/kinetics_rate_types.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using Instructions = BatchKinetics::Instructions;
using lampblack::test::measured;
using lampblack::test::raise;
using lampblack::test::RateTypes;
using lampblack::test::shipped;
using lampblack::test::Table;

std::vector<Instructions> availableInstructions() {
  std::vector<Instructions> result;
  for (const auto i : {Instructions::Generic, Instructions::Avx2, Instructions::Avx512})
    if (BatchKinetics::available(i)) result.push_back(i);
  return result;
}

// States in the layout of a batch.
struct Batch {
  std::size_t numSpecies = 0;
  std::vector<double> T, c;

  std::size_t size() const { return T.size(); }
  std::vector<double> concentrations(std::size_t i) const {
    std::vector<double> result(numSpecies);
    for (std::size_t k = 0; k < numSpecies; ++k) result[k] = c[k * size() + i];
    return result;
  }
};

Batch batchOf(std::size_t numSpecies, const std::vector<double>& T, const std::vector<std::vector<double>>& c) {
  Batch batch{numSpecies, T, std::vector<double>(numSpecies * T.size())};
  for (std::size_t i = 0; i < T.size(); ++i)
    for (std::size_t k = 0; k < numSpecies; ++k) batch.c[k * T.size() + i] = c[i][k];
  return batch;
}

// 200 to 4000 K, 1e-6 to 100 bar, mole fractions from 1 to 1e-12, every third of them zero in a third of the states.
Batch anyStates(std::size_t numSpecies, std::size_t count) {
  std::mt19937 random(20);
  std::uniform_real_distribution<double> uniform;
  std::vector<double> T;
  std::vector<std::vector<double>> c;
  for (std::size_t i = 0; i < count; ++i) {
    T.push_back(i < 2 ? 200.0 + 3800.0 * static_cast<double>(i) : 200.0 * std::pow(20.0, uniform(random)));
    std::vector<double> X(numSpecies);
    double sum = 0;
    for (double& x : X) {
      x = i % 3 == 0 && random() % 3 == 0 ? 0.0 : std::pow(10.0, -12.0 * uniform(random));
      sum += x;
    }
    const double p = std::pow(10.0, -1.0 + 8.0 * uniform(random));
    for (double& x : X) x *= p / (constants::gasConstant * T.back() * sum);
    c.push_back(X);
  }
  return batchOf(numSpecies, T, c);
}

std::vector<double> rates(BatchKinetics& kinetics, const Batch& batch) {
  std::vector<double> wdot(batch.c.size(), -1.0);
  kinetics.netProductionRates(batch.T, batch.c, wdot);
  return wdot;
}

// The largest difference from Kinetics, of the largest rate at which one reaction makes or takes the species.
double differenceFromKinetics(const Mechanism& mechanism, const Batch& batch, Instructions instructions) {
  Kinetics kinetics(mechanism);
  BatchKinetics batchKinetics(mechanism, instructions);
  const auto wdot = rates(batchKinetics, batch);
  const std::size_t n = mechanism.numSpecies(), reactions = mechanism.numReactions();
  std::vector<double> reference(n), forward(reactions), reverse(reactions), gross(n);
  double worst = 0;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const auto c = batch.concentrations(i);
    kinetics.netProductionRates(batch.T[i], c, reference);
    kinetics.ratesOfProgress(batch.T[i], c, forward, reverse);
    std::fill(gross.begin(), gross.end(), 0.0);
    for (std::size_t r = 0; r < reactions; ++r)
      for (const auto& term : kinetics.netStoichiometry(r))
        gross[term.species] = std::max(
            gross[term.species], std::abs(term.coefficient) * std::max(std::abs(forward[r]), std::abs(reverse[r])));
    for (std::size_t k = 0; k < n; ++k) {
      const double difference = wdot[k * batch.size() + i] - reference[k];
      // Where every exponential of a species is out of a double's range, the ends of the range remain.
      if (gross[k] < 1e-250) {
        EXPECT_LT(std::abs(difference), 1e-250);
        continue;
      }
      EXPECT_LE(std::abs(difference), 1e-12 * gross[k])
          << BatchKinetics::name(instructions) << ", " << mechanism.speciesName(k) << " at " << batch.T[i] << " K";
      raise(worst, difference / gross[k]);
    }
  }
  return worst;
}

class BatchKineticsOfMechanism : public ::testing::TestWithParam<const char*> {};

TEST_P(BatchKineticsOfMechanism, AgreesWithKineticsAtAnyState) {
  const auto mechanism = shipped(GetParam());
  const auto states = anyStates(mechanism.numSpecies(), 61);
  for (const auto instructions : availableInstructions())
    measured(BatchKinetics::name(instructions), differenceFromKinetics(mechanism, states, instructions));
}

INSTANTIATE_TEST_SUITE_P(Shipped, BatchKineticsOfMechanism,
                         ::testing::Values("hydrogen_h2o2_10", "methane_gri30_53", "ethylene_bisetti2012_47",
                                           "ethylene_narayanaswamy2010_158", "ethylene_km2_202", "silica_teos_29"),
                         [](const auto& name) { return std::string(name.param); });

TEST(BatchKinetics, AgreesWithKineticsForEveryRateType) {
  const auto mechanism = RateTypes::mechanism();
  auto states = anyStates(mechanism.numSpecies(), 200);
  // The ends of the tabulated pressures, and beyond.
  for (const double p : {1e2, 1e4, 1e5, 3e5, 1e6, 1e7, 1e9})
    for (const double T : {300.0, 1000.0, 2500.0}) {
      const auto i = static_cast<std::size_t>(std::log10(p)) * 3 + static_cast<std::size_t>(T / 1000);
      double sum = 0;
      for (const double x : states.concentrations(i)) sum += x;
      for (std::size_t k = 0; k < states.numSpecies; ++k)
        states.c[k * states.size() + i] *= p / (constants::gasConstant * T * sum);
      states.T[i] = T;
    }
  for (const auto instructions : availableInstructions())
    measured(BatchKinetics::name(instructions), differenceFromKinetics(mechanism, states, instructions));
}

// Every other species by nine coefficients in three ranges that do not meet: which one holds at a bound matters.
TEST(BatchKinetics, AgreesWithKineticsForNasa9) {
  const auto& base = lampblack::test::hydrogen();
  std::vector<Element> elements;
  for (std::size_t i = 0; i < base.numElements(); ++i) elements.push_back({base.elementName(i), base.atomicWeight(i)});
  std::vector<Species> species(base.allSpecies().begin(), base.allSpecies().end());
  for (std::size_t k = 0; k < species.size(); k += 2) {
    const auto range = [&](const std::array<double, 7>& a, double cold) {
      return std::array<double, 9>{cold * 3e3, cold * -50, a[0], a[1], a[2], a[3], a[4], a[5], a[6]};
    };
    const auto& thermo = species[k].thermo;
    species[k].nasa9 =
        Nasa9{{200, 700, 1000, 6000}, {range(thermo.low, 1.0), range(thermo.low, -0.5), range(thermo.high, 0.7)}};
  }
  const Mechanism mechanism("nasa9", "", elements, species, {base.reactions().begin(), base.reactions().end()});
  auto states = anyStates(mechanism.numSpecies(), 40);
  for (const std::size_t i : {4, 5, 6}) states.T[i] = i == 5 ? 1000.0 : 700.0;
  for (const auto instructions : availableInstructions())
    measured(BatchKinetics::name(instructions), differenceFromKinetics(mechanism, states, instructions));
}

// Mass action is followed through zero, as by Kinetics; an empty gas does nothing.
TEST(BatchKinetics, AgreesWithKineticsBelowZeroAndInVacuum) {
  const auto mechanism = RateTypes::mechanism();
  auto states = anyStates(mechanism.numSpecies(), 24);
  for (std::size_t i = 0; i < states.c.size(); i += 7) states.c[i] *= -1e-6;
  for (std::size_t k = 0; k < states.numSpecies; ++k) states.c[k * states.size() + 5] = 0.0;
  for (const auto instructions : availableInstructions())
    measured(BatchKinetics::name(instructions), differenceFromKinetics(mechanism, states, instructions));
}

TEST(BatchKinetics, AgreesWithCantera) {
  const auto mechanism = shipped("methane_gri30_53");
  const Table states("kinetics_gri30_states.csv"), species("kinetics_gri30_species.csv");
  const std::size_t n = mechanism.numSpecies();
  std::vector<double> T;
  std::vector<std::vector<double>> c;
  for (std::size_t i = 0; i < states.size(); ++i) {
    T.push_back(states.number(i, "T"));
    c.push_back(states.moleFractions(i, mechanism));
    for (double& x : c.back()) x *= states.number(i, "p") / (constants::gasConstant * T.back());
  }
  for (const auto instructions : availableInstructions()) {
    BatchKinetics kinetics(mechanism, instructions);
    const auto wdot = rates(kinetics, batchOf(n, T, c));
    double worst = 0;
    for (std::size_t i = 0; i < T.size(); ++i)
      for (std::size_t k = 0; k < n; ++k) {
        const std::size_t row = i * n + k;
        const double gross = 1e3 * std::max(species.number(row, "creation"), species.number(row, "destruction"));
        const double difference = wdot[k * T.size() + i] - 1e3 * species.number(row, "net");
        EXPECT_LE(std::abs(difference), 1e-10 * gross) << mechanism.speciesName(k) << " at " << T[i] << " K";
        if (gross > 0) raise(worst, difference / gross);
      }
    measured(BatchKinetics::name(instructions), worst);
  }
}

// To the last bit: each state alone, in batches of every size up to three blocks, at every place of a block, between
// hot and cold neighbours.
TEST(BatchKinetics, AStateDoesNotKnowItsBatch) {
  for (const auto& mechanism : {RateTypes::mechanism(), shipped("methane_gri30_53")})
    for (const auto instructions : availableInstructions()) {
      BatchKinetics kinetics(mechanism, instructions);
      const std::size_t n = mechanism.numSpecies();
      const auto states = anyStates(n, 3 * BatchKinetics::blockSize);
      std::vector<std::vector<double>> alone;
      for (std::size_t i = 0; i < states.size(); ++i)
        alone.push_back(rates(kinetics, batchOf(n, {states.T[i]}, {states.concentrations(i)})));
      for (std::size_t size = 1; size <= states.size(); ++size)
        for (std::size_t shift = 0; shift < states.size(); shift += 5) {
          std::vector<double> T;
          std::vector<std::vector<double>> c;
          for (std::size_t i = 0; i < size; ++i) {
            T.push_back(states.T[(i + shift) % states.size()]);
            c.push_back(states.concentrations((i + shift) % states.size()));
          }
          const auto wdot = rates(kinetics, batchOf(n, T, c));
          for (std::size_t i = 0; i < size; ++i)
            for (std::size_t k = 0; k < n; ++k)
              ASSERT_EQ(wdot[k * size + i], alone[(i + shift) % states.size()][k])
                  << BatchKinetics::name(instructions) << ", state " << i << " of " << size;
        }
    }
}

TEST(BatchKinetics, TouchesNothingBetweenTheRows) {
  const auto& mechanism = lampblack::test::hydrogen();
  const std::size_t n = mechanism.numSpecies(), count = 11, stride = 17;
  const auto states = anyStates(n, count);
  for (const auto instructions : availableInstructions()) {
    BatchKinetics kinetics(mechanism, instructions);
    const auto expected = rates(kinetics, states);
    const std::size_t needed = (n - 1) * stride + count;
    std::vector<double> c(needed, std::nan("")), wdot(needed, 12345.0);
    for (std::size_t k = 0; k < n; ++k) std::copy_n(states.c.begin() + k * count, count, c.begin() + k * stride);
    kinetics.netProductionRates(states.T, c, wdot, stride);
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = 0; i < stride && k * stride + i < needed; ++i)
        EXPECT_EQ(wdot[k * stride + i], i < count ? expected[k * count + i] : 12345.0) << k << ", " << i;
  }
}

TEST(BatchKinetics, ATemperatureThatIsNoNumberHasNoRates) {
  const auto& mechanism = lampblack::test::hydrogen();
  auto states = anyStates(mechanism.numSpecies(), 10);
  for (const auto instructions : availableInstructions()) {
    BatchKinetics kinetics(mechanism, instructions);
    const auto expected = rates(kinetics, states);
    auto broken = states;
    broken.T[3] = std::nan("");
    broken.T[9] = INFINITY;
    const auto wdot = rates(kinetics, broken);
    for (std::size_t k = 0; k < states.numSpecies; ++k)
      for (std::size_t i = 0; i < states.size(); ++i) {
        const std::size_t at = k * states.size() + i;
        if (i == 3 || i == 9)
          EXPECT_TRUE(std::isnan(wdot[at])) << k;
        else
          EXPECT_EQ(wdot[at], expected[at]);
      }
  }
}

TEST(BatchKinetics, WantsArraysThatHoldTheBatch) {
  const auto& mechanism = lampblack::test::hydrogen();
  BatchKinetics kinetics(mechanism);
  const std::size_t n = mechanism.numSpecies();
  const std::vector<double> T(3, 1000.0), c(3 * n, 1.0);
  std::vector<double> wdot(3 * n), small(3 * n - 1);
  EXPECT_NO_THROW(kinetics.netProductionRates(T, c, wdot));
  EXPECT_NO_THROW(kinetics.netProductionRates({}, {}, {}));
  EXPECT_THROW(kinetics.netProductionRates(T, c, small), std::invalid_argument);
  EXPECT_THROW(kinetics.netProductionRates(T, small, wdot), std::invalid_argument);
  EXPECT_THROW(kinetics.netProductionRates(T, c, wdot, 2), std::invalid_argument);
  EXPECT_THROW(kinetics.netProductionRates(T, c, wdot, 4), std::invalid_argument);
}

TEST(BatchKinetics, RefusesWhatKineticsRefuses) {
  auto reaction = RateTypes::pressureLog();
  reaction.pressureRates = {{1e5, {1e5, 0, 0}}, {1e5, {-1, 1.5, 0}}};  // 1e5 = T^1.5 at 2154 K
  const auto mechanism = RateTypes::withOnly(reaction);
  const std::size_t n = mechanism.numSpecies();
  std::vector<double> c(2 * n, 1.0), wdot(2 * n);
  EXPECT_THROW(Kinetics{mechanism}, InputError);
  EXPECT_THROW(BatchKinetics{mechanism}, InputError);
  // Positive where it is checked at construction, negative between 3000 and 4000 K.
  reaction.pressureRates[1].rate.A = -0.5;  // 1e5 = 0.5 T^1.5 at 3420 K
  const auto later = RateTypes::withOnly(reaction);
  for (const auto instructions : availableInstructions()) {
    BatchKinetics kinetics(later, instructions);
    EXPECT_NO_THROW(kinetics.netProductionRates(std::vector{3400.0, 1000.0}, c, wdot));
    EXPECT_THROW(kinetics.netProductionRates(std::vector{1000.0, 3500.0}, c, wdot), NumericsError);
  }
}

TEST(BatchKinetics, OffersTheBestAvailableInstructions) {
  EXPECT_TRUE(BatchKinetics::available(Instructions::Generic));
  EXPECT_EQ(BatchKinetics::best(), availableInstructions().back());
  for (const auto i : {Instructions::Avx2, Instructions::Avx512}) {
    const auto construct = [i] { BatchKinetics kinetics(lampblack::test::hydrogen(), i); };
    if (BatchKinetics::available(i)) {
      EXPECT_NO_THROW(construct());
    } else {
      EXPECT_THROW(construct(), InputError);
    }
  }
}

}  // namespace
