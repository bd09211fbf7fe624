// Trees whose primaries grow, shrink and burn away.
#include "particles/trees/tree_burning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "particles/trees/tree_rounding.hpp"
#include "tests/particles/trees/tree_fixtures.hpp"

namespace lampblack::test {
namespace {

class BurntTrees : public testing::Test {
 protected:
  const PrimaryTrees type{silica(), CollisionSize::volumeToSurface};
  RandomStream random{61, 62, 63};

  // Of primaries that are all of different sizes, by which they are known, joined in any order, with necks of any
  // level.
  Tree randomTree(std::size_t count) {
    std::vector<Tree> trees;
    for (std::size_t i = 0; i < count; ++i)
      trees.push_back(type.make(spherical(type.material(), 2e-9 + 1e-11 * static_cast<double>(i))));
    joinAtRandom(type, trees, random);
    Tree tree = std::move(trees[0]);
    TreeHead& head = tree.own();
    for (std::uint32_t k = 0; k + 1 < head.count; ++k) {
      TreeNeck& neck = necksOf(&head)[k];
      neck.common =
          std::min(commonSurface(neck.sphere, 0.9 * random.uniform()), touchingSurface(primariesOf(&head), neck));
    }
    type.measure(head);
    return tree;
  }
  std::size_t burn(Tree& tree, double part) {
    TreeHead& head = tree.own();
    std::size_t burnt = 0;
    for (std::uint32_t i = 0; i < head.count; ++i) {
      if (random.uniform() > part) continue;
      primariesOf(&head)[i] = {};
      ++burnt;
    }
    return burnt;
  }
};

// Necks by the sizes of their two primaries (0.01 nm), the smaller first.
using Contacts = std::map<std::pair<long, long>, double>;

Contacts contacts(const Tree& tree) {
  Contacts all;
  for (const TreeNeck& neck : tree.necks()) {
    const double l = tree.primaries()[neck.left].diameter, r = tree.primaries()[neck.right].diameter;
    if (l > 0 && r > 0) all[std::minmax(std::lround(1e11 * l), std::lround(1e11 * r))] = neck.common;
  }
  return all;
}

TEST_F(BurntTrees, BreakIntoThePartsThatStillHangTogether) {
  int broken = 0;
  for (int repeat = 0; repeat < 60; ++repeat) {
    Tree tree = randomTree(2 + random.below(25));
    const std::size_t burnt = burn(tree, 0.2);
    if (burnt == tree.count()) continue;
    const std::vector<Tree> parts = partsAroundBurnt(type, tree);
    std::size_t count = 0;
    Contacts left;
    for (const Tree& part : parts) {
      expectTree(type, part);  // hangs together, and no primary of it is burnt
      count += part.count();
      for (const TreePrimary& primary : part.primaries()) EXPECT_GT(primary.diameter, 0);
      left.merge(contacts(part));
    }
    EXPECT_EQ(count, tree.count() - burnt);
    // No contact is lost but those of burnt primaries, so that parts are as large as they can be.
    EXPECT_EQ(left, contacts(tree));
    broken += parts.size() > 1;
  }
  EXPECT_GT(broken, 20);
}

TEST_F(BurntTrees, JoinWhatABurntPrimaryHeldToItsClosestNeighbour) {
  for (int repeat = 0; repeat < 60; ++repeat) {
    Tree tree = randomTree(2 + random.below(25));
    const Tree before = tree;
    const std::size_t burnt = burn(tree, 0.2);
    if (burnt == before.count()) continue;
    TreeUnits units{};
    for (const TreePrimary& p : tree.primaries())
      for (std::size_t c = 0; c < units.size(); ++c) units[c] += p.units[c];
    const auto kept = contacts(tree);
    joinOverBurnt(type, tree);
    expectTree(type, tree);
    EXPECT_EQ(tree.count(), before.count() - burnt);
    for (std::size_t c = 0; c < units.size(); ++c) EXPECT_NEAR(tree.head().units[c], units[c], 1e-9);
    const auto now = contacts(tree);
    for (const auto& [pair, common] : kept) EXPECT_NEAR(now.at(pair) / common, 1, 1e-12);
  }
}

// Three in a row of which the middle one burns: the outer two touch, at the level the one had that goes.
TEST_F(BurntTrees, TheClosestNeighbourTakesOver) {
  Tree tree;
  do {
    tree = joinedTree(type, {5e-9, 3e-9, 4e-9}, random);
  } while (tree.necks()[1].left != 1);
  TreeHead& head = tree.own();
  TreeNeck* necks = necksOf(&head);
  necks[0].common = commonSurface(necks[0].sphere, 0.8);
  necks[1].common = commonSurface(necks[1].sphere, 0.3);
  ASSERT_GT(necks[0].common, necks[1].common);
  primariesOf(&head)[1] = {};
  joinOverBurnt(type, tree);
  ASSERT_EQ(tree.count(), 2U);
  EXPECT_NEAR(sinteringLevel(tree.necks()[0]), 0.3, 1e-12);
  EXPECT_NEAR(tree.necks()[0].sphere / sphereOfNeck(tree.primaries().data(), tree.necks()[0]), 1, 1e-12);
}

// Burning keeps levels; growth adds 2 sigma dv/d, of both primaries, and only for what grows.
TEST_F(BurntTrees, NecksOfShrinkingPrimariesKeepTheirLevels) {
  Tree tree = randomTree(12);
  const Tree before = tree;
  TreeHead& head = tree.own();
  std::vector<double> change(12);
  for (std::uint32_t i = 0; i < 12; ++i) {
    TreePrimary& p = primariesOf(&head)[i];
    const double factor = i % 2 == 0 ? 0.9 : 1;
    change[i] = (factor - 1) * primaryVolume(p.diameter);
    for (double& units : p.units) units *= factor;
  }
  roundTree(type, head, change, 1);
  for (std::size_t k = 0; k < 11; ++k)
    EXPECT_NEAR(sinteringLevel(tree.necks()[k]), sinteringLevel(before.necks()[k]), 1e-12);
  EXPECT_LT(head.volume, before.head().volume);
  expectTree(type, tree);
}

// Who tells which primaries have other units gets the same to the last bit.
TEST_F(BurntTrees, AreRoundedAlikeByThoseThatChanged) {
  for (const double factor : {1.1, 0.9}) {
    Tree whole = randomTree(30);
    std::vector<double> change(30, 0.0);
    roundTree(type, whole.own(), change, 1);
    Tree part = whole;
    TreeHead &all = whole.own(), &some = part.own();
    const std::vector<std::uint32_t> changed{17, 4, 5};
    for (const std::uint32_t i : changed) {
      change[i] = (factor - 1) * primaryVolume(primariesOf(&all)[i].diameter);
      for (TreeHead* head : {&all, &some})
        for (double& units : primariesOf(head)[i].units) units *= factor;
    }
    std::vector<double> again = change;
    roundTree(type, all, change, 1);
    roundTree(type, some, again, 1, changed);
    for (std::uint32_t i = 0; i < 30; ++i) EXPECT_EQ(part.primaries()[i].diameter, whole.primaries()[i].diameter);
    for (std::uint32_t k = 0; k + 1 < 30; ++k) {
      EXPECT_EQ(part.necks()[k].common, whole.necks()[k].common);
      EXPECT_EQ(part.necks()[k].sphere, whole.necks()[k].sphere);
    }
    EXPECT_EQ(some.surface, all.surface);
    EXPECT_EQ(some.collision, all.collision);
    expectTree(type, part);
  }
}

}  // namespace
}  // namespace lampblack::test
