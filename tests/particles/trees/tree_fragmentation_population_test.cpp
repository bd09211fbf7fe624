// Populations of trees of soot that break at their necks: their rates, and their numbers in time.
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "particles/models/sectional/sectional_soot.hpp"
#include "particles/soot/soot_medium.hpp"
#include "particles/trees/packed_tree.hpp"
#include "tests/particles/statistics.hpp"
#include "tests/particles/trees/tree_fragmentation_fixtures.hpp"

namespace lampblack::test {
namespace {

// OH alone, whose attack does not depend on the sizes of particles.
struct Burning : FlameGas {
  Burning() : FlameGas(1800, 0, 0, 1e-3, 0.1, 0, 0, {0, 0, 0}) {}
};

double oxidationOf(const TreeOptions& options, const FlameGas& gas) {
  const DimerModel dimers(options.material.soot()->soot);
  const SootFluxes flux = SootMedium(options.material.soot()->soot, dimers, gas.state, true).fluxes();
  EXPECT_EQ(flux.O2, 0);
  return flux.OH;
}

// Equal rows, as a population that is full or has room.
std::unique_ptr<TreePopulation> rows(TreeOptions options, std::size_t primaries, std::size_t count, double number,
                                     bool isFull = true, const TreeUnits& each = unitsOfEach) {
  auto trees = std::make_unique<TreePopulation>(options);
  const PrimaryTrees type(options.material, options.size);
  const Tree row = chain(type, primaries, each);
  std::vector<double> packed;
  for (std::size_t k = 0; k < count; ++k) packTree(row, number / static_cast<double>(count), options.material, packed);
  // A sample of that weight is there already.
  trees->fill(unitsOfEach, number * static_cast<double>(options.particles) / static_cast<double>(count));
  std::vector<double> state = trees->pack();
  state.resize(treeRows.head);
  if (!isFull) state.back() = 0;
  state.insert(state.end(), packed.begin(), packed.end());
  trees->unpack(state);
  (void)trees->takeExchange();
  return trees;
}

TEST(FragmentationOfTrees, RatesOfAPopulationAreThoseOfSections) {
  TreeOptions options = breakingSoot(1e5);
  options.particles = 64;
  SectionalSootOptions sectional;
  sectional.soot = options.material.soot()->soot;
  sectional.fragmentation = {true, 1e5};
  const SectionalSoot sections(sectional);
  constexpr std::size_t section = 18;
  const double atoms = sections.pivots()[section] * constants::avogadro / sectional.soot.carbonWeight;
  const FlameGas byBoth(1800, 1e-3, 0.03, 1e-3, 0.1, 0.01, 0, {0, 0, 0});  // O2 by active sites, of the mean particle
  const Burning byOH;
  for (const FlameGas* gas : {static_cast<const FlameGas*>(&byOH), &byBoth})
    for (const std::size_t n : {2U, 9U}) {
      const TreeUnits each{atoms / static_cast<double>(n), 0, 0};
      const double rate = rows(options, n, 32, 1e15, true, each)->rates(gas->state, 0).fragmentations;
      std::vector<double> densities(sections.scalars().size());
      densities[section] = 1e15;
      densities[sections.sections() + section] = 1e15 * static_cast<double>(n);
      EXPECT_NEAR(rate / sections.processes(gas->state, densities).fragmentationNumber, 1, 1e-9);
      if (gas != &byOH) continue;
      const double exact = 1e15 * oxidationOf(options, *gas) * 1e5 * std::pow(static_cast<double>(n), 1 / 1.8);
      EXPECT_NEAR(rate / exact, 1, 1e-9);
    }
}

TEST(FragmentationOfTrees, TheNumberOfAPopulationFollowsTheExactMean) {
  const Burning gas;
  constexpr std::size_t n = 10;
  constexpr double number = 1e15, factor = 1e8;
  TreeOptions options = breakingSoot(factor);
  const double oxidation = oxidationOf(options, gas);
  ASSERT_GT(oxidation, 0);
  const double exposure = 6e-9;  // hardly anything burns in it: 3e-12 m
  options.particles = 1000;
  const double exact = meanNumber(n, exposure, factor);
  ASSERT_GT(exact, 2);
  for (const std::size_t count : {64U, 600U}) {  // with room for all, and with a sample that overflows
    std::vector<double> numbers, booked;
    bool isFull = false;
    for (int repeat = 0; repeat < 40; ++repeat) {
      options.owner = static_cast<std::uint64_t>(repeat);
      const auto trees = rows(options, n, count, number, count == 600U);
      for (int step = 0; step < 3; ++step) trees->advance(gas.state, exposure / oxidation / 3);
      const TreeTotals totals = trees->totals();
      const TreeExchange exchange = trees->takeExchange();
      numbers.push_back(totals.number / number);
      booked.push_back(1 + exchange.fragmentations / number);
      EXPECT_EQ(exchange.burntPrimaries, 0);
      isFull = isFull || trees->counters().removals > 0;
      EXPECT_GT(trees->counters().fragmentations, 0U);
      // As short steps as the number asks for, growth and oxidation having none to speak of.
      EXPECT_GT(static_cast<double>(trees->counters().splitSteps), 0.9 * std::log(exact) / 0.05);
      const auto other = std::make_unique<TreePopulation>(options);
      other->unpack(trees->pack());
      EXPECT_EQ(other->counters().fragmentations, trees->counters().fragmentations);
      if (trees->counters().removals == 0) {
        EXPECT_NEAR(numbers.back(), booked.back(), 1e-9);
        EXPECT_NEAR(totals.primaries, static_cast<double>(n) * number, 1e-9 * static_cast<double>(n) * number);
        EXPECT_EQ(trees->size(), count + trees->counters().fragmentations);
      }
    }
    EXPECT_EQ(isFull, count == 600U);
    for (const auto* sample : {&numbers, &booked}) {
      EXPECT_LT(std::abs(summarise(*sample).z(exact)), zLimit) << summarise(*sample).mean << " and " << exact;
      EXPECT_LT(summarise(*sample).standardError, 0.02 * exact);
    }
  }
}

// Nothing that is drawn changes where nothing can break: to the last bit what it is without the law.
TEST(FragmentationOfTrees, LeavesAllAsItIsWhereNothingBreaks) {
  const FlameGas burning(1700, 1e-3, 0.03, 1e-4, 0.08, 2e-4, 0.03, {2e-5, 3e-6, 2e-6});
  const FlameGas growing(1700, 1e-3, 0.03, 0, 0.08, 0, 0.03, {2e-5, 3e-6, 2e-6});
  const auto after = [](const FlameGas& gas, SootFragmentation law) {
    TreeOptions options = breakingSoot(1e5);
    SootReactions reactions = *options.material.soot();
    reactions.soot.coagulation = true;
    reactions.fragmentation = law;
    options.material.reactions = reactions;
    options.coagulation = true;
    options.particles = 256;
    const auto trees = std::make_unique<TreePopulation>(options);
    for (int step = 0; step < 5; ++step) trees->advance(gas.state, 2e-4);
    EXPECT_GT(trees->totals().largest, 2U);
    return trees->pack();
  };
  EXPECT_EQ(after(burning, {true, 0}), after(burning, {}));
  EXPECT_EQ(after(growing, {true, 1e5}), after(growing, {}));
  EXPECT_NE(after(burning, {true, 1e5}), after(burning, {}));
}

TEST(FragmentationOfTrees, RefusesWhatIsNoFactor) {
  EXPECT_THROW((void)std::make_unique<TreePopulation>(breakingSoot(-1)), InputError);
}

}  // namespace
}  // namespace lampblack::test
