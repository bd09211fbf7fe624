#include "particles/spheres/sphere_population.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/errors.hpp"
#include "particles/population/model/fractal_aggregate.hpp"
#include "particles/population/model/sphere.hpp"
#include "particles/population/monte_carlo/shipped_types.hpp"
#include "particles/spheres/sphere_geometry.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/statistics.hpp"

namespace lampblack::particles {
namespace {

using test::summarise;
using test::zLimit;

const CarrierGas hotGas{1500, constants::oneAtmosphere, 0.235, 5.5e-5, 0.02897};
constexpr double someNumber = 1e17;  // 1/m3
constexpr double primaryRadius = 5e-9;

SpherePopulationOptions someOptions(std::uint64_t owner) {
  SpherePopulationOptions options;
  options.particles = 64;
  options.owner = owner;
  options.density = 2000;
  options.kernel.type = CollisionKernelType::freeMolecular;
  return options;
}

SpherePopulation someSpheres(const SpherePopulationOptions& options) {
  SpherePopulation population(options);
  population.fill(std::vector<double>(options.particles, primaryRadius), someNumber);
  return population;
}

double numberOf(const SpherePopulation& population) {
  return population.weight() * static_cast<double>(population.size());
}

// Number densities after a time of spheres in space, and of a type of particles without places.
template <class Type>
void expectSameNumbers(const Type& type, const SpherePopulationOptions& options, double time, double tolerance) {
  std::vector<double> inSpace, without;
  for (std::uint64_t repeat = 0; repeat < 30; ++repeat) {
    SpherePopulationOptions own = options;
    own.owner = repeat;
    SpherePopulation population = someSpheres(own);
    population.advance(hotGas, {}, time);
    inSpace.push_back(numberOf(population));
    PopulationModel model;
    model.coagulation = options.kernel;
    model.coagulation->gas = hotGas;
    model.density = options.density;
    MonteCarloOptions monteCarlo;
    monteCarlo.method = MonteCarloMethod::dsmc;
    monteCarlo.particles = options.particles;
    monteCarlo.seed = 100 + repeat;
    const auto other = makeMonteCarlo(
        type, model,
        InitialPopulation{InitialPopulation::Distribution::monodisperse, someNumber, volumeOfRadius(primaryRadius)},
        monteCarlo);
    other->advance(time);
    without.push_back(other->moments()[0]);
  }
  const auto one = summarise(inSpace), two = summarise(without);
  EXPECT_LT(std::abs(one.mean - two.mean), zLimit * std::hypot(one.standardError, two.standardError));
  EXPECT_LT(one.mean, 0.2 * someNumber);
  EXPECT_LT(one.standardError, tolerance * one.mean);
}

TEST(SpherePopulation, CollidesAsAggregatesWithoutPlacesDo) {
  SpherePopulationOptions options = someOptions(0);
  options.size = SphereCollisionSize::fractal;
  options.fractalDimension = 1.8;
  expectSameNumbers(FractalAggregate(2000, 2 * primaryRadius, 1.8), options, 2e-2, 0.05);
}

TEST(SpherePopulation, SinteredAtOnceItCollidesAsSpheresDo) {
  SpherePopulationOptions options = someOptions(0);
  options.sintering = {SinteringMechanism::constant, 1e-9, 0, 0};
  expectSameNumbers(Sphere(2000), options, 2.5e-2, 0.05);
}

TEST(SpherePopulation, ConservesVolumeAndKnowsItsParticles) {
  SpherePopulation population = someSpheres(someOptions(3));
  population.advance(hotGas, {}, 2e-2);
  double volume = 0, spheres = 0;
  population.forEach([&](const SphereParticle& p) {
    volume += population.weight() * p.volume;
    spheres += population.weight() * static_cast<double>(p.aggregate->count());
    EXPECT_NEAR(p.surface, p.aggregate->surface(), 1e-12 * p.surface);
    if (p.aggregate->count() == 2) {
      EXPECT_GT(p.collision, 2 * primaryRadius);
      EXPECT_LE(p.collision, 2 * std::sqrt(2) * primaryRadius * (1 + 1e-12));
    }
  });
  EXPECT_NEAR(volume / (someNumber * volumeOfRadius(primaryRadius)), 1, 0.05);  // doubling keeps it, contraction not
  EXPECT_NEAR(spheres / someNumber, volume / (someNumber * volumeOfRadius(primaryRadius)), 1e-9);
  EXPECT_GE(population.tries(), population.collisions());
  EXPECT_GT(population.collisions(), 32U);
}

TEST(SpherePopulation, BirthsAndGrowthAreWhatTheGasSays) {
  SpherePopulationOptions options = someOptions(4);
  options.coagulation = false;
  options.fullAt = 1e18;
  SpherePopulation population(options);
  const SphereSources sources{1e20, volumeOfRadius(1e-9), 0};
  population.advance(hotGas, sources, 5e-3);
  EXPECT_NEAR(numberOf(population) / 5e17, 1, 2.0 / 32);
  population.advance(hotGas, {0, 0, 1e-7}, 3e-2);
  population.forEach([](const SphereParticle& p) {
    EXPECT_NEAR(p.volume, volumeOfRadius(4e-9), 1e-10 * p.volume);
    EXPECT_NEAR(p.collision, 8e-9, 1e-18);
  });
}

TEST(SpherePopulation, IsTheSameAgain) {
  std::vector<double> volumes;
  for (int k = 0; k < 2; ++k) {
    SpherePopulation population = someSpheres(someOptions(5));
    population.advance(hotGas, {}, 1e-3);
    double sum = 0;
    population.forEach([&](const SphereParticle& p) { sum += p.collision * p.volume * p.aggregate->reach(); });
    volumes.push_back(sum);
  }
  EXPECT_EQ(volumes[0], volumes[1]);
}

TEST(SpherePopulation, CanBeStoppedBetweenEvents) {
  SpherePopulation population = someSpheres(someOptions(6));
  int looks = 0;
  population.setCallback([&] {
    if (++looks == 5) throw NumericsError("enough");
  });
  EXPECT_THROW(population.advance(hotGas, {}, 1e-2), NumericsError);
  EXPECT_EQ(looks, 5);
}

TEST(SpherePopulation, RefusesWhatHasNoMeaning) {
  SpherePopulationOptions options = someOptions(0);
  options.particles = 4;
  EXPECT_THROW(SpherePopulation{options}, InputError);
  options = someOptions(0);
  options.density = 0;
  EXPECT_THROW(SpherePopulation{options}, InputError);
  SpherePopulation population = someSpheres(someOptions(0));
  EXPECT_THROW(population.advance(hotGas, {1, 0, 0}, 1), InputError);
  EXPECT_THROW(population.advance(hotGas, {0, 0, -1}, 1), InputError);
}

}  // namespace
}  // namespace lampblack::particles
