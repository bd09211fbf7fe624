#include "particles/kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "soot_fixtures.hpp"

namespace lampblack {
namespace {

constexpr double density = 1850;

double massOf(double d) {
  return density * constants::pi / 6 * d * d * d;
}

SootGasState flameGas(double pressure = constants::oneAtmosphere) {
  test::FlameGas gas(1600, 0, 0, 0, 0, 0, 0, {});
  SootGasState state = gas.state;
  state.pressure = pressure;
  state.pah = {};
  return state;
}

TEST(Kernels, SlipCorrectionHasItsTwoLimits) {
  EXPECT_NEAR(slipCorrection(1e-6), 1, 2e-6);
  EXPECT_NEAR(slipCorrection(1e6) / (1.657e6), 1, 1e-6);
  EXPECT_NEAR(slipCorrection(1), 1 + 1.257 + 0.4 * std::exp(-1.1), 1e-15);
}

TEST(Kernels, MeanFreePathOfAirAtRoomConditions) {
  SootGasState air;
  air.temperature = 293.15;
  air.pressure = 101325;
  air.viscosity = 1.8193e-5;
  air.meanMolecularWeight = 28.964e-3;
  // Jennings (1988): 65.43 nm, with a coefficient of 0.4987 where the kinetic formula has 0.5.
  EXPECT_NEAR(meanFreePath(air), 65.43e-9 * 0.4987445 / 0.5, 0.05e-9);
}

TEST(Kernels, TransitionTendsToFreeMolecularAndToContinuum) {
  const double d = 10e-9, m = massOf(d);
  const SootGasState thin = flameGas(1e-2);
  const PairKernel transition(CoagulationKernel::transition, thin, 2.2);
  const auto x = transition.terms(m, d);
  EXPECT_NEAR(transition.value(x, x) / freeMolecularKernel(freeMolecularPrefactor(1600, 2.2), m, d, m, d), 1, 1e-5);

  const SootGasState dense = flameGas(1e9);
  const double big = 1e-5;
  const PairKernel heavy(CoagulationKernel::transition, dense, 2.2);
  const auto y = heavy.terms(massOf(big), big);
  const double smoluchowski = 8 * constants::boltzmann * 1600 / (3 * dense.viscosity);
  EXPECT_NEAR(heavy.value(y, y) / smoluchowski, 1, 0.01);  // fm is about 400 times larger here
}

TEST(Kernels, MonodisperseRateIsThatOfThesisEquation744) {
  // -1/2 beta N^2 with the kernel of equal spheres is the printed E_F sqrt(24 kT/rho) (6M/(pi rho))^(1/6) N^(11/6).
  const double d = 5e-9, m = massOf(d), N = 1e17, M = m * N, T = 1600;
  const double printed = 2.2 * std::sqrt(24 * constants::boltzmann * T / density) *
                         std::pow(6 * M / (constants::pi * density), 1.0 / 6) * std::pow(N, 11.0 / 6);
  const double derived = 0.5 * freeMolecularKernel(freeMolecularPrefactor(T, 2.2), m, d, m, d) * N * N;
  EXPECT_NEAR(derived / printed, 1, 1e-12);
}

TEST(Kernels, BothBoundsHoldForRandomPairsInEveryRegime) {
  RandomStream random(5, 0, 0);
  for (const double pressure : {1e1, 1e5, 1e8}) {
    const SootGasState gas = flameGas(pressure);
    for (const auto type : {CoagulationKernel::freeMolecular, CoagulationKernel::transition}) {
      for (const auto bound : {PairKernel::Bound::freeMolecular, PairKernel::Bound::continuum}) {
        if (type == CoagulationKernel::freeMolecular && bound == PairKernel::Bound::continuum) continue;
        const PairKernel kernel(type, gas, 2.2, bound);
        for (int k = 0; k < 20000; ++k) {
          const double di = std::pow(10, -9.5 + 4 * random.uniform()), dj = std::pow(10, -9.5 + 4 * random.uniform());
          const auto i = kernel.terms(massOf(di), di), j = kernel.terms(massOf(dj), dj);
          const double value = kernel.value(i, j);
          ASSERT_LE(value, kernel.bound(i, j) * (1 + 1e-14)) << di << " " << dj;
          if (type == CoagulationKernel::freeMolecular) {
            ASSERT_GE(value, 0.5 * kernel.bound(i, j) * (1 - 1e-14));
          }
        }
      }
    }
  }
}

TEST(Kernels, TransitionValueDoesNotDependOnTheBoundItIsWrittenIn) {
  const SootGasState gas = flameGas();
  const PairKernel one(CoagulationKernel::transition, gas, 2.2, PairKernel::Bound::freeMolecular);
  const PairKernel two(CoagulationKernel::transition, gas, 2.2, PairKernel::Bound::continuum);
  const double di = 3e-9, dj = 80e-9;
  const double a = one.value(one.terms(massOf(di), di), one.terms(massOf(dj), dj));
  const double b = two.value(two.terms(massOf(di), di), two.terms(massOf(dj), dj));
  EXPECT_NEAR(a / b, 1, 1e-13);
}

}  // namespace
}  // namespace lampblack
