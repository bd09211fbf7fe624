// The shipped types of particles through the methods, where one type has to follow the same law as another one.
#include "particles/population/monte_carlo/shipped_types.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "../../statistics.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"

namespace lampblack::particles {
namespace {

using Moments = std::array<double, 4>;

constexpr double number = 1e18;                          // 1/m3
constexpr double primary = constants::pi / 6 * 125e-27;  // m3, of 5 nm

InitialPopulation primaries() {
  InitialPopulation initial;
  initial.distribution = InitialPopulation::Distribution::monodisperse;
  initial.number = number;
  initial.volume = primary;
  return initial;
}

PopulationModel coagulating(CollisionKernelType kernel) {
  PopulationModel model;
  model.coagulation.emplace().type = kernel;
  model.coagulation->gas = {
      .temperature = 1500, .pressure = 101325, .density = 0.23, .viscosity = 5.5e-5, .meanMolecularWeight = 0.028};
  return model;
}

template <class Type>
Moments solved(const Type& type, const PopulationModel& model, MonteCarloMethod method, std::uint64_t repeat = 0) {
  MonteCarloOptions options;
  options.method = method;
  options.particles = 300;
  options.repeat = repeat;
  const auto solver = makeMonteCarlo(type, model, primaries(), options);
  solver->advance(4e-3);
  return solver->moments();
}

constexpr std::array someMethods = {MonteCarloMethod::dsmc, MonteCarloMethod::sammc};

// Means of M0 and M2 over independent repeats of the two types agree.
template <class One, class Other>
void expectSameLaw(const One& one, const Other& other, const PopulationModel& model, MonteCarloMethod method) {
  for (const std::size_t k : {0, 2}) {
    std::vector<double> x, y;
    for (std::uint64_t repeat = 0; repeat < 20; ++repeat) {
      x.push_back(solved(one, model, method, repeat)[k]);
      y.push_back(solved(other, model, method, 1000 + repeat)[k]);
    }
    const auto a = test::summarise(x), b = test::summarise(y);
    EXPECT_LT(std::abs(a.mean - b.mean), 4 * std::hypot(a.standardError, b.standardError)) << k;
  }
}

// Aggregates of equal primaries that nothing but coagulation (and merging, in which surface stays proportional to
// volume) happens to are the same whether the primary is a constant or found from the surface.
TEST(ShippedTypes, SurfaceAndVolumeOfEqualPrimariesIsTheFractalAggregate) {
  const PopulationModel model = coagulating(CollisionKernelType::transitionFuchs);
  for (const auto method : someMethods) {
    expectSameLaw(FractalAggregate(1800, 5e-9, 1.8), SurfaceVolume(1800, 1.8), model, method);
  }
}

TEST(ShippedTypes, ComponentsOfOneDensityAreTheSphere) {
  PopulationModel model = coagulating(CollisionKernelType::transition);
  model.growth.condensation = 300;
  const std::array densities{1800.0, 1800.0};
  const Components components(densities, std::array{1.0, 0.0}, std::array{0.2, 0.8});
  for (const auto method : someMethods) {
    expectSameLaw(Sphere(1800), components, model, method);
    EXPECT_NEAR(solved(components, model, method)[1] / (number * primary * std::exp(1.2)), 1, 1e-9);
  }
}

// Open structures collide more often; those that sinter within a small part of the time between collisions do not.
TEST(ShippedTypes, SinteringFastGivesSpheresBack) {
  const PopulationModel model = coagulating(CollisionKernelType::freeMolecular);
  PopulationModel sintering = model;
  sintering.growth.always = true;
  sintering.growth.step = 2e-5;
  double spheres = 0, aggregates = 0, sintered = 0;
  for (std::uint64_t repeat = 0; repeat < 8; ++repeat) {
    spheres += solved(Sphere(1800), model, MonteCarloMethod::dsmc, repeat)[0];
    aggregates += solved(SurfaceVolume(1800), model, MonteCarloMethod::dsmc, repeat)[0];
    sintered += solved(SurfaceVolume(1800, 1.8, 1e-7), sintering, MonteCarloMethod::dsmc, repeat)[0];
  }
  EXPECT_LT(aggregates, 0.8 * spheres);
  // M0 has a standard error of about 1/sqrt(8 * 300) of itself in either, and in a step 1 % of the particles are new.
  EXPECT_NEAR(sintered / spheres, 1, 4 * std::sqrt(2.0 / 2400) + 0.01);
}

TEST(ShippedTypes, TheHybridRefusesParticlesThatAreMoreThanTheirVolume) {
  const PopulationModel model = coagulating(CollisionKernelType::freeMolecular);
  MonteCarloOptions options;
  options.method = MonteCarloMethod::hybrid;
  options.threshold = 3;
  const std::array one{1.0};
  EXPECT_THROW((void)makeMonteCarlo(SurfaceVolume(1800), model, primaries(), options), InputError);
  EXPECT_THROW((void)makeMonteCarlo(Components(one, one, one), model, primaries(), options), InputError);
  EXPECT_NO_THROW((void)makeMonteCarlo(FractalAggregate(1800, 5e-9), model, primaries(), options));
}

}  // namespace
}  // namespace lampblack::particles
