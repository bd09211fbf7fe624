// Sintering of given trees against the equations written out again: closed solutions, and small steps over lists of
// pairs for the rest.
#include "particles/trees/tree_sintering.hpp"

#include <gtest/gtest.h>

#include "tests/particles/trees/tree_fixtures.hpp"

namespace lampblack::test {
namespace {

constexpr double T = 1173;

// A law that fuses nothing at once: times grow with the fourth power of the size.
TreeMaterial slow(SinteringLaw::Size size = SinteringLaw::Size::smaller) {
  TreeMaterial m = silica();
  m.sintering = {SinteringMechanism::grainBoundary, 1e30, 0, 0, size};  // about 1 s at 5 nm
  return m;
}

// The paper's steps (Shekar et al. 2011, eqs. 40, 44, 45, 53): small ones, over a list of pairs. Levels are handed on,
// as far as eq. 9 allows.
struct Plain {
  struct Primary {
    double volume, sites;
  };
  struct Pair {
    std::size_t i, j;
    double C;
  };
  std::vector<Primary> primaries;
  std::vector<Pair> pairs;

  Plain(const Tree& tree) {
    for (const TreePrimary& p : tree.primaries()) primaries.push_back({primaryVolume(p.diameter), p.units[2]});
    for (const TreeNeck& n : tree.necks()) pairs.push_back({n.left, n.right, n.common});
  }
  [[nodiscard]] double sphere(const Pair& p) const {
    return std::cbrt(constants::pi) * std::pow(6 * (primaries[p.i].volume + primaries[p.j].volume), 2.0 / 3);
  }
  [[nodiscard]] double touchingSurfaceOf(const Pair& p) const {
    return std::cbrt(36 * constants::pi) *
           (std::pow(primaries[p.i].volume, 2.0 / 3) + std::pow(primaries[p.j].volume, 2.0 / 3));
  }
  [[nodiscard]] double level(const Pair& p) const {
    const double q = std::pow(2.0, -1.0 / 3);
    return (sphere(p) / p.C - q) / (1 - q);
  }
  void step(const SinteringLaw& law, double dt) {
    for (Pair& p : pairs) {
      const double S = sphere(p);
      const auto rate = [&](double C) {
        const double V = primaries[p.i].volume + primaries[p.j].volume;
        const double d = law.size == SinteringLaw::Size::smaller
                             ? std::cbrt(6 / constants::pi * std::min(primaries[p.i].volume, primaries[p.j].volume))
                             : 6 * V / C;
        return -(C - S) / law.time(T, d);
      };
      p.C += dt * rate(p.C + 0.5 * dt * rate(p.C));
    }
    for (std::size_t k = 0; k < pairs.size();) {
      if (level(pairs[k]) < 0.95) {
        ++k;
        continue;
      }
      const std::size_t i = pairs[k].i, j = pairs[k].j;
      pairs.erase(pairs.begin() + static_cast<std::ptrdiff_t>(k));
      std::vector<double> levels;
      for (const Pair& p : pairs) levels.push_back(level(p));
      primaries[i].volume += primaries[j].volume;
      for (std::size_t n = 0; n < pairs.size(); ++n) {
        Pair& p = pairs[n];
        const bool touches = p.i == i || p.j == i || p.i == j || p.j == j;
        if (p.i == j) p.i = i;
        if (p.j == j) p.j = i;
        const double q = std::pow(2.0, -1.0 / 3);
        if (touches) p.C = std::min(sphere(p) / (levels[n] * (1 - q) + q), touchingSurfaceOf(p));
      }
      k = 0;
    }
  }
  [[nodiscard]] double surface() const {
    double sum = 0;
    for (const Pair& p : pairs) sum += p.C;
    return sum;
  }
};

double surfaceOf(const Tree& tree) {
  double sum = 0;
  for (const TreeNeck& n : tree.necks()) sum += n.common;
  return sum;
}

// Without sites nothing but the surfaces changes.
Tree dry(const PrimaryTrees& type, const std::vector<double>& diameters, RandomStream& random) {
  Tree tree = joinedTree(type, diameters, random);
  TreeHead& head = tree.own();
  for (std::uint32_t i = 0; i < head.count; ++i) {
    TreePrimary& p = primariesOf(&head)[i];
    p.units = {1, 2, 0};
    const double factor = primaryVolume(p.diameter) / type.material().volume(p.units);
    for (double& number : p.units) number *= factor;
  }
  type.measure(head);
  return tree;
}

TEST(TreeSintering, TwoPrimariesFollowTheExponentialUntilTheyFuse) {
  RandomStream random(1, 2, 3);
  const TreeMaterial material = slow();
  const PrimaryTrees type(material, CollisionSize::primaries);
  Tree tree = dry(type, {6e-9, 7e-9}, random);
  const TreeNeck start = tree.necks()[0];
  const double tau = material.sintering.time(T, 6e-9), fused = start.sphere / (0.95 * (1 - touching) + touching);
  const double end = tau * std::log((start.common - start.sphere) / (fused - start.sphere));
  TreeSintering sintering(type, 0);
  sintering.setTemperature(T);
  TreeSintering::Changes changes;
  for (const double part : {0.1, 0.5, 0.9, 0.999999}) {
    type.clock() = part * end;
    sintering.advance(tree, type.clock(), changes);
    ASSERT_EQ(tree.count(), 2U);
    EXPECT_NEAR(tree.necks()[0].common / (start.sphere + (start.common - start.sphere) * std::exp(-part * end / tau)),
                1, 1e-12);
  }
  sintering.advance(tree, 1.000001 * end, changes);
  EXPECT_EQ(tree.count(), 1U);
  EXPECT_EQ(changes.fused, 1U);
  EXPECT_NEAR(tree.head().collision / std::cbrt(216e-27 + 343e-27), 1, 1e-12);
}

// By volume and surface the excess over the sphere's surface goes exponentially, at a size that stays.
TEST(TreeSintering, ByVolumeAndSurfaceTheExcessGoesExponentially) {
  RandomStream random(1, 2, 3);
  TreeMaterial material = silica();
  material.sintering = {SinteringMechanism::constant, 0.3};
  const PrimaryTrees type(material, CollisionSize::volumeToSurface, TreeShape::surfaceVolume);
  Tree tree = dry(type, {6e-9, 7e-9, 3e-9, 6e-9}, random);
  const double start = tree.head().surface, sphere = tree.head().surfaces;
  EXPECT_EQ(tree.count(), 1U);
  EXPECT_NEAR(start / (constants::pi * (36 + 49 + 9 + 36) * 1e-18), 1, 1e-12);
  TreeSintering sintering(type, 0);
  sintering.setTemperature(T);
  TreeSintering::Changes changes;
  for (const double time : {0.03, 0.4, 1.5, 4.0}) {
    type.clock() = time;
    sintering.advance(tree, time, changes);
    EXPECT_NEAR((tree.head().surface - sphere) / ((start - sphere) * std::exp(-time / 0.3)), 1, 1e-9);
    EXPECT_NEAR(tree.head().sintering * 0.3 / (tree.head().surface - sphere), 1, 1e-8);
  }
  sintering.advance(tree, 30, changes);
  EXPECT_EQ(tree.head().surface, tree.head().surfaces);
  EXPECT_FALSE(isAggregate(tree.head()));
  EXPECT_NEAR(tree.head().collision / treeDiameter(tree.head().volume), 1, 1e-12);
}

// With the characteristic time of 6V/S, and sites that go as the surface does and take mass along: small steps.
TEST(TreeSintering, ByVolumeAndSurfaceSitesGoAsTheSurface) {
  RandomStream random(1, 2, 3);
  TreeMaterial material = silica();
  material.sintering = {SinteringMechanism::viscousFlow, 1e8, 2e3, 1.5e-9};
  const PrimaryTrees type(material, CollisionSize::volumeToSurface, TreeShape::surfaceVolume);
  Tree tree = type.make(TreeUnits{2, 1, 6});
  for (int k = 0; k < 9; ++k) tree = type.coagulated(std::move(tree), type.make(TreeUnits{20, 25, 30}), random);
  const TreeHead start = tree.head();
  const double density = start.units[2] / start.surface;
  double S = start.surface;
  TreeUnits units = start.units;
  const double end = 0.1;
  constexpr int steps = 20000;
  const auto rate = [&](double surface) {
    const double gone = density * (start.surface - surface);
    const double V = material.volume({units[0], start.units[1] + 0.5 * gone, start.units[2] - gone});
    return (surface - treeSphere(V)) / material.sintering.time(T, 6 * V / surface);
  };
  for (int i = 0; i < steps; ++i) S -= end / steps * rate(S - 0.5 * end / steps * rate(S));
  TreeSintering sintering(type, 0);
  sintering.setTemperature(T);
  TreeSintering::Changes changes;
  for (const double part : {0.1, 0.7, 1.0}) sintering.advance(tree, part * end, changes);
  const double lost = start.surface - S;
  EXPECT_NEAR((start.surface - tree.head().surface) / lost, 1, 1e-4);
  EXPECT_GT(lost, 0.2 * start.surface);
  EXPECT_GT(S, 1.1 * tree.head().surfaces);
  EXPECT_NEAR(tree.head().units[2] / (density * tree.head().surface), 1, 1e-12);
  EXPECT_NEAR(2 * changes.bridges / (start.units[2] - tree.head().units[2]), 1, 1e-12);
  EXPECT_NEAR(tree.head().units[1] - start.units[1], changes.bridges, 1e-10);
  EXPECT_NEAR(material.volume(tree.head().units) / tree.head().volume, 1, 1e-12);
}

// The times at which a hundred primaries fuse lie apart by less than any step; so the plain steps are of first order in
// them. Halving the steps halves the difference: that with the smallest is below it.
class TreesOfMany : public testing::TestWithParam<std::pair<SinteringLaw::Size, int>> {};

TEST_P(TreesOfMany, SinterAsTheEquationsSayInSmallSteps) {
  const auto [size, count] = GetParam();
  RandomStream random(4, 5, static_cast<std::uint32_t>(count));
  const TreeMaterial material = slow(size);
  const PrimaryTrees type(material, CollisionSize::primaries);
  std::vector<double> diameters;
  for (int i = 0; i < count; ++i) diameters.push_back(4e-9 + 3e-9 * random.uniform());
  Tree tree = dry(type, diameters, random);
  Plain plain(tree);
  const double end = 1.2 * material.sintering.time(T, 5.5e-9);
  constexpr int steps = 20000;
  for (int i = 0; i < steps; ++i) plain.step(material.sintering, end / steps);
  TreeSintering sintering(type, 0);
  sintering.setTemperature(T);
  TreeSintering::Changes changes;
  // In unequal parts: that trees are looked at in between changes nothing.
  for (const double part : {0.05, 0.3, 0.31, 0.8, 1.0}) {
    type.clock() = part * end;
    sintering.advance(tree, type.clock(), changes);
    expectTree(type, tree);
  }
  EXPECT_EQ(tree.count(), plain.primaries.size() - static_cast<std::size_t>(count - 1) + plain.pairs.size());
  EXPECT_EQ(tree.necks().size(), plain.pairs.size());
  EXPECT_NEAR(surfaceOf(tree) / plain.surface(), 1, size == SinteringLaw::Size::smaller ? 2e-4 : 5e-4);
  EXPECT_EQ(changes.bridges, 0);
}

INSTANTIATE_TEST_SUITE_P(All, TreesOfMany,
                         testing::Values(std::pair(SinteringLaw::Size::smaller, 3),
                                         std::pair(SinteringLaw::Size::smaller, 100),
                                         std::pair(SinteringLaw::Size::volumeToSurface, 3),
                                         std::pair(SinteringLaw::Size::volumeToSurface, 100)));

// Two primaries are their own parts: 6 V/S of the pair and of the tree are the same.
TEST(TreeSintering, PartsOfTwoPrimariesAreThePair) {
  RandomStream random(1, 2, 3);
  std::vector<double> surfaces;
  for (const auto between : {SinteringLaw::Between::neighbours, SinteringLaw::Between::parts}) {
    TreeMaterial material = slow(SinteringLaw::Size::volumeToSurface);
    material.sintering.between = between;
    const PrimaryTrees type(material, CollisionSize::primaries);
    Tree tree = dry(type, {6e-9, 7e-9}, random);
    TreeSintering sintering(type, 0);
    sintering.setTemperature(T);
    TreeSintering::Changes changes;
    sintering.advance(tree, 2 * material.sintering.time(T, 6e-9), changes);
    ASSERT_EQ(tree.count(), 2U);
    surfaces.push_back(tree.necks()[0].common / tree.necks()[0].sphere - 1);
  }
  // The midpoint rule with steps of one per cent of the surface.
  EXPECT_NEAR(surfaces[1] / surfaces[0], 1, 2e-3);
}

// Sites go with the surface, two for a bridge; nothing is lost (Shekar et al. 2011, eqs. 45-47).
TEST(TreeSintering, SitesBecomeBridgesAndProduct) {
  RandomStream random(1, 2, 3);
  for (const auto between : {SinteringLaw::Between::neighbours, SinteringLaw::Between::parts}) {
    TreeMaterial material = slow(SinteringLaw::Size::volumeToSurface);
    material.sintering.between = between;
    const PrimaryTrees type(material, CollisionSize::primaries);
    Tree tree = joinedTree(type, {5e-9, 6e-9, 5e-9, 7e-9, 6e-9}, random);
    const TreeHead before = tree.head();
    const double surface = surfaceOf(tree);
    TreeSintering sintering(type, 0);
    sintering.setTemperature(T);
    TreeSintering::Changes changes;
    sintering.advance(tree, 0.01 * material.sintering.time(T, 6e-9), changes);
    const TreeHead& after = tree.head();
    EXPECT_EQ(after.units[0], before.units[0]);
    EXPECT_GT(changes.bridges, 0);
    EXPECT_NEAR((before.units[2] - after.units[2]) / (2 * changes.bridges), 1, 1e-10);
    EXPECT_NEAR((after.units[1] - before.units[1]) / changes.bridges, 1, 1e-10);
    if (between == SinteringLaw::Between::neighbours) {
      EXPECT_NEAR(2 * changes.bridges / (before.units[2] / before.surface * (surface - surfaceOf(tree))), 1, 1e-10);
    }
    expectTree(type, tree);
  }
}

// What eqs. 40, 43 and 45 together say of a pair in small steps: sites go with the surface and take mass along, so that
// the sphere's surface falls, too.
struct PlainPair {
  double C, sites, volume;

  void step(const SinteringLaw& law, double volumeOfSite, double dt) {
    const auto slope = [&](const PlainPair& p) {
      const double tau = law.time(T, 6 * p.volume / p.C);
      const double down = (p.C - std::cbrt(36 * constants::pi) * std::pow(p.volume, 2.0 / 3)) / tau;
      return PlainPair{-down, -p.sites / p.C * down, -p.sites / p.C * down * volumeOfSite};
    };
    const auto moved = [&](const PlainPair& by, double h) {
      return PlainPair{C + h * by.C, sites + h * by.sites, volume + h * by.volume};
    };
    *this = moved(slope(moved(slope(*this), 0.5 * dt)), dt);
  }
};

TEST(TreeSintering, TheSphereLosesTheMassOfTheSites) {
  RandomStream random(1, 2, 3);
  TreeMaterial material = silica();
  using Law = SinteringLaw;
  const Law constant{SinteringMechanism::constant, 1, 0, 0, Law::Size::smaller, Law::Between::neighbours};
  const Law ofPairs{SinteringMechanism::grainBoundary, 4e33, 0, 0, Law::Size::volumeToSurface,
                    Law::Between::neighbours};
  Law constantOfParts = constant, ofParts = ofPairs;
  constantOfParts.size = Law::Size::volumeToSurface;
  constantOfParts.between = ofParts.between = Law::Between::parts;
  const double volumeOfSite = (17.01e-3 - 16.0e-3 / 2) / (material.density * constants::avogadro);
  for (const Law& law : {constant, ofPairs, constantOfParts, ofParts}) {
    material.sintering = law;
    const PrimaryTrees type(material, CollisionSize::primaries);
    const Tree nucleus = type.make({2, 1, 6});
    Tree tree = type.coagulated(Tree(nucleus), Tree(nucleus), random);
    PlainPair plain{tree.necks()[0].common, 12, tree.head().volume};
    TreeSintering sintering(type, 0);
    sintering.setTemperature(T);
    TreeSintering::Changes changes;
    for (int part = 0; part < 3; ++part) {
      for (int i = 0; i < 2000; ++i) plain.step(law, volumeOfSite, 0.4 / 2000);
      type.clock() += 0.4;
      sintering.advance(tree, type.clock(), changes);
      ASSERT_EQ(tree.count(), 2U);
      EXPECT_NEAR(tree.necks()[0].common / plain.C, 1, 2e-4);
      EXPECT_NEAR(tree.head().units[2] / plain.sites, 1, 2e-3);
    }
    // As one they are at a level of 0.95, with the surface that the lost mass leaves them: 2.86 of 12 sites go.
    Tree fused = type.coagulated(Tree(nucleus), Tree(nucleus), random);
    changes = {};
    fused.own().time = type.clock();
    sintering.advance(fused, type.clock() + 100, changes);
    ASSERT_EQ(fused.count(), 1U);
    double sites = 12;
    for (int i = 0; i < 100; ++i) {
      const double volume = 2 * nucleus.head().volume - (12 - sites) * volumeOfSite;
      sites =
          12 * std::cbrt(36 * constants::pi) * std::pow(volume, 2.0 / 3) * fusedRatio / (2 * nucleus.head().surface);
    }
    EXPECT_NEAR(sites, 12 - 2.86, 0.005);
    EXPECT_NEAR(fused.head().units[2], sites, 0.005);
  }
}

// However long a look is: sites go, none come, and sizes stay those of units.
TEST(TreeSintering, LongLooksOfSmallPrimariesLoseSitesOnly) {
  RandomStream random(7, 8, 9);
  TreeMaterial material = silica();
  for (const auto between : {SinteringLaw::Between::neighbours, SinteringLaw::Between::parts}) {
    material.sintering.between = between;
    for (int round = 0; round < 2000; ++round) {
      material.sintering.size = between == SinteringLaw::Between::parts || round % 2 == 0
                                    ? SinteringLaw::Size::volumeToSurface
                                    : SinteringLaw::Size::smaller;
      const PrimaryTrees type(material, CollisionSize::primaries);
      const auto primary = [&] {
        const double n = std::pow(500, random.uniform()), sites = 8 * random.uniform();
        return type.make({2 * n, 2 * n, sites * std::pow(n, 2.0 / 3)});
      };
      Tree tree = primary();
      for (std::uint64_t more = 1 + random.below(8); more > 0; --more)
        tree = type.coagulated(std::move(tree), primary(), random);
      const double before = tree.head().units[2];
      TreeSintering sintering(type, 0);
      sintering.setTemperature(T);
      TreeSintering::Changes changes;
      type.clock() = std::pow(10, -20 + 20 * random.uniform());
      sintering.advance(tree, type.clock(), changes);
      ASSERT_GE(tree.head().units[2], 0);
      ASSERT_NEAR(tree.head().units[2] + 2 * changes.bridges, before, 1e-9 * before);
      expectTree(type, tree);
      for (const TreeNeck& neck : tree.necks()) ASSERT_GE(neck.common, 0.9 * neck.sphere);
    }
  }
}

// Three equal primaries in a row: at first the inner neck loses the excess of the pair's surface over its sphere's, or
// all of it, in the time of 6 V/S.
TEST(TreeSintering, PartsWithinHaveASphereOrNone) {
  for (const bool innerSpheres : {true, false}) {
    RandomStream random(1, 2, 3);
    TreeMaterial material = slow(SinteringLaw::Size::volumeToSurface);
    material.sintering.between = SinteringLaw::Between::parts;
    material.sintering.innerSpheres = innerSpheres;
    const PrimaryTrees type(material, CollisionSize::primaries);
    Tree tree = dry(type, {6e-9, 6e-9, 6e-9}, random);
    const std::size_t inner = tree.necks()[0].last - tree.necks()[0].first == 1 ? 0 : 1;
    const double before = tree.necks()[inner].common, sphere = tree.necks()[inner].sphere;
    const double tau = material.sintering.time(T, 6e-9), dt = 1e-4 * tau;
    TreeSintering sintering(type, 0);
    sintering.setTemperature(T);
    TreeSintering::Changes changes;
    type.clock() = dt;
    sintering.advance(tree, dt, changes);
    const double surface = 2 * primarySurface(6e-9), excess = innerSpheres ? surface - sphere : surface;
    EXPECT_NEAR((before - tree.necks()[inner].common) / (excess * 1e-4), 1, 1e-3);
  }
}

// A tree that waits is behind by no more than the tolerance says.
TEST(TreeSintering, WaitingKeepsTheTolerance) {
  RandomStream random(1, 2, 3);
  const TreeMaterial material = slow();
  const PrimaryTrees type(material, CollisionSize::primaries);
  Tree lazy = dry(type, {6e-9, 7e-9, 8e-9}, random);
  Tree eager = lazy;
  constexpr double tolerance = 1e-3;
  TreeSintering waits(type, tolerance), works(type, 0);
  waits.setTemperature(T);
  works.setTemperature(T);
  TreeSintering::Changes changes;
  const double step = 1e-4 * material.sintering.time(T, 6e-9);
  int waited = 0;
  for (int i = 0; i < 2000 && eager.count() == 3; ++i) {
    type.clock() += step;
    const double before = lazy.head().time;
    waits.advanceLazily(lazy, changes);
    waited += lazy.head().time == before;
    works.advance(eager, type.clock(), changes);
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_LT(lazy.necks()[k].common - eager.necks()[k].common, 1.001 * tolerance * eager.necks()[k].sphere);
  }
  EXPECT_GT(waited, 100);
}

}  // namespace
}  // namespace lampblack::test
