#include "particles/population/model/collision_kernel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "kernel_fixtures.hpp"

namespace lampblack::particles {
namespace {

using Type = CollisionKernelType;
using test::kernelOptions;
using test::sphere;

TEST(CollisionKernel, MathematicalKernelsAreWhatTheyAreCalled) {
  const auto u = sphere(2.0), v = sphere(3.0);
  EXPECT_DOUBLE_EQ(CollisionKernel(kernelOptions(Type::constant)).value(u, v), 2.5);
  EXPECT_DOUBLE_EQ(CollisionKernel(kernelOptions(Type::additive)).value(u, v), 2.5 * (u.volume + v.volume));
  EXPECT_DOUBLE_EQ(CollisionKernel(kernelOptions(Type::multiplicative)).value(u, v), 2.5 * u.volume * v.volume);
}

// Friedlander, Smoke, Dust, and Haze: the free-molecular kernel as
// (3/4pi)^(1/6) (6kT/rho)^(1/2) (1/u + 1/v)^(1/2) (u^(1/3) + v^(1/3))^2, the continuum one without slip as
// 2kT/(3 mu) (u^(-1/3) + v^(-1/3)) (u^(1/3) + v^(1/3)).
TEST(CollisionKernel, BrownianLimitsAreThoseInVolumes) {
  const auto i = sphere(3e-9, 1850), j = sphere(40e-9, 1850);
  const auto options = kernelOptions(Type::freeMolecular);
  const double kT = constants::boltzmann * options.gas.temperature;
  const double roots = std::cbrt(i.volume) + std::cbrt(j.volume);
  const double free = std::pow(3 / (4 * constants::pi), 1.0 / 6) * std::sqrt(6 * kT / 1850) *
                      std::sqrt(1 / i.volume + 1 / j.volume) * roots * roots;
  EXPECT_NEAR(CollisionKernel(options).value(i, j) / free, 1, 1e-14);

  auto dense = kernelOptions(Type::continuum);
  dense.gas.pressure = 1e20;  // no slip
  const double continuum =
      2 * kT / (3 * dense.gas.viscosity) * (1 / std::cbrt(i.volume) + 1 / std::cbrt(j.volume)) * roots;
  EXPECT_NEAR(CollisionKernel(dense).value(i, j) / continuum, 1, 1e-8);
}

TEST(CollisionKernel, TransitionTendsToItsLimits) {
  const auto i = sphere(10e-9), j = sphere(25e-9);
  for (const auto type : {Type::transition, Type::transitionFuchs}) {
    auto options = kernelOptions(type), limit = kernelOptions(Type::freeMolecular);
    options.gas.pressure = 1e-2;
    EXPECT_NEAR(CollisionKernel(options).value(i, j) / CollisionKernel(limit).value(i, j), 1, 1e-5) << nameOf(type);
    // Without slip the ratio of the limits falls with the root of the diameter; at 1 mm it is 1e-4.
    options.gas.pressure = 1e20;
    limit = kernelOptions(Type::continuum);
    limit.gas.pressure = 1e20;
    const auto big = sphere(1e-3), bigger = sphere(2e-3);
    EXPECT_NEAR(CollisionKernel(options).value(big, bigger) / CollisionKernel(limit).value(big, bigger), 1, 1e-3)
        << nameOf(type);
  }
}

// Seinfeld and Pandis (2006), table 13.3: coagulation coefficients of particles of
// 1 g/cm3 in air at 25 C by the formula of Fuchs, 1e-10 cm3/s, with two digits; 0.5 % more for the constants of air.
TEST(CollisionKernel, FuchsIsAsPrinted) {
  auto options = kernelOptions(Type::transitionFuchs);
  options.gas.viscosity = 1.8e-5;
  const CollisionKernel kernel(options);
  struct Printed {
    double di, dj, coefficient, halfDigit;
  };
  for (const auto& [di, dj, coefficient, halfDigit] : {Printed{2e-9, 2e-9, 8.9, 0.05},
                                                       {2e-9, 1e-8, 57, 0.5},
                                                       {2e-9, 1e-7, 3400, 50},
                                                       {1e-8, 1e-8, 19, 0.5},
                                                       {1e-7, 1e-7, 15, 0.5},
                                                       {1e-6, 1e-6, 6.9, 0.05},
                                                       {1e-5, 1e-5, 6.1, 0.05}}) {
    EXPECT_NEAR(1e16 * kernel.value(sphere(di), sphere(dj)), coefficient, halfDigit + 0.005 * coefficient);
  }
}

// Diffusion does not have to cover the last mean free path: Fuchs is above the harmonic mean, and the two meet in both
// limits. In air they differ by up to 19 % for equal spheres, near 25 nm.
TEST(CollisionKernel, FuchsIsAboveTheHarmonicMeanByLessThanAFifth) {
  const CollisionKernel fuchs(kernelOptions(Type::transitionFuchs)), mean(kernelOptions(Type::transition));
  const auto ratio = [&](double d) { return fuchs.value(sphere(d), sphere(d)) / mean.value(sphere(d), sphere(d)); };
  for (double d = 1e-9; d < 1e-5; d *= 1.1) {
    EXPECT_GT(ratio(d), 1) << d;
    EXPECT_LT(ratio(d), 1.2) << d;
  }
  EXPECT_LT(ratio(1e-9), 1.02);
  EXPECT_LT(ratio(1e-5), 1.02);
}

// The spheres with which the distance runs from nothing, l/2 for short free paths, to l, less half a diameter, for
// long.
TEST(CollisionKernel, FuchsDistanceHasItsLimits) {
  EXPECT_NEAR(fuchsDistance(1, 1e-4) / 0.5e-4, 1, 1e-4);
  EXPECT_NEAR(fuchsDistance(1, 1e4) - (1e4 - 0.5), 0, 1e-4);
  for (const double l : {0.01, 0.3, 1.0, 20.0}) {
    const double printed = (std::pow(1 + l, 3) - std::pow(1 + l * l, 1.5)) / (3 * l) - 1;
    EXPECT_NEAR(fuchsDistance(1, l) / printed, 1, 1e-11) << l;
  }
}

// Hand calculation of one pair: Gamma/6 (3e-6)^3 = 30/6 * 27e-18.
TEST(CollisionKernel, ShearGoesWithTheCubeOfTheSumOfDiameters) {
  EXPECT_NEAR(CollisionKernel(kernelOptions(Type::shear)).value(sphere(1e-6), sphere(2e-6)), 1.35e-16, 1e-28);
}

// A sphere of 10 um and 1 g/cm3 settles in air at 20 C with 3.06 mm/s (Hinds 1999, table A11).
TEST(CollisionKernel, SettlingParticlesSweepACylinder) {
  auto options = kernelOptions(Type::gravitational);
  options.gas.temperature = 293;
  options.gas.viscosity = 1.81e-5;
  const CollisionKernel kernel(options);
  const auto large = sphere(10e-6), small = sphere(1e-9);  // which hardly settles
  const double velocity = kernel.value(large, small) / (0.25 * constants::pi * std::pow(10e-6 + 1e-9, 2));
  EXPECT_NEAR(velocity, 3.06e-3, 0.02e-3);
  EXPECT_NEAR(kernel.value(large, large) / kernel.value(large, small), 0, 1e-14);
  // What is lighter than the gas rises as fast as what is as much heavier falls.
  auto heavyGas = kernelOptions(Type::gravitational);
  heavyGas.gas.density = 500;
  const CollisionKernel inHeavyGas(heavyGas);
  EXPECT_NEAR(
      inHeavyGas.value(sphere(1e-5, 1), sphere(1e-6, 1)) / inHeavyGas.value(sphere(1e-5, 999), sphere(1e-6, 999)), 1,
      1e-12);
}

TEST(CollisionKernel, EfficiencyIsOfTheSmallerParticle) {
  for (const auto type : {Type::constant, Type::freeMolecular}) {
    auto options = kernelOptions(type);
    const double whole = CollisionKernel(options).value(sphere(2e-9), sphere(50e-9));
    options.efficiency = 0.5;
    EXPECT_DOUBLE_EQ(CollisionKernel(options).value(sphere(2e-9), sphere(50e-9)), 0.5 * whole);
    options.efficiencyDiameter = 4e-9;
    options.efficiencyExponent = 3;
    const CollisionKernel kernel(options);
    EXPECT_TRUE(kernel.needsDiameter());
    EXPECT_NEAR(kernel.value(sphere(2e-9), sphere(50e-9)), 0.5 * whole / 9, 1e-14 * whole);
  }
}

TEST(CollisionKernel, KnowsWhichGel) {
  for (const auto type : test::allKernels) {
    const CollisionKernel kernel(kernelOptions(type));
    EXPECT_EQ(kernel.gels(), type == Type::multiplicative || type == Type::gravitational) << nameOf(type);
    EXPECT_EQ(kernel.gels(1.8), kernel.gels() || type == Type::shear) << nameOf(type);
  }
}

TEST(CollisionKernel, MissingGasIsNamed) {
  const auto message = [](const CollisionKernelOptions& options) -> std::string {
    try {
      const CollisionKernel kernel(options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  for (const auto type :
       {Type::freeMolecular, Type::continuum, Type::transition, Type::transitionFuchs, Type::gravitational}) {
    auto options = kernelOptions(type);
    options.gas.temperature = 0;
    EXPECT_EQ(message(options), "the " + std::string(nameOf(type)) + " kernel needs a temperature");
    if (type == Type::freeMolecular) continue;
    options = kernelOptions(type);
    options.gas.pressure = 0;
    EXPECT_EQ(message(options), "the " + std::string(nameOf(type)) + " kernel needs a pressure");
    options = kernelOptions(type);
    options.gas.viscosity = 0;
    EXPECT_EQ(message(options), "the " + std::string(nameOf(type)) + " kernel needs a viscosity");
    options = kernelOptions(type);
    options.gas.meanMolecularWeight = 0;
    EXPECT_EQ(message(options), "the " + std::string(nameOf(type)) + " kernel needs a mean molecular weight");
  }
  auto options = kernelOptions(Type::shear);
  options.shearRate = 0;
  EXPECT_EQ(message(options), "the shear kernel needs a shear rate");
  options = kernelOptions(Type::constant);
  options.rate = -1;
  EXPECT_THAT(message(options), testing::HasSubstr("not -1"));
  for (const double efficiency : {0.0, -0.1, 1.1}) {
    options = kernelOptions(Type::constant);
    options.efficiency = efficiency;
    EXPECT_THAT(message(options), testing::HasSubstr("(0, 1]"));
  }
}

}  // namespace
}  // namespace lampblack::particles
