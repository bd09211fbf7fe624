// Soot as trees of primaries: its limits, and where its atoms go.
#include "particles/trees/tree_soot.hpp"

#include <gtest/gtest.h>

#include "particles/soot/soot_medium.hpp"
#include "particles/trees/tree_population.hpp"
#include "tests/particles/soot_fixtures.hpp"
#include "tests/particles/statistics.hpp"
#include "tests/particles/trees/tree_fixtures.hpp"

namespace lampblack::test {
namespace {

TreeOptions sootTrees(const SootModelOptions& soot, bool breaksUp = true) {
  SootReactions reactions;
  reactions.soot = soot;
  reactions.breaksUp = breaksUp;
  TreeOptions options;
  options.material = sootMaterial(reactions);
  options.particles = 500;
  options.size = CollisionSize::volumeToSurface;
  options.kernel.enhancement = soot.vanDerWaals;
  options.kernel.slip = soot.slip;
  return options;
}

TreeOptions coalescing(const SootModelOptions& soot) {
  TreeOptions options = sootTrees(soot);
  options.material.sintering = {SinteringMechanism::constant, 1e-30, 0, 0};
  return options;
}

// What gas and particles are at the end of a time, over repeats.
struct SootLaw {
  std::vector<double> number, carbon, hydrogen, squared, surface, acetylene, oxygen;
};

void expectSameSoot(const SootLaw& a, const SootLaw& b) {
  for (const auto part : {&SootLaw::number, &SootLaw::carbon, &SootLaw::hydrogen, &SootLaw::squared, &SootLaw::surface,
                          &SootLaw::acetylene, &SootLaw::oxygen}) {
    const Sample first = summarise(a.*part), second = summarise(b.*part);
    const double error = std::hypot(first.standardError, second.standardError);
    EXPECT_LT(std::abs(first.mean - second.mean), zLimit * error) << first.mean << " and " << second.mean;
    EXPECT_LT(error, 0.05 * std::abs(second.mean));  // that there is something to tell apart
  }
}

SootLaw ofTrees(TreeOptions options, const FlameGas& gas, double dt, int repeats) {
  SootLaw law;
  for (int r = 0; r < repeats; ++r) {
    options.owner = static_cast<std::uint64_t>(r);
    const auto trees = std::make_unique<TreePopulation>(options);
    trees->advance(gas.state, dt);
    trees->applyDeferred();
    const TreeTotals t = trees->totals();
    const TreeExchange taken = trees->takeExchange();
    law.number.push_back(t.number);
    law.carbon.push_back(t.units[SootReactions::carbon]);
    law.hydrogen.push_back(t.units[SootReactions::hydrogen]);
    law.squared.push_back(t.massSquared);
    law.surface.push_back(t.surface);
    law.acetylene.push_back(taken.gas[SootSpecies::C2H2]);
    law.oxygen.push_back(taken.gas[SootSpecies::O2]);
    EXPECT_EQ(t.largest, 1U);
  }
  return law;
}

SootLaw ofSpheres(EnsembleOptions options, const FlameGas& gas, double dt, int repeats) {
  SootLaw law;
  const double perCarbon = constants::avogadro / options.soot.carbonWeight;
  const double perHydrogen = constants::avogadro / options.soot.hydrogenWeight;
  for (int r = 0; r < repeats; ++r) {
    options.owner = static_cast<std::uint64_t>(r);
    const auto soot = makeEnsemble(options);
    soot->advance(gas.state, 0, dt);
    const Ensemble::Totals t = soot->totals();
    const EnsembleExchange taken = soot->takeExchange();
    law.number.push_back(t.number);
    law.carbon.push_back(t.carbon * perCarbon);
    law.hydrogen.push_back(t.hydrogen * perHydrogen);
    law.squared.push_back(soot->moment(2) * std::pow(options.soot.sootDensity, 2));
    law.surface.push_back(t.surface);
    law.acetylene.push_back(taken.gas[SootSpecies::C2H2]);
    law.oxygen.push_back(taken.gas[SootSpecies::O2]);
  }
  return law;
}

// All processes of soot at once: particles that coalesce as soon as they touch are the spheres of an Ensemble.
TEST(TreesOfSoot, ThatCoalesceAreTheSpheresOfAnEnsemble) {
  const FlameGas gas(1700, 1e-3, 0.03, 1e-5, 0.08, 2e-4, 0.03, {2e-5, 3e-6, 2e-6});
  constexpr double dt = 2e-3;
  TreeOptions trees = coalescing(threePah());
  trees.splitTolerance = 0.02;
  trees.fullAt = 5e18;
  EnsembleOptions spheres;
  spheres.soot = threePah();
  spheres.particles = trees.particles;
  spheres.growthByEvents = true;
  spheres.splitTolerance = trees.splitTolerance;
  expectSameSoot(ofTrees(trees, gas, dt, 40), ofSpheres(spheres, gas, dt, 40));
}

// The expected events of an aggregate of equal spheres in point contact are those of as many spheres of its
// SootAggregate, whose growth is tested by itself; condensation, which goes with the size of collision, of one sphere.
void expectMeanGrowth(const FlameGas& gas, std::size_t primaries, double dt) {
  const SootModelOptions soot = threePah();
  TreeOptions options = sootTrees(soot);
  options.material.smoothing = 2;
  options.kernel.gas = gas.state;
  const PrimaryTrees type(options.material, options.size);
  const DimerModel dimers(soot);
  const SootMedium medium(soot, dimers, gas.state, true);
  const double atom = medium.carbonAtom();
  RandomStream random(71, primaries, 73);
  const TreeUnits units{20000, 4000, 0};
  Tree tree = type.make(units);
  for (std::size_t i = 1; i < primaries; ++i) tree = type.coagulated(std::move(tree), type.make(units), random);

  // A population of this one tree, in a gas whose rates are then those of the population.
  std::vector<double> change, each;
  const double n = static_cast<double>(primaries);
  TreeSoot::Sums sums;
  TreeSoot reactions(type);
  CollisionKernel kernel(options.kernel);
  reactions.setGas(gas.state, kernel);
  reactions.add(sums, tree.head(), 1e12);
  const SootPopulationLaw law{soot, dimers, nullptr, 1, false, true, 0.01};
  const SootAggregate aggregate(soot.sootDensity, primaries == 1);
  SootAggregate::Particle expected =
      aggregate.make(n * units[0] * atom, n * units[1] * soot.hydrogenWeight / constants::avogadro, n);
  const double before = expected.carbon;
  SootTransfer moved;
  ASSERT_TRUE(medium.grow(aggregate, sootFluxes(law, medium, sums, dt), dt, expected, moved));
  for (int repeat = 0; repeat < 3000; ++repeat) {
    Tree own = tree;
    reactions.begin(sums, dt);
    ASSERT_NE(reactions.grow(own, random), TreeFate::gone);
    change.push_back(own.head().units[0] - n * units[0]);
    each.push_back(own.primaries()[0].units[0] - units[0]);
  }
  const double total = (expected.carbon - before) / atom;
  EXPECT_LT(std::abs(summarise(change).z(total)), zLimit) << summarise(change).mean << " and " << total;
  EXPECT_LT(std::abs(summarise(each).z(total / n)), zLimit);
}

TEST(TreesOfSoot, GrowAndBurnAsTheLawOfSootSays) {
  const FlameGas growing(1700, 1e-3, 0.03, 1e-5, 0.08, 1e-6, 0.03, {0, 0, 0});
  const FlameGas burning(1800, 1e-3, 0.03, 2e-4, 0.1, 0.005, 0, {0, 0, 0});
  const FlameGas condensing(1700, 0, 0, 0, 0, 0, 0, {2e-5, 3e-6, 2e-6});
  for (const FlameGas* gas : {&growing, &burning}) {
    for (const std::size_t primaries : {1U, 5U}) expectMeanGrowth(*gas, primaries, 2e-5);
    expectMeanGrowth(*gas, 3, 1e-6);  // few events
  }
  expectMeanGrowth(condensing, 1, 2e-4);
}

// Sums over trees of one primary are those over spheres, however either adds them up.
TEST(TreesOfSoot, SumsAreThoseOfSpheres) {
  const FlameGas gas(1700, 1e-3, 0.03, 1e-5, 0.08, 2e-4, 0.03, {2e-5, 3e-6, 2e-6});
  const SootModelOptions soot = threePah();
  TreeOptions options = sootTrees(soot);
  options.kernel.gas = gas.state;
  const PrimaryTrees type(options.material, options.size);
  const SootAggregate spheres(soot.sootDensity, true);
  const DimerModel dimers(soot);
  const SootMedium medium(soot, dimers, gas.state, true);
  TreeSoot reactions(type);
  reactions.setGas(gas.state, CollisionKernel(options.kernel));
  SootColumns columns;
  columns.resize(5);
  TreeSoot::Sums sums;
  for (std::size_t k = 0; k < 5; ++k) {
    const TreeUnits units{100 * std::pow(3.0, k), 30, 0};
    const double weight = 1e15 * static_cast<double>(k + 1);
    columns.set(k,
                spheres.make(units[0] * medium.carbonAtom(), units[1] * soot.hydrogenWeight / constants::avogadro, 1),
                weight);
    reactions.add(sums, type.make(units).head(), weight);
  }
  const SootSums expected = sumsOf(columns, spheres, medium);
  for (const auto sum : {&SootSums::number, &SootSums::carbon, &SootSums::hydrogen, &SootSums::primaries,
                         &SootSums::area, &SootSums::diameters, &SootSums::collisions, &SootSums::slopes})
    EXPECT_NEAR(sums.*sum / (expected.*sum), 1, 1e-12);
}

// Primaries that burn away in the middle of a step: what comes after does not happen, and all their atoms are gone.
TEST(TreesOfSoot, NothingHappensToWhatHasBurnt) {
  const FlameGas gas(1800, 0, 0, 5e-3, 0.1, 0.01, 0, {2e-5, 3e-6, 2e-6});
  TreeOptions options = sootTrees(threePah());
  options.kernel.gas = gas.state;
  const PrimaryTrees type(options.material, options.size);
  RandomStream random(81, 82, 83);
  TreeSoot reactions(type);
  reactions.setGas(gas.state, CollisionKernel(options.kernel));
  const TreeUnits units{42, 20, 0};
  for (const double dt : {1e-6, 2e-5}) {  // one by one, and in numbers
    int gone = 0;
    double burntPrimaries = 0;
    for (int repeat = 0; repeat < 300; ++repeat) {
      Tree tree = type.make(units);
      for (int i = 1; i < 6; ++i) tree = type.coagulated(std::move(tree), type.make(units), random);
      TreeSoot::Sums sums;
      reactions.add(sums, tree.head(), 1e12);
      reactions.begin(sums, dt);
      const TreeFate fate = reactions.grow(tree, random);
      TreeUnits left{};
      double primaries = 0;
      const auto count = [&](const Tree& one) {
        for (std::size_t c = 0; c < 2; ++c) left[c] += one.head().units[c];
        primaries += static_cast<double>(one.count());
      };
      for (const Tree& part : reactions.takeFragments()) count(part);
      if (fate != TreeFate::gone) count(tree);
      TreeExchange exchange;
      TreeCounters counters;
      reactions.recordGrowth(1, exchange, counters);
      for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(6 * units[c] + exchange.units[c], left[c], 1e-9);
      EXPECT_EQ(6 - exchange.burntPrimaries, primaries);
      EXPECT_EQ(static_cast<double>(counters.burnt), exchange.burnt) << "what is printed, and what is booked";
      EXPECT_EQ(static_cast<double>(counters.broken), exchange.broken);
      EXPECT_EQ(static_cast<double>(counters.fragmentations), exchange.fragmentations);
      gone += fate == TreeFate::gone;
      burntPrimaries += exchange.burntPrimaries;
    }
    EXPECT_GT(burntPrimaries, 300);
    if (dt > 1e-5) {
      EXPECT_GT(gone, 0);
    }
  }
}

// A primary has its part of the surface.
TEST(TreesOfSoot, EventsHappenToPrimariesByTheirSurface) {
  const FlameGas gas(1700, 1e-3, 0.03, 0, 0.08, 0, 0.03, {0, 0, 0});
  TreeOptions options = sootTrees(threePah());
  options.kernel.gas = gas.state;
  const PrimaryTrees type(options.material, options.size);
  RandomStream random(74, 75, 76);
  const Tree tree = type.coagulated(type.make(TreeUnits{8000, 800, 0}), type.make(TreeUnits{1000, 100, 0}), random);
  TreeSoot::Sums sums;
  TreeSoot reactions(type);
  reactions.setGas(gas.state, CollisionKernel(options.kernel));
  reactions.add(sums, tree.head(), 1e12);
  for (const double dt : {5e-7, 1e-4}) {  // few, and in numbers
    double large = 0, small = 0;
    for (int repeat = 0; repeat < 4000; ++repeat) {
      Tree own = tree;
      reactions.begin(sums, dt);
      (void)reactions.grow(own, random);
      large += 0.5 * (own.primaries()[0].units[0] - 8000);
      small += 0.5 * (own.primaries()[1].units[0] - 1000);
    }
    const double all = large + small;
    ASSERT_GT(all, 1000);
    // Four fifths of the surface; of a binomial number.
    EXPECT_LT(std::abs(large - 0.8 * all), zLimit * std::sqrt(0.16 * all)) << dt;
  }
}

// What the gas gives and gets are the atoms that particles gain and lose, and the sample has them as long as none is
// removed; while trees are born, grow, burn and break.
TEST(TreesOfSoot, BooksEveryAtom) {
  const FlameGas sooting(1700, 1e-3, 0.03, 1e-5, 0.08, 1e-5, 0.03, {2e-5, 3e-6, 2e-6});
  const FlameGas burning(1800, 1e-3, 0, 1e-3, 0.1, 0.02, 0, {0, 0, 0});
  for (const bool breaksUp : {true, false}) {
    TreeOptions options = sootTrees(threePah(), breaksUp);
    if (!breaksUp) {
      SootReactions reactions = *options.material.soot();
      reactions.fragmentation = {true, 1e5};
      options.material.reactions = reactions;
    }
    options.particles = 4096;
    options.fullAt = 4e18;
    const auto trees = std::make_unique<TreePopulation>(options);
    TreeExchange all;
    const auto follow = [&](const FlameGas& gas, double dt, int steps) {
      for (int i = 0; i < steps; ++i) {
        trees->advance(gas.state, dt);
        const TreeExchange taken = trees->takeExchange();
        for (std::size_t k = 0; k < taken.gas.size(); ++k) all.gas[k] += taken.gas[k];
        for (std::size_t c = 0; c < 2; ++c) all.units[c] += taken.units[c];
        for (const TreeEvent& event : treeEvents(options.material)) all.*event.amount += taken.*event.amount;
      }
    };
    const auto expectBooked = [&](double whole) {
      const TreeTotals totals = trees->totals();
      using S = SootSpecies;
      const auto& g = all.gas;
      const double carbon =
          -(2 * g[S::C2H2] + g[S::CO] + 10 * g[S::fixed] + 14 * g[S::fixed + 1] + 16 * g[S::fixed + 2]);
      const double hydrogen = -(2 * g[S::C2H2] + g[S::H] + 2 * g[S::H2] + g[S::OH] + 2 * g[S::H2O] + 8 * g[S::fixed] +
                                10 * g[S::fixed + 1] + 10 * g[S::fixed + 2]);
      const double oxygen = 2 * g[S::O2] + g[S::OH] + g[S::CO] + g[S::H2O];
      EXPECT_NEAR(all.units[0], carbon * constants::avogadro, 1e-11 * whole);
      EXPECT_NEAR(all.units[1], hydrogen * constants::avogadro, 1e-11 * whole);
      EXPECT_NEAR(oxygen * constants::avogadro, 0, 1e-11 * whole);
      for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(totals.units[c], all.units[c], 1e-9 * whole);
      // A neck that breaks makes one particle two, and all others are as many as they were.
      if (!breaksUp) {
        EXPECT_NEAR(totals.number, all.inceptions - all.coagulations - all.burnt + all.fragmentations,
                    1e-9 * all.inceptions);
      }
    };
    follow(sooting, 5e-4, 6);
    const double whole = trees->totals().units[0], number = trees->totals().number;
    ASSERT_GT(trees->totals().largest, 5U);
    expectBooked(whole);
    follow(burning, 1e-5, 30);
    ASSERT_EQ(trees->counters().removals, 0U);
    ASSERT_GT(trees->size(), 0U);
    expectBooked(whole);
    EXPECT_LT(trees->totals().units[0], 0.9 * whole);
    EXPECT_GT(all.burntPrimaries, 0.1 * number);
    follow(burning, 1e-4, 200);
    EXPECT_EQ(trees->size(), 0U);
    EXPECT_EQ(all.broken > 0, breaksUp);
    EXPECT_EQ(all.fragmentations > 0, !breaksUp);
    EXPECT_GT(all.burnt, 0);
    expectBooked(whole);
  }
}

// Without sintering, a particle that loses a primary in the middle becomes two.
TEST(TreesOfSoot, PartsGoOnAsParticles) {
  const FlameGas gas(1800, 0, 0, 2e-3, 0.1, 0, 0, {0, 0, 0});
  SootModelOptions soot = threePah();
  soot.coagulation = false;
  for (const bool breaksUp : {true, false}) {
    TreeOptions options = sootTrees(soot, breaksUp);
    options.coagulation = false;
    options.particles = 256;
    const auto grown = [&] {  // chains of equal primaries
      TreeOptions own = options;
      own.coagulation = true;
      own.material.reactions = [&] {
        SootReactions reactions = *options.material.soot();
        reactions.soot.oxidation = false;
        return reactions;
      }();
      auto trees = std::make_unique<TreePopulation>(own);
      trees->fill({2000, 100, 0}, 1e18);
      trees->advance(gas.state, 2e-3);
      return trees;
    }();
    const double before = grown->totals().number, primaries = grown->totals().primaries;
    ASSERT_GT(primaries, 3 * before);
    const auto trees = std::make_unique<TreePopulation>(options);
    trees->unpack(grown->pack());
    (void)trees->takeExchange();
    double lost = 0, gained = 0, burnt = 0;
    for (int i = 0; i < 4000 && trees->size() + 20 < options.particles; ++i) {
      trees->advance(gas.state, 5e-7);
      const TreeExchange taken = trees->takeExchange();
      lost += taken.burntPrimaries;
      burnt += taken.burnt;
      gained += taken.broken;
    }
    ASSERT_EQ(trees->counters().doublings, grown->counters().doublings);
    ASSERT_EQ(trees->counters().removals, grown->counters().removals);
    ASSERT_GT(lost, 0.05 * primaries);
    EXPECT_NEAR(trees->totals().primaries, primaries - lost, 1e-9 * primaries);
    if (breaksUp)
      EXPECT_GE(trees->totals().number, before - burnt + gained);
    else
      EXPECT_NEAR(trees->totals().number, before - burnt, 1e-9 * before);
    EXPECT_EQ(gained > 0, breaksUp);
  }
}

TEST(TreesOfSoot, GoOnToTheSameBitsFromAPackedState) {
  const FlameGas gas(1700, 1e-3, 0.03, 1e-5, 0.08, 2e-4, 0.03, {2e-5, 3e-6, 2e-6});
  const auto first = std::make_unique<TreePopulation>(sootTrees(threePah()));
  first->advance(gas.state, 1e-3);
  ASSERT_GT(first->totals().largest, 2U);
  const auto second = std::make_unique<TreePopulation>(sootTrees(threePah())),
             third = std::make_unique<TreePopulation>(sootTrees(threePah()));
  for (const auto& trees : {&second, &third}) {
    (*trees)->unpack(first->pack());
    (*trees)->advance(gas.state, 1e-4);
  }
  EXPECT_EQ(second->pack(), third->pack());
}

}  // namespace
}  // namespace lampblack::test
