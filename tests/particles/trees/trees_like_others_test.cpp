// Populations of trees in limits that other solutions have, in law.
#include <gtest/gtest.h>

#include <cmath>

#include "particles/population/monte_carlo/initial_sample.hpp"
#include "particles/population/monte_carlo/shipped_types.hpp"
#include "particles/trees/tree_population.hpp"
#include "tests/particles/soot_fixtures.hpp"
#include "tests/particles/statistics.hpp"
#include "tests/particles/trees/tree_fixtures.hpp"

namespace lampblack::test {
namespace {

constexpr double start = 1e16, until = 0.5;  // 1/m3, s
const TreeUnits sphere{2107, 3960, 398};

// Soot to which nothing happens but collisions, and a sphere of it of about that volume.
TreeMaterial inertSoot() {
  SootReactions reactions;
  reactions.soot = jumpsOnly(true, false);
  return sootMaterial(reactions);
}
const TreeUnits soot{9500, 1000, 0};

TreeOptions optionsOf(SinteringMechanism mechanism, CollisionKernelType kernel) {
  TreeOptions options;
  options.material = silica();
  options.material.sintering.mechanism = mechanism;
  options.material.sintering.prefactor = 1e-30;
  options.kernel.type = kernel;
  options.kernel.slip = SlipLaw::davies;
  options.particles = 1000;
  options.size = CollisionSize::volumeToSurface;
  return options;
}

// A sphere without sites.
TreeUnits dry(const TreeMaterial& material) {
  TreeUnits units{1, 2, 0};
  const double factor = material.volume(sphere) / material.volume(units);
  for (double& number : units) number *= factor;
  return units;
}

// M_0 and M_2 at the end, over repeats.
struct Moments {
  std::vector<double> number, squared;
};

Moments ofTrees(TreeOptions options, int repeats, const TreeUnits& units = sphere) {
  Moments moments;
  Nitrogen nitrogen;
  nitrogen.concentrations.resize(options.material.species().size());
  for (int r = 0; r < repeats; ++r) {
    options.owner = static_cast<std::uint64_t>(r);
    const auto trees = std::make_unique<TreePopulation>(options);
    trees->fill(units, start);
    trees->advance(nitrogen.gas(), until);
    const TreeTotals totals = trees->totals();
    moments.number.push_back(totals.number);
    moments.squared.push_back(totals.massSquared);
  }
  return moments;
}

template <class Type>
Moments ofType(const Type& type, const TreeOptions& trees, int repeats, const TreeUnits& units = sphere) {
  Moments moments;
  PopulationModel model;
  model.coagulation = trees.kernel;
  model.coagulation->gas = Nitrogen().gas();
  model.growth.always = moreThanVolume<Type>();  // which sinter
  model.growth.step = until / 200;
  const double volume = trees.material.volume(units), rho = trees.material.density;
  InitialPopulation initial;
  initial.distribution = InitialPopulation::Distribution::monodisperse;
  initial.number = start;
  initial.volume = volume;
  MonteCarloOptions options;
  options.particles = trees.particles;
  for (int r = 0; r < repeats; ++r) {
    options.repeat = static_cast<std::uint64_t>(r);
    const auto solver = makeMonteCarlo(type, model, initial, options);
    solver->advance(until);
    moments.number.push_back(solver->moments()[0]);
    moments.squared.push_back(solver->moments()[2] * rho * rho);
  }
  return moments;
}

void expectSameLaw(const Moments& a, const Moments& b) {
  for (const auto moment : {&Moments::number, &Moments::squared}) {
    const Sample first = summarise(a.*moment), second = summarise(b.*moment);
    const double z = (first.mean - second.mean) / std::hypot(first.standardError, second.standardError);
    EXPECT_LT(std::abs(z), zLimit) << first.mean << " and " << second.mean;
    EXPECT_LT(std::abs(first.mean / second.mean - 1), 0.05);  // that there is a law to tell apart
  }
}

class TreesLikeOthers : public testing::TestWithParam<CollisionKernelType> {};

TEST_P(TreesLikeOthers, WithoutSinteringAreFractalAggregatesInLaw) {
  const TreeOptions options = optionsOf(SinteringMechanism::none, GetParam());
  const FractalAggregate type(2200, sphereDiameter(options.material.volume(sphere)), 1.8);
  expectSameLaw(ofTrees(options, 40), ofType(type, options, 40));
}

TEST_P(TreesLikeOthers, OfSootAreFractalAggregatesInLaw) {
  TreeOptions options = optionsOf(SinteringMechanism::none, GetParam());
  options.material = inertSoot();
  const FractalAggregate type(1850, sphereDiameter(options.material.volume(soot)), 1.8);
  expectSameLaw(ofTrees(options, 40, soot), ofType(type, options, 40, soot));
}

// With a characteristic time beside that of collisions, and without sites.
TEST_P(TreesLikeOthers, ByVolumeAndSurfaceAreThoseOfThePopulationBalanceInLaw) {
  TreeOptions options = optionsOf(SinteringMechanism::constant, GetParam());
  options.material.sintering.prefactor = 0.05;
  options.shape = TreeShape::surfaceVolume;
  options.splitTolerance = 0.01;  // at 0.05 the number is 0.9 % low
  expectSameLaw(ofTrees(options, 40, dry(options.material)),
                ofType(SurfaceVolume(2200, 1.8, 0.05), options, 40, dry(options.material)));
}

// The characteristic time is 1e-30 s, and there are no sites that would go with the surface.
TEST_P(TreesLikeOthers, ThatCoalesceAreSpheresInLaw) {
  const TreeOptions options = optionsOf(SinteringMechanism::constant, GetParam());
  Moments trees;
  const Nitrogen nitrogen;
  for (std::uint64_t r = 0; r < 40; ++r) {
    TreeOptions own = options;
    own.owner = r;
    const auto population = std::make_unique<TreePopulation>(own);
    population->fill(dry(options.material), start);
    population->advance(nitrogen.gas(), until);
    population->applyDeferred();
    EXPECT_EQ(population->totals().largest, 1U);
    trees.number.push_back(population->totals().number);
    trees.squared.push_back(population->totals().massSquared);
  }
  expectSameLaw(trees, ofType(Sphere(2200), options, 40));
}

// Where only the kernel sees the diameter of collision, places of primaries change nothing.
TreeOptions inSpaceWithoutSintering() {
  TreeOptions options = optionsOf(SinteringMechanism::none, CollisionKernelType::freeMolecular);
  options.shape = TreeShape::spheres;
  return options;
}

TEST(TreesInSpaceLikeOthers, WithoutSinteringAreAsManyAsFractalAggregates) {
  TreeOptions options = inSpaceWithoutSintering();
  options.particles = 250;
  const FractalAggregate type(2200, sphereDiameter(options.material.volume(sphere)), 1.8);
  const Sample a = summarise(ofTrees(options, 20).number), b = summarise(ofType(type, options, 20).number);
  const double error = std::hypot(a.standardError, b.standardError);
  EXPECT_LT(std::abs(a.mean - b.mean), zLimit * error);
  EXPECT_LT(error, 0.05 * b.mean);
}

TEST(TreesInSpaceLikeOthersLong, WithoutSinteringAreFractalAggregatesInLaw) {
  const TreeOptions options = inSpaceWithoutSintering();
  const FractalAggregate type(2200, sphereDiameter(options.material.volume(sphere)), 1.8);
  expectSameLaw(ofTrees(options, 40), ofType(type, options, 40));
}

TEST(TreesInSpaceLikeOthers, ThatSinterAtOnceAreSpheresInLaw) {
  TreeOptions options = optionsOf(SinteringMechanism::constant, CollisionKernelType::freeMolecular);
  options.shape = TreeShape::spheres;
  options.particles = 250;
  const TreeUnits units = dry(options.material);
  expectSameLaw(ofTrees(options, 40, units), ofType(Sphere(2200), options, 40, units));
}

INSTANTIATE_TEST_SUITE_P(Kernels, TreesLikeOthers,
                         testing::Values(CollisionKernelType::freeMolecular, CollisionKernelType::transition));

}  // namespace
}  // namespace lampblack::test
