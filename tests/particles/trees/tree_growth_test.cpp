// Surface reactions and reactions within particles against their expectations.
#include "particles/trees/tree_growth.hpp"

#include <gtest/gtest.h>

#include "core/poisson.hpp"
#include "particles/population/model/surface_volume.hpp"
#include "particles/trees/tree_rounding.hpp"
#include "particles/trees/tree_sites.hpp"
#include "tests/particles/statistics.hpp"
#include "tests/particles/trees/tree_fixtures.hpp"

namespace lampblack::test {
namespace {

TEST(Poisson, HasTheMeanAndVarianceOfItsName) {
  RandomStream random(11, 12, 13);
  for (const double mean : {0.01, 0.7, 5.0, 9.9, 10.1, 40.0, 3000.0}) {
    std::vector<double> values, squares;
    for (int i = 0; i < 40000; ++i) {
      const double k = poisson(random, mean);
      ASSERT_EQ(k, std::floor(k));
      values.push_back(k);
      squares.push_back((k - mean) * (k - mean));
    }
    EXPECT_LT(std::abs(summarise(values).z(mean)), zLimit) << mean;
    EXPECT_LT(std::abs(summarise(squares).z(mean)), zLimit) << mean;
  }
  EXPECT_EQ(poisson(random, 0), 0);
}

// Surface and reaction within go as fast: the mean number of sites n stays n0, and of events there are rate n0 t. The
// variance of n is 8 rate n0 t, four for each of two kinds, as long as no primary runs out of sites.
void expectMartingale(double sites, double rate, double dt, int parts) {
  const TreeMaterial material = silica();
  const PrimaryTrees type(material, CollisionSize::primaries);
  RandomStream random(21, static_cast<std::uint64_t>(sites), 23);
  TreeGrowth growth(type);
  growth.setRate(rate);
  std::vector<double> left, squares, events;
  for (int repeat = 0; repeat < 4000; ++repeat) {
    Tree tree = type.make(TreeUnits{sites, 2 * sites, sites});
    TreeGrowth::Changes changes;
    for (int i = 0; i < parts; ++i) (void)growth.advance(tree, dt / parts, random, changes);
    const double n = tree.head().units[2];
    ASSERT_EQ(changes.limited, 0U);
    EXPECT_EQ(n, sites + 2 * changes.reactions - 2 * changes.bridges);
    EXPECT_EQ(tree.head().units[0], sites + changes.reactions);
    EXPECT_EQ(tree.head().units[1], 2 * sites + changes.reactions + changes.bridges);
    left.push_back(n);
    squares.push_back((n - sites) * (n - sites));
    events.push_back(changes.reactions);
  }
  const double expected = rate * sites * dt;
  EXPECT_LT(std::abs(summarise(left).z(sites)), zLimit);
  EXPECT_LT(std::abs(summarise(events).z(expected)), zLimit);
  EXPECT_LT(std::abs(summarise(squares).z(8 * expected)), zLimit);
}

TEST(TreeGrowth, OneByOneHasTheLawOfTheSites) {
  expectMartingale(100, 0.05, 1, 3);
}
TEST(TreeGrowth, InNumbersHasTheLawOfTheSites) {
  expectMartingale(5000, 0.2, 1, 1);
}

// By volume and surface what comes grows on the sphere of the surface, dS = 2 dV / sqrt(S/4 pi), and what leaves keeps
// the number of equal primaries; of small changes.
TEST(TreeGrowth, ByVolumeAndSurfaceRounds) {
  const TreeMaterial material = silica();
  const PrimaryTrees type(material, CollisionSize::volumeToSurface, TreeShape::surfaceVolume);
  RandomStream random(31, 32, 33);
  for (const bool grows : {true, false}) {
    Tree tree = joinedTree(type, {6e-9, 7e-9, 5e-9}, random);
    TreeHead& head = tree.own();
    const double S = head.surface, V = head.volume;
    primariesOf(&head)->units[0] += grows ? 20 : -20;
    std::vector<double> pieces{grows ? 20.0 : 0.0};
    roundTree(type, head, pieces, material.volume({1, 0, 0}));
    const double dV = material.volume({grows ? 20.0 : -20.0, 0, 0});
    EXPECT_NEAR(head.volume - V, dV, 1e-9 * V);
    const double expected = grows ? 2 * dV / std::sqrt(S / (4 * constants::pi)) : 2.0 / 3 * S / V * dV;
    EXPECT_NEAR((head.surface - S) / expected, 1, 2e-3);
    const SurfaceVolume as(2200, 1.8);
    EXPECT_NEAR(primariesOfTree(head) / as.primaries({head.volume, head.surface}), 1, 1e-12);
    EXPECT_NEAR(meanPrimaryDiameter(head) / as.primaryDiameter({head.volume, head.surface}), 1, 1e-12);
    EXPECT_NEAR(meanSinteringLevel(head) / (treeSphere(head.volume) / head.surface), 1, 1e-12);
    // Two sites within it, beside what sinters of them; both of two that join do.
    head.sintering = 1e-18;
    TreeGrowth growth(type);
    growth.setRate(0.3);
    EXPECT_NEAR(growth.within(head, 7) / (0.3 * 7 - 0.5 * 7 / head.surface * 1e-18), 1, 1e-12);
    EXPECT_EQ(type.coagulated(Tree(tree), Tree(tree), random).head().sintering, 2e-18);
    EXPECT_NEAR(head.collision / as.collisionDiameter({head.volume, head.surface}), 1, 1e-12);
  }
}

// A nucleus has six sites and may lose the last: it stays there, and what is refused is counted.
TEST(TreeGrowth, FewSitesAreNeverBelowZero) {
  const PrimaryTrees type(silica(), CollisionSize::primaries);
  RandomStream random(31, 32, 33);
  TreeGrowth growth(type);
  growth.setRate(1);
  int dead = 0;
  for (int repeat = 0; repeat < 500; ++repeat) {
    Tree tree = type.make(silica().sites()->nucleus);
    TreeGrowth::Changes changes;
    for (int i = 0; i < 20; ++i) (void)growth.advance(tree, 0.5, random, changes);
    EXPECT_GE(tree.head().units[2], 0);
    dead += tree.head().units[2] == 0;
  }
  EXPECT_GT(dead, 100);
}

// Eqs. 30, 31: what a primary gains in volume times 2 sigma / d goes to all its necks.
TEST(TreeGrowth, NecksGainByWhatGrowsOnTheirPrimaries) {
  TreeMaterial material = silica();
  material.smoothing = 1.5;
  material.siteReactions().condenses = false;
  const PrimaryTrees type(material, CollisionSize::primaries);
  RandomStream random(41, 42, 43);
  Tree tree = joinedTree(type, {5e-9, 6e-9, 7e-9}, random);
  const Tree before = tree;
  TreeGrowth growth(type);
  growth.setRate(5e-4);
  TreeGrowth::Changes changes;
  ASSERT_TRUE(growth.advance(tree, 1, random, changes));
  for (std::size_t k = 0; k < 2; ++k) {
    const TreeNeck& was = before.necks()[k];
    double gain = 0;
    for (const std::uint32_t i : {was.left, was.right}) {
      const double events = tree.primaries()[i].units[0] - before.primaries()[i].units[0];
      gain += events * material.volume(material.sites()->growth) * 2 * 1.5 / before.primaries()[i].diameter;
    }
    EXPECT_GT(gain, 0);
    EXPECT_NEAR((tree.necks()[k].common - was.common) / gain, 1, 1e-6);  // a difference of numbers 1e4 times as large
  }
  expectTree(type, tree);
}

// A splitting step is as long as volume by growth, or number by coagulation, takes to change by the tolerance.
TEST(TreeSites, StepsFollowWhatChangesFastest) {
  const TreeMaterial material = silica();
  const PrimaryTrees type(material, CollisionSize::primaries);
  CollisionKernelOptions options{.type = CollisionKernelType::freeMolecular};
  options.gas = {1173, 101325, 0.3, 4.6e-5, 0.028};
  const CollisionKernel kernel(options);
  const std::array<double, 2> concentrations{1e-9, 0};
  ParticleGas gas{options.gas, concentrations};
  TreeSites sites(type);
  sites.setGas(gas, kernel);
  TreeSites::Sums sums;
  const Tree one = type.make(TreeUnits{2000, 4000, 400});
  const double number = 1e16, v = one.head().volume;
  sites.add(sums, one.head(), number);
  constexpr double tolerance = 0.03, long_ = 1e9;
  const double rate = 1e7 * 1e-9;  // 1/s for each site
  const double growth = rate * 400 * material.volume({1, 1, 2}) / v;
  EXPECT_NEAR(sites.step(sums, nullptr, tolerance, long_) * growth / tolerance, 1, 1e-12);
  const CollisionKernel::Properties p{v, 2200 * v, one.head().collision};
  const double collisions = 0.5 * kernel.value(p, p) * number;
  ASSERT_GT(collisions, growth);
  EXPECT_NEAR(sites.step(sums, &kernel, tolerance, long_) * collisions / tolerance, 1, 1e-12);
  EXPECT_EQ(sites.step(sums, &kernel, tolerance, 1e-9), 1e-9);
}

}  // namespace
}  // namespace lampblack::test
