// Trees whose primaries are spheres in space: geometry, units and sums stay in step through every change.
#include "particles/trees/tree_spheres.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "particles/spheres/sphere_geometry.hpp"
#include "particles/spheres/sphere_measures.hpp"
#include "particles/trees/packed_tree.hpp"
#include "particles/trees/tree_burning.hpp"
#include "particles/trees/tree_growth.hpp"
#include "particles/trees/tree_parts.hpp"
#include "particles/trees/tree_rounding.hpp"
#include "particles/trees/tree_sintering.hpp"
#include "tests/particles/spheres/sphere_fixtures.hpp"
#include "tests/particles/trees/tree_fixtures.hpp"

namespace lampblack::test {
namespace {

constexpr double nm = 1e-9;

PrimaryTrees inSpace(const TreeMaterial& material = silica(), CollisionSize size = CollisionSize::primaries) {
  return {material, size, TreeShape::spheres};
}

SphereAggregate aggregateOf(const Tree& tree) {
  SphereAggregate aggregate;
  aggregate.copy(tree.spheres());
  return aggregate;
}

// Each sphere has the volume of its primary's units, and the parent that its neck says.
void expectInStep(const PrimaryTrees& type, const Tree& tree, double tolerance = 1e-10) {
  expectTree(type, tree);
  EXPECT_LT(largestMismatch(aggregateOf(tree)), tolerance);
  for (std::size_t i = 0; i < tree.count(); ++i) {
    const double volume = type.material().volume(tree.primaries()[i].units);
    EXPECT_NEAR(tree.spheres()[i].volume / volume, 1, 1e-14);
    EXPECT_NEAR(primaryVolume(tree.primaries()[i].diameter) / volume, 1, 1e-13);
    if (i == 0) continue;
    EXPECT_EQ(tree.necks()[i - 1].right, i);
    EXPECT_EQ(tree.necks()[i - 1].left, tree.spheres()[i].parent);
  }
  EXPECT_NEAR(tree.head().surface / aggregateOf(tree).surface(), 1, 1e-13);
  EXPECT_EQ(tree.spheres()[0].neck, 0);
  EXPECT_EQ(tree.spheres()[0].parent, 0U);
}

std::vector<double> volumesOf(const Tree& tree) {
  std::vector<double> all;
  for (const AggregateSphere& s : tree.spheres()) all.push_back(s.volume);
  std::ranges::sort(all);
  return all;
}

Tree randomTree(const PrimaryTrees& type, std::size_t count, std::uint64_t seed) {
  RandomStream random(seed, 0, 1);
  std::vector<Tree> trees;
  for (std::size_t i = 0; i < count; ++i)
    trees.push_back(type.make(spherical(type.material(), (3 + 4 * random.uniform()) * nm)));
  joinAtRandom(type, trees, random);
  return trees[0];
}

TreeUnits sumOfUnits(const Tree& tree) {
  TreeUnits sum{};
  for (const TreePrimary& p : tree.primaries())
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += p.units[c];
  return sum;
}

void expectSameUnits(const TreeUnits& a, const TreeUnits& b) {
  for (std::size_t c = 0; c < a.size(); ++c) EXPECT_NEAR(a[c], b[c], 1e-11 * (std::abs(b[c]) + 1));
}

void scaleUnits(TreePrimary& p, double factor) {
  for (double& u : p.units) u *= factor;
}

TEST(TreeSpheres, JoinInPointContactWithAllThatTheyHave) {
  const PrimaryTrees type = inSpace();
  const Tree tree = randomTree(type, 40, 3);
  ASSERT_EQ(tree.count(), 40U);
  expectInStep(type, tree, 1e-12);
  for (const AggregateSphere& s : tree.spheres()) EXPECT_EQ(s.neck, 0);
  for (const TreeNeck& neck : tree.necks()) EXPECT_LT(sinteringLevel(neck), 0.5);
  EXPECT_NEAR(tree.head().surface / tree.head().surfaces, 1, 1e-12);
  EXPECT_LT(uncountedOverlap(aggregateOf(tree)), 1e-6 * tree.head().volume);
}

// Mean squares of the radius of gyration of clusters of equal numbers, masses in centres, as another program has them
// (600 clusters: 3.105 +- 0.028 of four, 7.483 +- 0.077 of eight).
TEST(TreeSpheres, AreAsOpenAsBallisticAggregates) {
  const PrimaryTrees type = inSpace();
  RandomStream random(14, 0, 1);
  constexpr std::size_t clusters = 2000;
  std::vector<Tree> all(clusters, type.make(spherical(silica(), 2 * nm)));
  for (const double published : {1.0, 3.105, 7.483}) {
    std::vector<Tree> next;
    double sum = 0;
    for (std::size_t k = 0; k < clusters; ++k) {
      Tree one = all[random.below(clusters)];
      next.push_back(type.coagulated(std::move(one), Tree(all[random.below(clusters)]), random));
      sum += gyrationSquaredOfPoints(aggregateOf(next.back())) / (nm * nm * clusters);
    }
    EXPECT_NEAR(sum / published, 1, published > 1 ? 0.025 : 1e-9);
    all = std::move(next);
  }
}

// Of equal primaries in point contact surface and diameter of collision are those of trees without places.
TEST(TreeSpheres, OfEqualPrimariesAreAsLargeAsTrees) {
  const PrimaryTrees places = inSpace(), without(silica(), CollisionSize::primaries);
  RandomStream random(1, 0, 1);
  const std::vector<double> equal(12, 5 * nm);
  const Tree a = joinedTree(places, equal, random), b = joinedTree(without, equal, random);
  EXPECT_NEAR(a.head().surface / b.head().surface, 1, 1e-12);
  EXPECT_NEAR(a.head().collision / b.head().collision, 1, 1e-12);
  EXPECT_NEAR(a.head().levels, 0, 1e-12);
  const PrimaryTrees bySize(silica(), CollisionSize::volumeToSurface, TreeShape::spheres);
  EXPECT_NEAR(joinedTree(bySize, equal, random).head().collision / b.head().collision, 1, 1e-12);
  const PrimaryTrees byShadow = inSpace(silica(), CollisionSize::shadow);
  const Tree c = joinedTree(byShadow, equal, random);
  EXPECT_NEAR(c.head().collision, shadowDiameter(shadowAlongAxes(aggregateOf(c))), 1e-20);
  EXPECT_NEAR(byShadow.make(spherical(silica(), 5 * nm)).head().collision / (5 * nm), 1, 1e-12);
}

// What one primary gains is what a sphere of an aggregate gains, and what moves through its necks takes units along.
TEST(TreeSpheres, GrowOnTheirFreeSurface) {
  const PrimaryTrees type = inSpace();
  Tree tree = randomTree(type, 8, 5);
  SphereAggregate alone = aggregateOf(tree);
  TreeHead& head = tree.own();
  TreePrimary& grown = primariesOf(&head)[2];
  const double volume = 0.3 * type.material().volume(grown.units);
  scaleUnits(grown, 1.3);
  const TreeUnits all = sumOfUnits(tree);
  std::vector<double> change(tree.count(), 0.0);
  roundTree(type, head, change, 1);
  growSphere(alone, 2, volume);
  ASSERT_EQ(tree.count(), 8U);
  expectInStep(type, tree);
  expectSameUnits(sumOfUnits(tree), all);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(tree.spheres()[i].radius / alone.spheres()[i].radius, 1, 1e-9);
    EXPECT_NEAR(tree.spheres()[i].volume / alone.spheres()[i].volume, 1, 1e-9);
    EXPECT_NEAR(tree.spheres()[i].neck, alone.spheres()[i].neck, 1e-9 * nm * nm);
  }
  EXPECT_LT(tree.head().surface, tree.head().surfaces);
}

// A sphere of Si only grows over one of O: what it takes from that is O.
TEST(TreeSpheres, TakeTheUnitsOfWhatTheyCover) {
  TreeMaterial material = silica();
  const PrimaryTrees type = inSpace(material);
  RandomStream random(2, 0, 1);
  const double one = primaryVolume(4 * nm);
  const TreeUnits si{one / material.volume({1, 0, 0}), 0, 0}, o{0, one / material.volume({0, 1, 0}), 0};
  Tree tree = type.coagulated(type.make(si), type.make(o), random);
  TreeHead& head = tree.own();
  const std::size_t s = primariesOf(&head)[0].units[0] > 0 ? 0 : 1;
  primariesOf(&head)[s].units[0] *= 2;
  std::vector<double> change(2, 0.0);
  roundTree(type, head, change, 1);
  ASSERT_EQ(tree.count(), 2U);
  expectInStep(type, tree);
  const auto primaries = tree.primaries();
  const double lost = o[1] - primaries[1 - s].units[1];
  EXPECT_GT(lost, 0.01 * o[1]);
  EXPECT_NEAR(primaries[s].units[1] / lost, 1, 1e-10);
  EXPECT_EQ(primaries[1 - s].units[0], 0);
  EXPECT_NEAR(primaries[s].units[0] / si[0], 2, 1e-12);
}

TEST(TreeSpheres, SwallowWhatTheyGrowOver) {
  const PrimaryTrees type = inSpace();
  RandomStream random(4, 0, 1);
  Tree tree = joinedTree(type, {6 * nm, 1 * nm, 5 * nm}, random);
  TreeHead& head = tree.own();
  std::size_t largest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    if (primariesOf(&head)[i].diameter > primariesOf(&head)[largest].diameter) largest = i;
  scaleUnits(primariesOf(&head)[largest], 4);
  const TreeUnits all = sumOfUnits(tree);
  std::vector<double> change(3, 0.0);
  roundTree(type, head, change, 1);
  EXPECT_LT(tree.count(), 3U);
  EXPECT_EQ(type.spheres()->takeMerged(), 3 - tree.count());
  expectSameUnits(sumOfUnits(tree), all);
  expectInStep(type, tree);
}

// Each keeps its contacts: in point contact radii are those of its volume.
TEST(TreeSpheres, BurnWithoutLosingContact) {
  const PrimaryTrees type = inSpace();
  Tree tree = randomTree(type, 20, 6);
  TreeHead& head = tree.own();
  for (std::size_t i = 0; i < 20; ++i) scaleUnits(primariesOf(&head)[i], i % 3 == 0 ? 0.4 : 0.9);
  const TreeUnits all = sumOfUnits(tree);
  std::vector<double> change(20, -1.0);
  roundTree(type, head, change, 1);
  ASSERT_EQ(tree.count(), 20U);
  expectSameUnits(sumOfUnits(tree), all);
  expectInStep(type, tree);
  for (std::size_t i = 0; i < 20; ++i)
    EXPECT_NEAR(2 * tree.spheres()[i].radius / tree.primaries()[i].diameter, 1, 1e-3);
}

TreeMaterial sinteringSilica(bool hasSites) {
  TreeMaterial material = silica();
  material.sintering = {.mechanism = SinteringMechanism::constant, .prefactor = 1};
  if (!hasSites) material.siteReactions().growth[2] = 0;
  return material;
}

// Without sites as an aggregate does by itself.
TEST(TreeSpheres, SinterAsAggregatesDo) {
  const TreeMaterial material = sinteringSilica(true);
  const PrimaryTrees type = inSpace(material);
  RandomStream random(7, 0, 1);
  std::vector<Tree> trees;
  for (int i = 0; i < 6; ++i) trees.push_back(type.make({2000, 4000, 0}));
  joinAtRandom(type, trees, random);
  Tree& tree = trees[0];
  const TreeUnits all = sumOfUnits(tree);
  SphereAggregate alone = aggregateOf(tree);
  SphereSintering direct(material.sintering);
  TreeSintering sintering(type, 0);
  sintering.setTemperature(1173);
  TreeSintering::Changes changes;
  for (const double time : {0.05, 0.1}) {
    sintering.advance(tree, time, changes);
    direct.advance(alone, 1173, time == 0.05 ? 0.05 : 0.05);
    ASSERT_EQ(tree.count(), alone.count());
    expectInStep(type, tree);
    for (std::size_t i = 0; i < tree.count(); ++i)
      EXPECT_NEAR(tree.spheres()[i].radius / alone.spheres()[i].radius, 1, 1e-9);
  }
  EXPECT_EQ(changes.bridges, 0);
  EXPECT_GT(tree.head().levels / 5, 0.05);
  sintering.advance(tree, 1e3, changes);
  EXPECT_EQ(tree.count(), 1U);
  EXPECT_EQ(changes.fused, 5U);
  expectSameUnits(sumOfUnits(tree), all);
  EXPECT_EQ(tree.head().sintering, 0);
}

// The rate at which surface goes is what a short time takes away.
TEST(TreeSpheres, TellHowFastTheirSurfaceGoes) {
  const TreeMaterial material = sinteringSilica(true);
  const PrimaryTrees type = inSpace(material);
  RandomStream random(8, 0, 1);
  std::vector<Tree> trees;
  for (int i = 0; i < 5; ++i) trees.push_back(type.make({1000.0 + 500 * i, 4000, 0}));
  joinAtRandom(type, trees, random);
  Tree& tree = trees[0];
  TreeSintering sintering(type, 0);
  sintering.setTemperature(1173);
  TreeSintering::Changes changes;
  sintering.advance(tree, 0.05, changes);
  ASSERT_EQ(tree.count(), 5U);
  std::vector<double> sums;
  std::vector<SphereSurfaces> surfaces;
  type.spheres()->sumSurfaces(tree.head(), sums);
  aggregateOf(tree).surfaces(surfaces);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_NEAR((sums[i] - sums[i - 1]) / surfaces[i].free, 1, 1e-10);
  EXPECT_NEAR(sums[4] / tree.head().surface, 1, 1e-12);
  const double rate = tree.head().sintering, before = tree.head().surface;
  sintering.advance(tree, 0.05 + 1e-5, changes);
  EXPECT_NEAR((before - tree.head().surface) / 1e-5 / rate, 1, 1e-3);
  TreeSintering lazy(type, 1e-3);
  lazy.setTemperature(1173);
  lazy.advance(tree, 0.06, changes);
  EXPECT_NEAR(tree.head().rest * tree.head().sintering / tree.head().surfaces, 1e-3, 1e-12);
}

// Sites stay as dense as they were, two of those that go are a bridge, and the primaries have their mass no more.
TEST(TreeSpheres, LoseSitesWithTheirSurface) {
  const TreeMaterial material = sinteringSilica(true);
  const PrimaryTrees type = inSpace(material);
  Tree tree = randomTree(type, 6, 9);
  const TreeUnits all = sumOfUnits(tree);
  const double density = all[2] / tree.head().surface;
  TreeSintering sintering(type, 0);
  sintering.setTemperature(1173);
  TreeSintering::Changes changes;
  for (const double time : {0.03, 1e3}) {
    sintering.advance(tree, time, changes);
    expectInStep(type, tree);
    const TreeUnits now = sumOfUnits(tree);
    EXPECT_NEAR(now[2] / tree.head().surface / density, 1, 1e-8);
    EXPECT_NEAR((all[2] - now[2]) / (2 * changes.bridges), 1, 1e-10);
    EXPECT_NEAR((now[1] - all[1]) / changes.bridges, 1, 1e-9);
    EXPECT_NEAR(now[0] / all[0], 1, 1e-12);
  }
  EXPECT_EQ(tree.count(), 1U);
  EXPECT_LT(sumOfUnits(tree)[2], 0.8 * all[2]);
}

// Sides of a neck are as heavy as they were; what the neck had cut off is whole again.
TEST(TreeSpheres, BreakIntoPartsWithTheirVolumes) {
  const TreeMaterial material = sinteringSilica(true);
  const PrimaryTrees type = inSpace(material);
  Tree tree = randomTree(type, 9, 10);
  TreeSintering sintering(type, 0);
  sintering.setTemperature(1173);
  TreeSintering::Changes changes;
  sintering.advance(tree, 0.02, changes);
  ASSERT_GT(tree.count(), 5U);
  const TreeUnits all = sumOfUnits(tree);
  for (std::size_t k = 0; k + 1 < tree.count(); ++k) {
    const std::vector<Tree> sides = sidesOfNeck(type, tree, k);
    ASSERT_EQ(sides.size(), 2U);
    TreeUnits sum{};
    double surface = 0;
    for (const Tree& side : sides) {
      expectInStep(type, side);
      surface += side.head().surface;
      for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += sumOfUnits(side)[c];
    }
    expectSameUnits(sum, all);
    EXPECT_GT(surface, tree.head().surface);
    EXPECT_LT(surface, 1.3 * tree.head().surface);
  }
}

TEST(TreeSpheres, HangTogetherOverBurntOnes) {
  const PrimaryTrees type = inSpace();
  for (std::size_t burnt = 0; burnt < 9; ++burnt) {
    Tree tree = randomTree(type, 9, 11);
    TreeHead& head = tree.own();
    primariesOf(&head)[burnt].units = {};
    const TreeUnits all = sumOfUnits(tree);
    std::vector<double> change(9, 0.0);
    roundTree(type, head, change, 1);
    ASSERT_EQ(tree.count(), 9U);
    EXPECT_EQ(tree.primaries()[burnt].diameter, 0);
    const std::vector<Tree> parts = partsAroundBurnt(type, tree);
    std::size_t count = 0;
    for (const Tree& part : parts) {
      expectInStep(type, part);
      count += part.count();
    }
    EXPECT_EQ(count, 8U);
    std::vector<double> there = volumesOf(tree);
    there.erase(there.begin());
    joinOverBurnt(type, tree);
    ASSERT_EQ(tree.count(), 8U);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(volumesOf(tree)[i] / there[i], 1, 1e-12);
    expectInStep(type, tree);
    expectSameUnits(sumOfUnits(tree), all);
  }
}

// How the coordinates are turned is nobody's choice.
TEST(TreeSpheres, GrowAndSinterAlikeInAnyDirection) {
  const PrimaryTrees type = inSpace(sinteringSilica(true));
  RandomStream random(12, 0, 1);
  Tree one = randomTree(type, 12, 12), other = one;
  const Rotation by = randomRotation(random);
  for (std::size_t i = 0; i < 12; ++i) {
    AggregateSphere& s = spheresOf(&other.own())[i];
    s.centre = turned(by, s.centre);
  }
  for (Tree* tree : {&one, &other}) {
    TreeHead& head = tree->own();
    for (std::size_t i = 0; i < 12; i += 2) scaleUnits(primariesOf(&head)[i], 1.2);
    std::vector<double> change(12, 0.0);
    roundTree(type, head, change, 1);
    TreeSintering sintering(type, 0);
    sintering.setTemperature(1173);
    TreeSintering::Changes changes;
    sintering.advance(*tree, 0.01, changes);
    expectInStep(type, *tree);
  }
  ASSERT_EQ(one.count(), other.count());
  EXPECT_NEAR(one.head().surface / other.head().surface, 1, 1e-9);
  EXPECT_NEAR(one.head().collision / other.head().collision, 1, 1e-9);
  for (std::size_t i = 0; i < one.count(); ++i)
    EXPECT_LT(length(difference(turned(by, one.spheres()[i].centre), other.spheres()[i].centre)), 1e-8 * nm);
}

// One by one where few are expected and as Poisson numbers otherwise.
TEST(TreeSpheres, ReactByTheirFreeSurface) {
  const PrimaryTrees type = inSpace();
  const Tree tree = randomTree(type, 6, 15);
  std::vector<SphereSurfaces> surfaces;
  aggregateOf(tree).surfaces(surfaces);
  TreeGrowth growth(type);
  growth.setRate(1);
  RandomStream random(15, 0, 2);
  for (const double events : {0.2, 40.0}) {
    const double repeats = 2000 / events, dt = events / tree.head().units[2];
    std::vector<double> gained(6, 0.0);
    TreeGrowth::Changes changes;
    for (int k = 0; k < repeats; ++k) {
      Tree one = tree;
      growth.advance(one, dt, random, changes);
      for (std::size_t i = 0; i < 6; ++i) gained[i] += one.primaries()[i].units[0] - tree.primaries()[i].units[0];
    }
    EXPECT_NEAR(changes.reactions / 2000, 1, 4 / std::sqrt(2000.0));
    for (std::size_t i = 0; i < 6; ++i) {
      const double expected = changes.reactions * surfaces[i].free / tree.head().surface;
      EXPECT_NEAR(gained[i], expected, 4 * std::sqrt(expected));
    }
  }
}

TEST(TreeSpheres, ArePackedAsTheyAre) {
  const PrimaryTrees type = inSpace(sinteringSilica(true), CollisionSize::shadow);
  Tree tree = randomTree(type, 7, 13);
  TreeSintering sintering(type, 0);
  sintering.setTemperature(1173);
  TreeSintering::Changes changes;
  sintering.advance(tree, 1e-3, changes);
  std::vector<double> row;
  packTree(tree, 1e10, type.material(), row);
  const Tree again = unpackTree(row, type.pool(), type.material());
  ASSERT_EQ(again.count(), 7U);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(again.spheres()[i].centre, tree.spheres()[i].centre);
    EXPECT_EQ(again.spheres()[i].radius, tree.spheres()[i].radius);
    EXPECT_EQ(again.spheres()[i].neck, tree.spheres()[i].neck);
    EXPECT_EQ(again.spheres()[i].parent, tree.spheres()[i].parent);
  }
  TreePool without;
  EXPECT_THROW(unpackTree(row, without, type.material()), InputError);
}

TEST(TreeSpheres, HaveLawsOfNeighboursOnly) {
  TreeMaterial material = sinteringSilica(true);
  material.sintering.between = SinteringLaw::Between::parts;
  EXPECT_THROW(inSpace(material), InputError);
  material.sintering.between = SinteringLaw::Between::neighbours;
  material.sintering.size = SinteringLaw::Size::volumeToSurface;
  EXPECT_THROW(inSpace(material), InputError);
}

}  // namespace
}  // namespace lampblack::test
