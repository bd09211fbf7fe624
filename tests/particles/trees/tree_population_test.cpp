// Populations of trees: balances and states.
#include "particles/trees/tree_population.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/errors.hpp"
#include "particles/population/monte_carlo/initial_sample.hpp"
#include "particles/population/monte_carlo/shipped_types.hpp"
#include "tests/messages.hpp"
#include "tests/particles/soot_fixtures.hpp"
#include "tests/particles/statistics.hpp"
#include "tests/particles/trees/tree_fixtures.hpp"

namespace lampblack::test {
namespace {

// What the gas gives is what particles gain, unit by unit, and the sample has it as long as nothing is removed from it.
class BooksOfTrees : public testing::TestWithParam<TreeShape> {};
INSTANTIATE_TEST_SUITE_P(Shapes, BooksOfTrees,
                         testing::Values(TreeShape::primaries, TreeShape::surfaceVolume, TreeShape::spheres));

TEST_P(BooksOfTrees, BookEveryUnit) {
  Nitrogen nitrogen;
  nitrogen.concentrations = {2e-6, 1e-6};
  TreeOptions options;
  options.shape = GetParam();
  options.material = silica();
  options.particles = 4096;
  options.fullAt = 1e19;
  const auto trees = std::make_unique<TreePopulation>(options);
  TreeExchange all;
  for (int i = 0; i < 40; ++i) {
    trees->advance(nitrogen.gas(), 5e-4);
    const TreeExchange taken = trees->takeExchange();
    for (std::size_t k = 0; k < 2; ++k) all.gas[k] += taken.gas[k];
    for (std::size_t c = 0; c < 3; ++c) all.units[c] += taken.units[c];
    all.sinteredPairs += taken.sinteredPairs;
  }
  ASSERT_EQ(trees->counters().removals, 0U);
  const TreeTotals totals = trees->totals();
  ASSERT_GT(totals.number, 0);
  if (GetParam() != TreeShape::surfaceVolume) {
    ASSERT_GT(trees->counters().fused, 0U);
  } else {
    EXPECT_EQ(totals.largest, 1U);
    EXPECT_GT(all.sinteredPairs, 0);
  }
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(totals.units[c] / all.units[c], 1, 1e-10);
  // Si, O and H of Si(OH)4 and H2O.
  const double NA = constants::avogadro, precursor = -all.gas[0] * NA, product = all.gas[1] * NA;
  EXPECT_NEAR(all.units[0] / precursor, 1, 1e-12);
  EXPECT_NEAR((all.units[1] + all.units[2]) / (4 * precursor - product), 1, 1e-12);
  EXPECT_NEAR(all.units[2] / (4 * precursor - 2 * product), 1, 1e-11);
}

// Primaries are born and become one with others, also where nothing sinters: small ones that large ones touch, and
// neighbours that grow over their neck. Spheres in space touch at points, and hardly grow over these.
TEST_P(BooksOfTrees, CountEveryPrimary) {
  if (GetParam() == TreeShape::surfaceVolume) GTEST_SKIP() << "these have one each";
  for (const bool sinters : {true, false}) {
    if (!sinters && GetParam() == TreeShape::spheres) continue;
    Nitrogen nitrogen;
    nitrogen.concentrations = {2e-6, 1e-6};
    TreeOptions options;
    options.shape = GetParam();
    options.material = silica();
    if (!sinters) options.material.sintering.mechanism = SinteringMechanism::none;
    options.particles = 4096;
    options.fullAt = 1e19;
    const auto trees = std::make_unique<TreePopulation>(options);
    const std::size_t large = sinters ? 0 : 200;
    if (!sinters)
      trees->fill(std::vector<TreeUnits>(large, spherical(options.material, 40e-9)),
                  options.fullAt * static_cast<double>(large) / static_cast<double>(options.particles));
    for (int i = 0; i < 40; ++i) trees->advance(nitrogen.gas(), 5e-4);
    const TreeCounters counted = trees->counters();
    ASSERT_EQ(counted.removals + counted.doublings, 0U);
    ASSERT_GT(counted.fused, 10U);
    const TreeTotals totals = trees->totals();
    const double primaries = totals.primaries / totals.number * static_cast<double>(trees->size());
    EXPECT_NEAR(primaries + static_cast<double>(counted.fused), static_cast<double>(counted.inceptions + large), 1e-6);
  }
}

std::unique_ptr<TreePopulation> populated(const Nitrogen& nitrogen, const TreeOptions& options) {
  auto trees = std::make_unique<TreePopulation>(options);
  for (int i = 0; i < 10; ++i) trees->advance(nitrogen.gas(), 2e-3);
  return trees;
}

TreeOptions small() {
  TreeOptions options;
  options.material = silica();
  options.material.sintering.critical = 0.6e-9;  // so that there are trees
  options.particles = 300;
  return options;
}

TEST_P(BooksOfTrees, ThatUnpackTheSameGoOnToTheSameBits) {
  Nitrogen nitrogen;
  nitrogen.concentrations = {2e-6, 0};
  TreeOptions options = small();
  options.shape = GetParam();
  const auto first = populated(nitrogen, options);
  const auto second = std::make_unique<TreePopulation>(options);
  second->unpack(first->pack());
  const std::vector<double> packed = first->pack(), again = second->pack();
  EXPECT_EQ(again.size(), packed.size());
  for (std::size_t k = 0; k < treeRows.head; ++k) EXPECT_EQ(again[k], packed[k]) << k;
  EXPECT_EQ(second->totals().units, first->totals().units);
  EXPECT_EQ(second->totals().surface, first->totals().surface);
  ASSERT_GT(first->totals().primaries, 1.1 * first->totals().number);
  const auto third = std::make_unique<TreePopulation>(options);
  third->unpack(first->pack());
  for (TreePopulation* trees : {second.get(), third.get()}) trees->advance(nitrogen.gas(), 2e-3);
  EXPECT_EQ(second->pack(), third->pack());
  std::vector<double> damaged = first->pack();
  damaged.resize(damaged.size() - 3);
  EXPECT_THROW(third->unpack(damaged), InputError);
  std::vector<double> former = packed;
  former[0] -= 1;
  EXPECT_THAT(messageOf<InputError>([&] { third->unpack(former); }), testing::HasSubstr("begin the run anew"));
}

// What is due to be born is thinned with the gas.
TEST(TreePopulation, ThinsBirthsWithTheGas) {
  Nitrogen nitrogen;
  nitrogen.concentrations = {2e-6, 0};
  const auto trees = populated(nitrogen, small());
  const std::vector<double> before = trees->pack();
  trees->dilute(0.5);
  const std::vector<double> after = trees->pack();
  constexpr std::size_t reached = packedOwnerAt + 3, due = reached + 1;
  EXPECT_GT(before[due], 0);
  for (const std::size_t k : {reached, due}) EXPECT_EQ(after[k], 0.5 * before[k]);
}

// Trees come with any weights and stand for as many as before in the mean; each stays what it was.
TEST(TreePopulation, TakesInThoseOfAnother) {
  Nitrogen nitrogen;
  nitrogen.concentrations = {2e-6, 0};
  const auto other = populated(nitrogen, small());
  other->applyDeferred();
  const std::vector<double> packed = other->pack();
  const std::span<const double> rows = treeRows.of(packed);
  EXPECT_EQ(treeRows.count(rows), other->size());
  constexpr double share = 0.37;
  const TreeTotals coming = other->totals();
  std::vector<double> silicon, surface;
  for (std::uint64_t owner = 1; owner <= 60; ++owner) {
    TreeOptions options = small();
    options.owner = owner;
    options.fullAt = 0.8 * coming.number;
    const auto trees = std::make_unique<TreePopulation>(options);
    trees->fill(options.material.sites()->nucleus, 0.5 * coming.number);
    const TreeTotals before = trees->totals();
    trees->join(rows, share);
    const TreeTotals after = trees->totals();
    EXPECT_NEAR((after.number - before.number) / coming.number, share, 1.0 / 300);
    silicon.push_back((after.units[0] - before.units[0]) / coming.units[0]);
    surface.push_back((after.surface - before.surface) / coming.surface);
    EXPECT_LE(after.largest, coming.largest);
  }
  for (const auto* values : {&silicon, &surface}) EXPECT_LT(std::abs(summarise(*values).z(share)), zLimit);
}

// Whatever the clocks of the two say: nothing happens to a tree between them.
TEST(TreePopulation, TakesInTreesThatHaveSinteredUntilNow) {
  Nitrogen nitrogen;
  nitrogen.concentrations = {2e-6, 0};
  const auto other = populated(nitrogen, small());
  other->applyDeferred();
  const double surface = other->totals().surface;
  ASSERT_GT(other->totals().primaries, 1.01 * other->totals().number);
  const std::vector<double> packed = other->pack();
  nitrogen.concentrations = {0, 0};
  TreeOptions options = small();
  options.fullAt = other->totals().number;
  for (const double waited : {0.0, 10.0}) {
    std::vector<double> share;
    for (std::uint64_t owner = 1; owner <= 400; ++owner) {
      options.owner = owner;
      const auto trees = std::make_unique<TreePopulation>(options);
      trees->advance(nitrogen.gas(), waited);
      trees->join(treeRows.of(packed), 1.0);
      const double joined = trees->totals().surface;
      trees->applyDeferred();
      EXPECT_EQ(trees->totals().surface, joined) << waited;
      share.push_back(joined / surface);
    }
    EXPECT_LT(std::abs(summarise(share).z(1)), zLimit);
    EXPECT_LT(summarise(share).standardError, 0.05);
  }
}

// What moves a tree between cells and how large it is there.
TEST(TreePopulation, SaysMassAndSizeInFrontOfARow) {
  Nitrogen nitrogen;
  nitrogen.concentrations = {2e-6, 0};
  const auto trees = populated(nitrogen, small());
  const std::vector<double> packed = trees->pack();
  double mass = 0, surface = 0, number = 0;
  treeRows.forEach(treeRows.of(packed), [&](const double* row) {
    const GivenParticle p = particleAt(row);
    EXPECT_EQ(p.hydrogen, 0);
    EXPECT_GE(p.primaries, 1);
    const double volume = p.carbon / small().material.density;
    mass += p.number * p.carbon;
    // So many equal spheres of that volume have the surface.
    surface += p.number * std::cbrt(36 * constants::pi * p.primaries * volume * volume);
    number += p.number;
  });
  const TreeTotals t = trees->totals();
  EXPECT_NEAR(mass / t.mass, 1, 1e-12);
  EXPECT_NEAR(surface / t.surface, 1, 1e-9);
  EXPECT_NEAR(number / t.number, 1, 1e-12);
}

TEST(TreePopulation, AStepThatIsTakenBackLeavesNoTrace) {
  Nitrogen nitrogen;
  nitrogen.concentrations = {2e-6, 0};
  const auto trees = populated(nitrogen, small());
  const auto saved = trees->save();
  const TreeTotals before = trees->totals();
  trees->advance(nitrogen.gas(), 2e-3);
  const std::vector<double> once = (trees->restore(saved), trees->pack());
  EXPECT_EQ(trees->totals().units, before.units);
  trees->advance(nitrogen.gas(), 2e-3);
  const std::vector<double> then = trees->pack();
  trees->restore(saved);
  trees->advance(nitrogen.gas(), 2e-3);
  EXPECT_EQ(trees->pack(), then);
  EXPECT_NE(once, then);
}

// Rounding over the time into other splitting steps does not change the law: halved steps within the noise.
TEST(TreePopulation, SplittingConverges) {
  Nitrogen nitrogen;
  nitrogen.concentrations = {2e-6, 0};
  std::vector<Sample> primaries, number;
  for (const double tolerance : {0.1, 0.02}) {
    std::vector<double> p, n;
    for (std::uint64_t r = 0; r < 12; ++r) {
      TreeOptions options = small();
      options.splitTolerance = tolerance;
      options.owner = r;
      const auto trees = populated(nitrogen, options);
      const TreeTotals totals = trees->totals();
      p.push_back(totals.primaries / totals.number);
      n.push_back(totals.number);
    }
    primaries.push_back(summarise(p));
    number.push_back(summarise(n));
  }
  for (const auto& pair : {primaries, number})
    EXPECT_LT(std::abs(pair[0].mean - pair[1].mean) / std::hypot(pair[0].standardError, pair[1].standardError), zLimit);
}

// Eqs. 36-39 of the paper written out, and that the majorant is one, whatever the mixture of its two bounds.
TEST(TreePopulation, CollidesByTheKernelOfThePaper) {
  RandomStream random(51, 52, 53);
  TreeOptions options = small();
  options.kernel.gas = Nitrogen().gas();
  CollisionKernel kernel(options.kernel);
  const CarrierGas& gas = options.kernel.gas;
  std::vector<CollisionKernel::Properties> all;
  for (int i = 0; i < 60; ++i) {
    const double d = 0.5e-9 * std::pow(1e3, random.uniform()), dense = 0.2 + 0.8 * random.uniform();
    const double v = constants::pi / 6 * d * d * d * dense;
    all.push_back({v, 2200 * v, d});
  }
  for (const bool isTuned : {false, true}) {
    if (isTuned)
      kernel.tune([&](const auto& f) {
        for (const auto& p : all) f(p);
      });
    for (const auto& p : all) {
      for (const auto& q : all) {
        const auto knudsen = [&](double d) { return 4.74e-5 * gas.temperature / (gas.pressure * d); };
        const double slip =
            2 * constants::boltzmann * gas.temperature / (3 * gas.viscosity) *
            ((1 + 1.257 * knudsen(p.diameter)) / p.diameter + (1 + 1.257 * knudsen(q.diameter)) / q.diameter) *
            (p.diameter + q.diameter);
        const double free = 2.2 * std::sqrt(constants::pi * constants::boltzmann * gas.temperature / 2) *
                            std::sqrt(1 / p.mass + 1 / q.mass) * std::pow(p.diameter + q.diameter, 2);
        EXPECT_NEAR(kernel.value(p, q) / (slip * free / (slip + free)), 1, 1e-12);
        EXPECT_LE(kernel.value(p, q), kernel.majorant(kernel.terms(p), kernel.terms(q)) * (1 + 1e-12));
      }
    }
  }
}

// Spheres of one composition in a distribution of sizes and others all alike: numbers, volumes and units of both.
TEST(TreePopulation, BeginsWithDistributionsOfSizes) {
  const TreeOptions options = small();
  const auto trees = std::make_unique<TreePopulation>(options);
  const TreeUnits dry{1, 2, 0}, wet{300, 500, 200};
  const auto volume = [&](const TreeUnits& units) { return options.material.volume(units); };
  const InitialPopulation wide{InitialPopulation::Distribution::lognormal, 3e15, 500 * volume(dry), 1.3};
  const InitialPopulation table = tabulated({{1e-26, 2e-26, 2e15}, {4e-26, 9e-26, 1e15}});
  for (const InitialPopulation& sizes : {wide, table}) {
    trees->fill(std::vector<TreeStart>{{dry, 0, sizes}, {wet, 1e15}});
    const double spread = meanInitialVolume(sizes) * 3e15, alike = volume(wet) * 1e15;
    const TreeTotals totals = trees->totals();
    EXPECT_NEAR(totals.number / 4e15, 1, 1e-12);
    EXPECT_NEAR(totals.volume / (spread + alike), 1, 1e-12);
    std::map<double, double> found;  // number by the share of component 2
    double least = 1, most = 0;
    trees->forEachTree([&](const Tree& tree, double weight) {
      const TreeUnits& units = tree.head().units;
      found[std::round(1e6 * units[2] / units[1])] += weight;
      if (units[2] != 0) return;
      EXPECT_NEAR(units[1] / units[0], 2, 1e-12);
      least = std::min(least, volume(units));
      most = std::max(most, volume(units));
    });
    ASSERT_EQ(found.size(), 2U);
    EXPECT_NEAR(found[0] / 3e15, 1, 1e-3);
    EXPECT_NEAR(found[4e5] / 1e15, 1, 4e-3) << "a particle more or less";
    EXPECT_GT(most, 2 * least);
  }
  EXPECT_THROW(trees->fill(std::vector<TreeStart>{{wet, 1e15}, {dry, 0}}), InputError);
}

TEST(TreePopulation, WrongOptionsSayWhatIsWrong) {
  TreeOptions options = small();
  options.particles = 4;
  EXPECT_THROW((void)std::make_unique<TreePopulation>(options), InputError);
  options = small();
  options.splitTolerance = 0;
  EXPECT_THROW((void)std::make_unique<TreePopulation>(options), InputError);
  options = small();
  options.material.components[0].weight = -1;
  EXPECT_THROW((void)std::make_unique<TreePopulation>(options), InputError);
  const auto trees = std::make_unique<TreePopulation>(small());
  EXPECT_THROW(trees->fill({0, 0, 0}, 1e10), InputError);
  EXPECT_THROW(trees->fill({1, 1, -1}, 1e10), InputError);
}

}  // namespace
}  // namespace lampblack::test
