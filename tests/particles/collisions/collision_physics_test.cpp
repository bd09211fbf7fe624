#include "particles/collisions/collision_physics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/modules.hpp"

namespace lampblack::particles {
namespace {

constexpr double density = 1850;

TEST(CollisionPhysics, SlipCorrectionHasItsTwoLimits) {
  EXPECT_NEAR(slipCorrection(1e-6), 1, 2e-6);
  EXPECT_NEAR(slipCorrection(1e6) / (1.657e6), 1, 1e-6);
  EXPECT_NEAR(slipCorrection(1), 1 + 1.257 + 0.4 * std::exp(-1.1), 1e-15);
}

TEST(CollisionPhysics, MeanFreePathOfAirAtRoomConditions) {
  CarrierGas air;
  air.temperature = 293.15;
  air.pressure = 101325;
  air.viscosity = 1.8193e-5;
  air.meanMolecularWeight = 28.964e-3;
  // Jennings (1988): 65.43 nm, with a coefficient of 0.4987 where the kinetic formula has 0.5.
  EXPECT_NEAR(meanFreePath(air), 65.43e-9 * 0.4987445 / 0.5, 0.05e-9);
}

TEST(CollisionPhysics, MonodisperseRateIsThatOfWang2025Equation744) {
  // -1/2 beta N^2 with the kernel of equal spheres is the printed E_F sqrt(24 kT/rho) (6M/(pi rho))^(1/6) N^(11/6).
  const double d = 5e-9, m = density * constants::pi / 6 * d * d * d, N = 1e17, M = m * N, T = 1600;
  const double printed = 2.2 * std::sqrt(24 * constants::boltzmann * T / density) *
                         std::pow(6 * M / (constants::pi * density), 1.0 / 6) * std::pow(N, 11.0 / 6);
  const double derived = 0.5 * freeMolecularKernel(freeMolecularPrefactor(T, 2.2), m, d, m, d) * N * N;
  EXPECT_NEAR(derived / printed, 1, 1e-12);
}

}  // namespace
}  // namespace lampblack::particles
