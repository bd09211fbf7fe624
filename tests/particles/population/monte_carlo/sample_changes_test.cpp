// What events tell of what they change, and changes of some particles only, of methods with equal weights.
#include <gtest/gtest.h>

#include <cmath>

#include "core/modules.hpp"
#include "particles/population/model/sphere.hpp"
#include "particles/population/monte_carlo/class_store.hpp"
#include "particles/population/monte_carlo/equal_weight_method.hpp"

namespace lampblack::particles {
namespace {

using Method = EqualWeightMethod<Sphere, ClassStore<EqualRates<Sphere>>>;

Method spheres(RandomStream& random) {
  PopulationModel model;
  model.coagulation.emplace();
  model.coagulation->type = CollisionKernelType::transition;
  model.coagulation->gas = {1500, 1e5, 0.2, 5e-5, 0.028};
  model.growth.oxidation = 1;
  MonteCarloOptions options;
  options.method = MonteCarloMethod::dsmc;
  options.particles = 64;
  options.expectedNumber = 1e15;
  options.nucleusWeight = 1;
  Method method(Sphere(1800), model, InitialPopulation{}, options, random);
  method.setNucleus({1e-27});
  return method;
}

double diameters(const Method& method) {
  double sum = 0;
  method.forEachParticle([&](const Sphere::Particle& p, double) { sum += std::cbrt(p.volume); });
  return sum;
}

// Births, coagulation, particles that are taken out where there is no room, doubling.
TEST(SampleChanges, AreAllThatEventsDo) {
  RandomStream random(1, 0, 1);
  Method method = spheres(random);
  SampleChanges<Sphere::Particle> changes;
  for (int round = 0; round < 400; ++round) {
    const double before = diameters(method), number = static_cast<double>(method.size());
    changes.clear();
    method.watch(&changes);
    const int births = round % 50 < 25 ? 12 : 1;  // fills up, coagulates, fills up again
    for (int k = 0; k < births; ++k) method.nucleate(random);
    for (int k = 0; k < 6 && method.size() > 2; ++k) (void)method.coagulate(random);
    method.watch(nullptr);
    double told = changes.factor * before, count = changes.factor * number;
    for (std::size_t k = 0; k < changes.particles.size(); ++k) {
      told += changes.copies[k] * std::cbrt(changes.particles[k].volume);
      count += changes.copies[k];
    }
    ASSERT_NEAR(told, diameters(method), 1e-12 * diameters(method)) << round;
    ASSERT_EQ(count, static_cast<double>(method.size())) << round;
  }
  EXPECT_GT(method.counters().doublings, 2u);
  EXPECT_GT(method.counters().removals, 100u);
  changes.clear();
  method.nucleate(random);
  EXPECT_TRUE(changes.particles.empty());  // nobody watches
}

// The majorant holds for nuclei and others when a kernel of another gas comes, and after particles grew.
TEST(SampleChanges, LeaveAMajorantThatHolds) {
  RandomStream random(2, 0, 1);
  Method method = spheres(random);
  for (int k = 0; k < 64; ++k) method.nucleate(random);
  for (int round = 0; round < 60; ++round) {
    CollisionKernelOptions kernel;
    kernel.type = CollisionKernelType::transition;
    kernel.gas = {1500 + 10.0 * (round % 7), round % 2 == 0 ? 1e5 : 3e7, 0.2, 5e-5, 0.028};
    method.setKernel(kernel);
    for (int k = 0; k < 20; ++k) method.nucleate(random);
    for (int k = 0; k < 30; ++k) (void)method.coagulate(random);  // throws where a bound does not hold
    std::vector<std::uint32_t> which;
    // All, so that the class of nuclei is empty when the next kernel comes; or some.
    const std::uint32_t stride = round % 4 == 3 ? 3 : 1;
    for (std::uint32_t k = 0; k < method.size(); k += stride) which.push_back(k);
    const auto vanished = method.counters().vanished;
    const std::size_t size = method.size();
    method.changeSome(which, [&](Sphere::Particle& p, std::size_t k) {
      p.volume *= 1.3;
      return k > 0;
    });
    EXPECT_EQ(method.counters().vanished, vanished + 1);
    EXPECT_EQ(method.size(), size - 1);
    const double rate = method.coagulationRate();
    for (int k = 0; k < 30; ++k) (void)method.coagulate(random);
    EXPECT_GT(rate, 0);
  }
}

}  // namespace
}  // namespace lampblack::particles
