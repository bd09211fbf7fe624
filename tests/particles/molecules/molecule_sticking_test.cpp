// Which molecules of a population stick when they meet.
#include "particles/molecules/molecule_sticking.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "tests/particles/molecules/molecules_fixtures.hpp"

namespace lampblack::test {
namespace {

// Few rings do not stick.
TEST(MoleculesThatStick, CollidesAsMoleculesStick) {
  MoleculeOptions o = inert(singlePyrene());
  o.coagulation = true;
  const MoleculeGas gas;
  for (const double rings : {4.0, 5.0}) {
    o.sticking = {.rule = MoleculeSticking::Rule::smaller, .rings = rings};
    MoleculePopulation population(o);
    population.advance(gas.state, 1e-4);
    EXPECT_EQ(population.counters().coagulations > 0, rings == 4);
  }
}

// By a table, at the temperature of the gas: half of the collisions that stick at another.
TEST(MoleculesThatStick, SticksByTemperatureAndSize) {
  MoleculeSticking sticking;
  sticking.rule = MoleculeSticking::Rule::byTable;
  sticking.temperatures = {1000, 2000};
  sticking.carbons = {10, 20, 40};
  sticking.probabilities = {0.2, 0.6, 1, 0, 0.2, 0.8};
  const MoleculeSticking::Partner small{4, 15}, large{10, 30}, huge{30, 100};
  for (const auto& [T, expected] : {std::pair{1000.0, 0.4}, {1500, 0.25}, {2000, 0.1}, {900, 0.4}, {2500, 0.1}}) {
    sticking.setTemperature(T);
    EXPECT_NEAR(sticking.probability(small, large), expected, 1e-14);
    EXPECT_NEAR(sticking.probability(large, small), expected, 1e-14);
  }
  EXPECT_NEAR(sticking.probability(large, huge), 0.5, 1e-14);
  EXPECT_NEAR(sticking.probability(huge, huge), 0.8, 1e-14);
  MoleculeOptions o = inert(singlePyrene());
  o.inception = MoleculeOptions::Inception::pairs;
  o.atStart = 0;
  o.fullAt = 1e16;
  o.sticking = sticking;
  MoleculeOptions always = o;
  always.sticking = {};
  for (const double T : {1000.0, 1500.0}) {
    const MoleculeGas gas(1e-6, T);
    MoleculePopulation some(o), all(always);
    for (MoleculePopulation* one : {&some, &all}) one->advance(gas.state, 1e-7);
    // 16 carbon atoms: 0.44 at 1000 K, 0.12 at 2000 K.
    EXPECT_NEAR(some.takeExchange().inceptions, (T == 1000 ? 0.44 : 0.28) * all.takeExchange().inceptions,
                3 * all.weight());
  }
  // So do particles.
  MoleculeOptions meeting = inert(singlePyrene());
  meeting.coagulation = true;
  meeting.atStart = 1e20;
  meeting.sticking = sticking;
  meeting.sticking.probabilities = {1, 1, 1, 0, 0, 0};
  MoleculePopulation population(meeting);
  population.advance(MoleculeGas(0, 2000).state, 1e-5);
  EXPECT_EQ(population.counters().coagulations, 0u);
  population.advance(MoleculeGas(0, 1000).state, 1e-5);
  EXPECT_GT(population.counters().coagulations, 20u);
  o.sticking.probabilities.pop_back();
  EXPECT_THROW(MoleculePopulation{o}, InputError);
  o.sticking.probabilities.push_back(1.5);
  EXPECT_THROW(MoleculePopulation{o}, InputError);
}

// A large one does not stick to a small one, whichever of the pair it is.
TEST(MoleculesThatStick, UnlikeMoleculesStickByBoth) {
  MoleculeOptions o = inert(singlePyrene());
  o.coagulation = true;
  o.sticking = {.rule = MoleculeSticking::Rule::smaller, .rings = 7};
  MoleculePopulation population(o);
  const auto coronene = population.type().made({std::make_shared<const Molecule>(namedMolecule("coronene"))});
  std::vector<MoleculeParticle> both(o.particles, population.ofGas(1));
  for (std::size_t k = 0; k < 250; ++k) both[k] = coronene;
  population.fill(both, 1e20);
  population.advance(MoleculeGas().state, 1e-5);
  EXPECT_GT(population.counters().coagulations, 20u);
  population.forEach([&](const MoleculeParticle& p, double) {
    if (p.molecules > 1) {
      EXPECT_EQ(p.carbon(), 24.0 * p.molecules);
    }
  });
}

}  // namespace
}  // namespace lampblack::test
