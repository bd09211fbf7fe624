// Trees of soot that oxidation breaks at their necks: what they break into, how often, and where.
#include "particles/trees/tree_fragmentation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "particles/trees/tree_parts.hpp"
#include "tests/particles/statistics.hpp"
#include "tests/particles/trees/tree_fragmentation_fixtures.hpp"

namespace lampblack::test {
namespace {

TEST(FragmentationOfTrees, TheTwoSidesOfANeckKeepAllThereIs) {
  const TreeOptions options = breakingSoot(1e5);
  const PrimaryTrees type(options.material, options.size);
  RandomStream random(91, 92, 93);
  for (int repeat = 0; repeat < 40; ++repeat) {
    // Primaries of different sizes and necks of different levels, by which they are known.
    std::vector<Tree> trees;
    const std::size_t n = 2 + random.below(20);
    for (std::size_t i = 0; i < n; ++i)
      trees.push_back(type.make(TreeUnits{1000 + 10 * static_cast<double>(i), 100 + static_cast<double>(i), 0}));
    joinAtRandom(type, trees, random);
    TreeHead& head = trees[0].own();
    for (std::uint32_t k = 0; k + 1 < n; ++k)
      necksOf(&head)[k].common = commonSurface(necksOf(&head)[k].sphere, 0.2 + 0.6 * random.uniform());
    type.measure(head);
    head.time = 3;
    const Tree whole = trees[0];
    const std::size_t k = random.below(n - 1);
    std::vector<Tree> sides = sidesOfNeck(type, whole, k);
    ASSERT_EQ(sides.size(), 2U);
    std::vector<double> units, necks, unitsBefore, necksBefore;
    for (const Tree& side : sides) {
      expectTree(type, side);
      EXPECT_EQ(side.head().time, 3);
      EXPECT_EQ(side.head().rest, 0);
      for (const TreePrimary& p : side.primaries()) units.insert(units.end(), {p.units[0], p.units[1], p.diameter});
      for (const TreeNeck& neck : side.necks()) {
        necks.push_back(neck.common);
        // Between the same two primaries.
        EXPECT_EQ(neck.sphere, sphereOfNeck(side.primaries().data(), neck));
      }
    }
    for (const TreePrimary& p : whole.primaries())
      unitsBefore.insert(unitsBefore.end(), {p.units[0], p.units[1], p.diameter});
    for (std::size_t other = 0; other + 1 < n; ++other)
      if (other != k) necksBefore.push_back(whole.necks()[other].common);
    for (auto* list : {&units, &necks, &unitsBefore, &necksBefore}) std::sort(list->begin(), list->end());
    EXPECT_EQ(units, unitsBefore);
    EXPECT_EQ(necks, necksBefore);
    // The neck itself: one of its primaries on each side.
    const auto has = [&](const Tree& side, std::uint32_t i) {
      return std::any_of(side.primaries().begin(), side.primaries().end(),
                         [&](const TreePrimary& p) { return p.units == whole.primaries()[i].units; });
    };
    EXPECT_NE(has(sides[0], whole.necks()[k].left), has(sides[0], whole.necks()[k].right));
  }
}

// Over one long time, in which most break several times.
TEST(FragmentationOfTrees, RowsBreakAsOftenAsTheExactMeanSays) {
  constexpr double factor = 2e5, oxidation = 1e-3;
  const TreeOptions options = breakingSoot(factor);
  const PrimaryTrees type(options.material, options.size);
  RandomStream random(94, 95, 96);
  for (const std::size_t n : {2U, 3U, 12U}) {
    const Tree row = chain(type, n);
    for (const double dt : {5e-4, 5e-3}) {
      TreeFragmentation fragmentation(type);
      std::vector<double> numbers;
      for (int repeat = 0; repeat < 4000; ++repeat) {
        Tree tree = row;
        std::vector<Tree> parts;
        const std::uint64_t broken = fragmentation.breakUp(tree, oxidation, dt, random, parts);
        ASSERT_EQ(parts.size(), broken);
        parts.push_back(std::move(tree));
        std::size_t primaries = 0;
        for (const Tree& part : parts) primaries += part.count();
        ASSERT_EQ(primaries, n);
        numbers.push_back(static_cast<double>(parts.size()));
      }
      EXPECT_LT(std::abs(summarise(numbers).z(meanNumber(n, oxidation * dt, factor))), zLimit)
          << n << ' ' << dt << ": " << summarise(numbers).mean;
    }
  }
}

// In proportion to 1 - s.
TEST(FragmentationOfTrees, BreaksWhereContactsAreWeak) {
  const TreeOptions options = breakingSoot(1e5);
  const PrimaryTrees type(options.material, options.size);
  RandomStream random(97, 98, 99);
  Tree row = chain(type, 4);
  TreeHead& head = row.own();
  const double levels[3] = {0.25, 0, 0.75};
  for (int k = 0; k < 3; ++k) necksOf(&head)[k].common = commonSurface(necksOf(&head)[k].sphere, levels[k]);
  type.measure(head);
  TreeFragmentation fragmentation(type);
  // So slow that hardly any breaks twice.
  const double once = 1e-2 / fragmentation.perOxidation(row.head());
  double counts[3] = {}, all = 0;
  for (int repeat = 0; repeat < 200000; ++repeat) {
    Tree tree = row;
    std::vector<Tree> parts;
    if (fragmentation.breakUp(tree, 1, once, random, parts) != 1) continue;
    // The remaining levels tell which broke.
    double left = parts[0].head().levels + tree.head().levels;
    const std::size_t k = left > 0.99 ? 1 : left > 0.5 ? 0 : 2;
    ++counts[k];
    ++all;
  }
  ASSERT_GT(all, 1000);
  for (int k = 0; k < 3; ++k) {
    const double part = (1 - levels[k]) / 2;
    EXPECT_LT(std::abs(counts[k] - part * all), zLimit * std::sqrt(part * (1 - part) * all)) << k;
  }
}

// The law itself: of n_r primaries, none of a sphere or of what has become one.
TEST(FragmentationOfTrees, IsTheLawOfSections) {
  const TreeOptions options = breakingSoot(1e5);
  const PrimaryTrees type(options.material, options.size);
  const TreeFragmentation fragmentation(type);
  EXPECT_EQ(fragmentation.perOxidation(type.make(unitsOfEach).head()), 0);
  EXPECT_NEAR(fragmentation.perOxidation(chain(type, 7).head()) / (1e5 * std::pow(7.0, 1 / 1.8)), 1, 1e-12);
  Tree pair = chain(type, 2);
  TreeHead& head = pair.own();
  necksOf(&head)[0].common = necksOf(&head)[0].sphere;
  type.measure(head);
  EXPECT_LT(fragmentation.perOxidation(head), 1e-9);
  necksOf(&head)[0].common = commonSurface(necksOf(&head)[0].sphere, 0.5);
  type.measure(head);
  const double t = equalPrimaries(head) - 1, value = 1e5 * std::pow(1 + t, 1 / 1.8);
  ASSERT_TRUE(t > 0.1 && t < 0.9);
  EXPECT_NEAR(fragmentation.perOxidation(head) / (value * t * t * (3 - 2 * t)), 1, 1e-12);
}

}  // namespace
}  // namespace lampblack::test
