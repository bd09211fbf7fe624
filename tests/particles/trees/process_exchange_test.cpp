// Processes of soot as spheres, of soot and of silica as trees: gas in which one of them has what it needs, and what
// the population takes and gives there is what that process says of itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "particles/ensemble/soot_ensemble.hpp"
#include "particles/trees/tree_ensemble.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/soot_fixtures.hpp"
#include "tests/source_folder.hpp"

namespace lampblack::particles {
namespace {

using Names = std::set<std::string>;

// Advances, and holds what was exchanged against the names of what happened. Returns these, where a gas takes part.
Names namesOfWhatHappens(StochasticPopulation& population, const ParticleGas& gas, double dt) {
  population.advance(gas, dt);
  population.applyDeferred();
  const StochasticPopulation::Exchange exchange = population.takeExchange();
  const auto processes = population.processes();
  const auto amounts = population.amountsOfProcesses();
  EXPECT_EQ(processes.size(), amounts.size());
  Names names;
  std::set<std::size_t> takes, gives;
  for (std::size_t p = 0; p < processes.size(); ++p) {
    const ParticleProcess& process = processes[p];
    if (amounts[p] == 0 || (process.gas.takes.empty() && process.gas.gives.empty())) continue;
    names.insert(process.name);
    takes.insert(process.gas.takes.begin(), process.gas.takes.end());
    gives.insert(process.gas.gives.begin(), process.gas.gives.end());
  }
  for (std::size_t k = 0; k < exchange.gas.size(); ++k) {
    const int sign = (gives.contains(k) ? 1 : 0) - (takes.contains(k) ? 1 : 0);
    EXPECT_EQ(sign, (exchange.gas[k] > 0) - (exchange.gas[k] < 0)) << "species " << k << ": " << exchange.gas[k];
  }
  return names;
}

SootModelOptions sootWithHydrogen() {
  SootModelOptions soot = test::naphthalene();
  soot.coagulation = false;
  return soot;
}

// H makes sites active, and is no part of what is exchanged but by OH.
struct GasesOfOneProcess {
  test::FlameGas pah{1700, 0, 0, 0, 0, 0, 0, {2e-6}}, acetylene{1700, 1e-4, 0, 0, 0, 0, 3e-2, {0}};
  test::FlameGas oxygen{1700, 1e-4, 0, 0, 0, 1e-2, 0, {0}}, hydroxyl{1700, 0, 0, 1e-3, 0, 0, 0, {0}};
};

const Mechanism& mechanismOfSoot() {
  static const Mechanism one = Mechanism::fromFile(test::sourcePath("cases/mechanisms/ethylene_abf2000_101.yaml"));
  return one;
}

TEST(ProcessExchange, OfSootIsWhatEachProcessSays) {
  const GasesOfOneProcess gas;
  EnsembleOptions options;
  options.soot = sootWithHydrogen();
  options.keepsHydrogen = false;
  options.particles = 100;
  SootEnsemble soot(mechanismOfSoot(), options);
  const double mass = 1850 * constants::pi / 6 * std::pow(20e-9, 3);
  soot.ensemble().initialise(test::equalSpheres(100, mass, 0.02, 1e16));
  EXPECT_EQ(namesOfWhatHappens(soot, gas.pah.state, 1e-4), (Names{"nucleation_number", "nucleation", "condensation"}));
  EXPECT_EQ(namesOfWhatHappens(soot, gas.acetylene.state, 1e-3), (Names{"growth"}));
  EXPECT_EQ(namesOfWhatHappens(soot, gas.oxygen.state, 1e-5), (Names{"oxidation_O2"}));
  EXPECT_EQ(namesOfWhatHappens(soot, gas.hydroxyl.state, 1e-5), (Names{"oxidation_OH"}));
}

// More particles than go through at a time, of one to three primaries.
TEST(SootAmounts, OfManyAreThoseOfEachAndComeAlong) {
  EnsembleOptions options;
  options.soot = sootWithHydrogen();
  options.method = EnsembleMethod::pairs;
  options.particles = 200;
  for (const SootShape shape : {SootShape::spheres, SootShape::aggregates}) {
    options.shape = shape;
    SootEnsemble soot(mechanismOfSoot(), options), other(mechanismOfSoot(), options);
    std::vector<GivenParticle> given;
    for (int k = 0; k < 129; ++k)
      given.push_back({1e-21 * (1 + k), 1e-23, shape == SootShape::spheres ? 1.0 : 1.0 + k % 3, 1e12 + 1e10 * k});
    soot.ensemble().initialise(given);
    const std::vector<double> rows = soot.content();
    std::vector<double> each(6), all(6);
    soot.rows().forEach(rows, [&](const double* row) { soot.addAmounts(row, row[packedNumberAt], each); });
    soot.addAmountsOf(rows, all);
    EXPECT_EQ(all, each);
    other.join(rows, 1.0);
    const Ensemble::Totals before = soot.ensemble().totals(), after = other.ensemble().totals();
    EXPECT_NEAR(after.diameters / before.diameters, 1, 1e-12);
    EXPECT_NEAR(after.surface / before.surface, 1, 1e-12);
    EXPECT_NEAR(all[5] / before.diameters, 1, 1e-12);
  }
}

TEST(ProcessExchange, OfTreesOfSootIsWhatEachProcessSays) {
  const GasesOfOneProcess gas;
  SootReactions reactions;
  reactions.soot = sootWithHydrogen();
  reactions.keepsHydrogen = false;
  TreeOptions options;
  options.material = sootMaterial(reactions);
  options.particles = 100;
  options.coagulation = false;
  TreeEnsemble soot(mechanismOfSoot(), options, std::vector<TreeStart>{{{4e5, 8e4}, 1e16}});
  EXPECT_EQ(namesOfWhatHappens(soot, gas.pah.state, 1e-4), (Names{"inceptions", "condensations"}));
  EXPECT_EQ(namesOfWhatHappens(soot, gas.acetylene.state, 1e-3), (Names{"growth_reactions"}));
  EXPECT_EQ(namesOfWhatHappens(soot, gas.oxygen.state, 1e-5), (Names{"oxidations_by_o2"}));
  EXPECT_EQ(namesOfWhatHappens(soot, gas.hydroxyl.state, 1e-5), (Names{"oxidations_by_oh"}));
}

TEST(ProcessExchange, OfSilicaIsWhatEachProcessSays) {
  static const Mechanism mechanism = Mechanism::fromFile(test::sourcePath("cases/mechanisms/silica_teos_29.yaml"));
  TreeOptions options;
  options.material = silica();
  options.particles = 100;
  TreeEnsemble trees(mechanism, options, std::vector<TreeStart>{{{2107, 3960, 398}, 1e17}});
  const CarrierGas carrier{1173, 101325, 0.29, 4.6e-5, 0.028014};
  const std::array<double, 2> some{3e-8, 0}, none{};
  EXPECT_EQ(namesOfWhatHappens(trees, {carrier, some}, 0.02),
            (Names{"inceptions", "surface_reactions", "condensations", "sintered_pairs"}));
  EXPECT_EQ(namesOfWhatHappens(trees, {carrier, none}, 0.02), (Names{"sintered_pairs"}));
  // What was counted has the names of the processes.
  const auto counts = trees.counts();
  for (const char* name : {"inceptions", "coagulations", "surface_reactions", "condensations"}) {
    const auto found = std::ranges::find(counts, name, [](const auto& one) { return one.first; });
    ASSERT_NE(found, counts.end()) << name;
    EXPECT_GT(found->second, 0) << name;
  }
}

}  // namespace
}  // namespace lampblack::particles
