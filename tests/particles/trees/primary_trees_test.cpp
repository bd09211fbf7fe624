// Shapes of trees, and that joining and fusing keep them trees.
#include "particles/trees/primary_trees.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "particles/trees/tree_sintering.hpp"
#include "tests/particles/trees/tree_fixtures.hpp"

namespace lampblack::test {
namespace {

// Shekar et al. (2011), eqs. 15-19, by hand for n equal primaries in point contact: S = n s, n_r = n.
TEST(PrimaryTrees, InPointContactAreFractalAggregates) {
  RandomStream random(1, 2, 3);
  for (const CollisionSize size : {CollisionSize::primaries, CollisionSize::volumeToSurface}) {
    const PrimaryTrees type(silica(), size);
    for (const std::size_t n : {2, 3, 10, 100}) {
      const Tree tree = joinedTree(type, std::vector<double>(n, 7e-9), random);
      expectTree(type, tree);
      EXPECT_NEAR(tree.head().surface / (static_cast<double>(n) * constants::pi * 49e-18), 1, 1e-12);
      EXPECT_NEAR(tree.head().collision / (7e-9 * std::pow(n, 1 / 1.8)), 1, 1e-12);
    }
  }
}

// A level of one throughout: the surface of the sphere (eq. 15), and by 6 V/S its diameter.
TEST(PrimaryTrees, FullySinteredOnesHaveTheSizeOfTheSphere) {
  RandomStream random(1, 2, 3);
  const PrimaryTrees type(silica(), CollisionSize::volumeToSurface);
  Tree tree = joinedTree(type, {5e-9, 6e-9, 7e-9, 8e-9}, random);
  TreeHead& head = tree.own();
  for (std::uint32_t k = 0; k + 1 < head.count; ++k) necksOf(&head)[k].common = necksOf(&head)[k].sphere;
  type.measure(head);
  EXPECT_NEAR(head.surface / sphereSurface(head.volume), 1, 1e-12);
  EXPECT_NEAR(head.collision / sphereDiameter(head.volume), 1, 1e-12);
}

// Unequal primaries in contact have a level above zero (Shekar et al. 2011, eq. A.12).
TEST(PrimaryTrees, LevelOfUnequalPrimariesFollowsTheirRatio) {
  RandomStream random(1, 2, 3);
  const PrimaryTrees type(silica(), CollisionSize::primaries);
  const Tree tree = joinedTree(type, {5e-9, 10e-9}, random);
  const double a = 2, q = std::pow(2.0, -1.0 / 3);
  EXPECT_NEAR(sinteringLevel(tree.necks()[0]), (std::pow(1 + a * a * a, 2.0 / 3) / (1 + a * a) - q) / (1 - q), 1e-12);
}

TEST(PrimaryTrees, StayTreesHoweverTheyJoinAndFuse) {
  RandomStream random(5, 6, 7);
  const TreeMaterial material = silica();
  const PrimaryTrees type(material, CollisionSize::primaries);
  int capped = 0;
  for (int round = 0; round < 200; ++round) {
    std::vector<Tree> parts;
    for (int i = 0; i < 12; ++i) parts.push_back(type.make(spherical(material, 4e-9 * (1 + random.uniform()))));
    while (parts.size() > 1) {
      const std::size_t i = random.below(parts.size());
      std::swap(parts[i], parts.back());
      Tree one = std::move(parts.back());
      parts.pop_back();
      const std::size_t j = random.below(parts.size());
      parts[j] = type.coagulated(std::move(parts[j]), std::move(one), random);
      if (parts[j].count() > 2 && random.uniform() < 0.5) {
        TreeHead& head = parts[j].own();
        const TreeUnits before = head.units;
        const std::size_t k = random.below(head.count - 1);
        std::vector<double> levels;
        for (const TreeNeck& neck : parts[j].necks()) levels.push_back(sinteringLevel(neck));
        levels.erase(levels.begin() + static_cast<std::ptrdiff_t>(k));
        std::vector<TreeNeck> old(parts[j].necks().begin(), parts[j].necks().end());
        const std::size_t from = fuseNeck(head, k, material);
        ASSERT_LE(from, k);
        for (std::size_t n = 0; n < from; ++n) {  // nothing else before that
          EXPECT_EQ(parts[j].necks()[n].common, old[n].common);
          EXPECT_EQ(parts[j].necks()[n].sphere, old[n].sphere);
        }
        type.measure(head);
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(head.units[c] / before[c], 1, 1e-13);
        std::vector<double> after;
        for (const TreeNeck& neck : parts[j].necks()) after.push_back(sinteringLevel(neck));
        std::sort(levels.begin(), levels.end());
        std::sort(after.begin(), after.end());
        // Handed on, or raised to that of point contact, which is above it where sizes differ more.
        for (const TreeNeck& neck : parts[j].necks()) {
          const double most = touchingSurface(parts[j].primaries().data(), neck);
          EXPECT_LE(neck.common / most, 1 + 1e-12);
          if (neck.common > most * (1 - 1e-12)) {
            ++capped;
            continue;
          }
          const auto handed = std::lower_bound(levels.begin(), levels.end(), sinteringLevel(neck) - 1e-12);
          ASSERT_NE(handed, levels.end());
          EXPECT_NEAR(*handed, sinteringLevel(neck), 1e-12);
        }
        for (std::size_t n = 0; n < after.size(); ++n) EXPECT_GE(after[n], levels[n] - 1e-12);
      }
    }
    expectTree(type, parts[0]);
  }
  EXPECT_GT(capped, 100);
}

// Where nothing sinters a single primary that is one with what it touches goes into it at once, and of other trees the
// contact alone is looked at: to the bits of trees that are joined first and of which every neck is looked at then.
TEST(PrimaryTrees, ThatAreOneAtOnceAreAsJoinedAndFused) {
  TreeMaterial material = silica();
  material.sintering.mechanism = SinteringMechanism::none;
  const PrimaryTrees atOnce(material, CollisionSize::primaries), later(material, CollisionSize::primaries);
  TreeSintering looksAtOnce(atOnce, 0.01), looksLater(later, 0.01);
  TreeSintering::Changes changes, changesLater;
  atOnce.setSintering([&](Tree& tree, double time) { looksAtOnce.advance(tree, time, changes); });
  atOnce.setNextUpdate(2);
  std::uint64_t absorbed = 0;
  for (std::uint64_t round = 0; round < 50; ++round) {
    RandomStream random(5, 6, 7), randomLater = random;
    random.seek(1000 * round);
    randomLater.seek(1000 * round);
    RandomStream sizes(1, round, 2);
    Tree tree = atOnce.make(spherical(material, 3e-8)), treeLater = later.make(spherical(material, 3e-8));
    for (int i = 0; i < 40; ++i) {
      // Nuclei, larger ones, and now and then two in contact.
      const double d = 1e-9 + 30e-9 * std::pow(sizes.uniform(), 4);
      Tree one = atOnce.make(spherical(material, d)), oneLater = later.make(spherical(material, d));
      if (i % 5 == 0) {
        one = atOnce.coagulated(std::move(one), atOnce.make(spherical(material, 3e-9)), random);
        oneLater = later.coagulated(std::move(oneLater), later.make(spherical(material, 3e-9)), randomLater);
        looksLater.advance(oneLater, 1, changesLater);
      }
      tree = atOnce.coagulated(std::move(tree), std::move(one), random);
      treeLater = later.coagulated(std::move(treeLater), std::move(oneLater), randomLater);
      looksLater.advance(treeLater, 1, changesLater);
      const TreeHead &h = tree.head(), &l = treeLater.head();
      ASSERT_EQ(h.count, l.count);
      EXPECT_EQ(random.position(), randomLater.position());
      EXPECT_EQ(h.units, l.units);
      for (const auto value : {&TreeHead::volume, &TreeHead::diameters, &TreeHead::surfaces, &TreeHead::levels,
                               &TreeHead::surface, &TreeHead::collision, &TreeHead::sintering})
        EXPECT_EQ(h.*value, l.*value);
      if (h.count > 1) {
        EXPECT_EQ(h.time, 1);
        EXPECT_EQ(h.rest, l.rest);
      }
      for (std::size_t k = 0; k + 1 < h.count; ++k) {
        const TreeNeck &a = tree.necks()[k], &b = treeLater.necks()[k];
        EXPECT_TRUE(a.common == b.common && a.sphere == b.sphere);
        EXPECT_TRUE(a.left == b.left && a.right == b.right && a.first == b.first && a.last == b.last);
      }
      for (std::size_t k = 0; k < h.count; ++k) {
        EXPECT_EQ(tree.primaries()[k].diameter, treeLater.primaries()[k].diameter);
        EXPECT_EQ(tree.primaries()[k].units, treeLater.primaries()[k].units);
      }
    }
    absorbed += atOnce.takeAbsorbed();
  }
  EXPECT_GT(absorbed, 100U);
  EXPECT_EQ(absorbed + changes.fused, changesLater.fused);
  EXPECT_EQ(atOnce.takeAbsorbed(), 0U);
}

TEST(PrimaryTrees, CopiesShareTheirPrimariesUntilOneChanges) {
  RandomStream random(1, 2, 3);
  const PrimaryTrees type(silica(), CollisionSize::primaries);
  Tree one = joinedTree(type, {5e-9, 6e-9}, random);
  Tree other = one;
  EXPECT_EQ(&one.head(), &other.head());
  other.own().volume = 1;
  EXPECT_NE(&one.head(), &other.head());
  EXPECT_LT(one.head().volume, 1);
}

// Blocks of all sizes in a random order: what is given back is used again.
TEST(PrimaryTrees, MemoryGoesBackWithTheTrees) {
  RandomStream random(8, 9, 10);
  TreePool pool;
  std::vector<TreeHead*> held;
  std::size_t most = 0;
  for (int i = 0; i < 20000; ++i) {
    if (held.size() < 500 || random.uniform() < 0.5) {
      held.push_back(pool.allocate(1 + random.below(i % 100 == 0 ? 2000 : 20)));
      ASSERT_GE(held.back()->capacity, 1U);
    } else {
      const std::size_t k = random.below(held.size());
      pool.release(held[k]);
      held[k] = held.back();
      held.pop_back();
    }
    most = std::max(most, pool.bytes());
  }
  EXPECT_GT(most, 0U);
  for (TreeHead* block : held) pool.release(block);
  EXPECT_EQ(pool.bytes(), 0U);
}

TEST(PrimaryTrees, AMaterialThatIsNoneSaysWhatIsWrong) {
  const auto message = [](auto change) {
    TreeMaterial m = silica();
    change(m);
    try {
      requireMaterial(m);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message([](TreeMaterial&) {}), "");
  EXPECT_NE(message([](TreeMaterial& m) { m.components[1].weight = 0; }).find("O needs a mass"), std::string::npos);
  EXPECT_NE(message([](TreeMaterial& m) { m.sintering.prefactor = -1; }).find("sintering"), std::string::npos);
  EXPECT_NE(message([](TreeMaterial& m) { m.sintering.temperature = -1; }).find("sintering"), std::string::npos);
  EXPECT_NE(message([](TreeMaterial& m) { m.smoothing = 3; }).find("smoothing"), std::string::npos);
  EXPECT_NE(message([](TreeMaterial& m) { m.density = 0; }).find("density"), std::string::npos);
  EXPECT_NE(message([](TreeMaterial& m) { m.siteReactions().site = 5; }).find("sites"), std::string::npos);
  EXPECT_NE(message([](TreeMaterial& m) { m.siteReactions().energy = -1; }).find("rate constant"), std::string::npos);
  EXPECT_NE(message([](TreeMaterial& m) {
              m.siteReactions().growth = {-1, 0, 0};
            }).find("take mass"),
            std::string::npos);
  const auto ofSoot = [&](auto change) {
    return message([&](TreeMaterial& m) {
      m = sootMaterial({});
      change(m);
    });
  };
  EXPECT_EQ(ofSoot([](TreeMaterial&) {}), "");
  for (const std::size_t c : {0U, 1U})
    EXPECT_NE(ofSoot([&](TreeMaterial& m) { m.components[c].weight *= 1.01; }).find("soot has"), std::string::npos);
  EXPECT_NE(ofSoot([](TreeMaterial& m) { m.density = 2200; }).find("soot has"), std::string::npos);
}

}  // namespace
}  // namespace lampblack::test
