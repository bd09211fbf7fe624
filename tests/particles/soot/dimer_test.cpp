#include "particles/soot/dimer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "particles/soot/soot_medium.hpp"
#include "tests/particles/soot_fixtures.hpp"

namespace lampblack::particles {
namespace {

TEST(Dimers, SteadyNumberSolvesTheQuadraticOverTwentyDecades) {
  for (double production = 1e5; production < 1e26; production *= 97) {
    for (double condensation = 1e-12; condensation < 1e12; condensation *= 31) {
      const double self = 3.3e-15;
      const double n = steadyDimers(production, self, condensation);
      ASSERT_GT(n, 0);
      // Both terms are positive, so that the residual has no cancellation: a few units in the last place.
      ASSERT_NEAR((self * n + condensation) * n / production, 1, 8e-16) << production << " " << condensation;
    }
  }
}

TEST(Dimers, LimitsAreNucleationOnlyAndCondensationOnly) {
  EXPECT_DOUBLE_EQ(steadyDimers(4e20, 1e-15, 0), std::sqrt(4e20 / 1e-15));
  EXPECT_DOUBLE_EQ(steadyDimers(4e20, 0, 2e5), 2e15);
  EXPECT_EQ(steadyDimers(0, 1e-15, 1), 0);
}

TEST(Dimers, StickingCoefficientsFollowTheTableAndItsFourthPowerLaw) {
  EXPECT_EQ(defaultStickingCoefficient("A2").value(), 2.0e-3);
  EXPECT_EQ(defaultStickingCoefficient("A4").value(), 2.5e-2);
  EXPECT_FALSE(defaultStickingCoefficient("CH4").has_value());
  // The table's A3 and A4 to the two digits it prints.
  EXPECT_NEAR(stickingCoefficientByMass(0.178234), 1.5e-2, 0.05e-2);
  EXPECT_NEAR(stickingCoefficientByMass(0.202256), 2.5e-2, 0.05e-2);
}

TEST(Dimers, DensityOfSheetsTendsToGraphite) {
  EXPECT_NEAR(pahDensity(1000000, 1), 2270, 15);  // graphite, 2.26 to 2.27 g/cm3
  EXPECT_LT(pahDensity(10, 8), pahDensity(24, 12));
}

TEST(Dimers, ProductionConservesTheAtomsOfThePahConsumed) {
  const SootModelOptions options = test::threePah();
  const DimerModel model(options);
  const std::vector<double> pah = {2e-4, 3e-5, 1e-5};
  PahArray loss{}, consumption{};
  model.lossRates(1650, pah, loss);
  double carbon = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    consumption[i] = loss[i] * pah[i];
    carbon += model.carbonAtoms(i) * consumption[i];
  }
  const DimerProduction dimer = model.production(1650, {consumption.data(), 3});
  EXPECT_NEAR(dimer.rate * dimer.carbon / (carbon * constants::avogadro), 1, 4e-16);
}

TEST(Dimers, RateOfOnePahIsHalfTheStickingKineticTheoryRate) {
  const DimerModel model(test::naphthalene());
  const std::vector<double> pah = {1e-4};
  const double T = 1500;
  PahArray loss{};
  model.lossRates(T, pah, loss);
  const std::vector<double> consumption = {loss[0] * pah[0]};
  const double m = (10 * 12.011e-3 + 8 * 1.008e-3) / constants::avogadro;
  const double d = std::cbrt(6 * m / (constants::pi * pahDensity(10, 8)));
  const double n = pah[0] * constants::avogadro;
  const double meanRelativeSpeed = std::sqrt(8 * constants::boltzmann * T / (constants::pi * 0.5 * m));
  const double collisions = 0.5 * n * n * constants::pi * d * d * meanRelativeSpeed;
  EXPECT_NEAR(model.production(T, consumption).rate / (2.0e-3 * collisions), 1, 1e-13);
}

// Equal spheres of soot density, mass m and diameter d: sqrt(pi k T / m) (2 d)^2 times the enhancement; a particle of
// eight dimers: sqrt(pi k T / (2 m)) sqrt(9/8) (3 d)^2.
TEST(Dimers, CollideWithEachOtherAndWithParticlesAtTheEnhancedKineticRate) {
  SootModelOptions options = test::naphthalene();
  const double T = 1500, m = 2 * (10 * 12.011e-3 + 8 * 1.008e-3) / constants::avogadro;
  const double d = std::cbrt(6 * m / (constants::pi * 1850));
  for (const double enhancement : {1.0, 2.2}) {
    options.vanDerWaals = enhancement;
    const DimerModel model(options);
    const DimerProduction dimer = model.production(T, std::vector<double>{1e-3});
    EXPECT_NEAR(dimer.mass / m, 1, 1e-14);
    const double speed = std::sqrt(constants::pi * constants::boltzmann * T / m);
    EXPECT_NEAR(dimer.selfCollision / (enhancement * speed * 4 * d * d), 1, 1e-13);
    const double onto = DimerModel::particleCollision(dimer, freeMolecularPrefactor(T, enhancement), 8 * m, 2 * d);
    EXPECT_NEAR(onto / (enhancement * speed * std::sqrt(0.5 * 9.0 / 8) * 9 * d * d), 1, 1e-13);
  }
}

// Without other losses than coming apart dimers are in equilibrium, whatever their rate; with collisions, by the
// quadratic.
TEST(Dimers, ComeApartIntoEquilibrium) {
  SootModelOptions options = test::threePah();
  options.dimerEquilibrium = {2e-2, 0.5, -9};
  const double T = 1500, K = 2e-8 * std::sqrt(T) * std::exp(9e3 * 4.184 / (constants::gasConstant * T));  // m3/mol
  const test::FlameGas gas(T, 1e-4, 0.1, 0, 0.1, 0, 0.05, {1e-4, 2e-5, 1e-5});
  double c = 0;
  for (const double x : gas.pah()) c += x;
  const DimerModel model(options);
  const double rate = 1e22, breaking = model.breaking(T, rate, gas.pah());
  EXPECT_NEAR(rate / breaking / (constants::avogadro * K * c * c), 1, 1e-12);
  EXPECT_EQ(DimerModel(test::threePah()).breaking(T, rate, gas.pah()), 0);
  const SootMedium medium(options, model, gas.state, true);
  const double made = medium.dimer().rate, apart = model.breaking(T, made, gas.pah());
  for (const double collisions : {0.0, 0.3 * apart, 1e3 * apart}) {
    const double n = medium.dimers(collisions);
    EXPECT_NEAR((medium.dimer().selfCollision * n + collisions + apart) * n / made, 1, 1e-12);
  }
  // Soot takes what does not come apart.
  EXPECT_LT(medium.inception(0), 0.9 * 0.5 * made);
}

TEST(Dimers, TooManyOrMeaninglessPahAreRefused) {
  SootModelOptions options;
  options.pah.assign(maximumPahSpecies + 1, {"A2", 10, 8, 2e-3});
  EXPECT_THROW(DimerModel{options}, InputError);
  options.pah = {{"X", 0, 2, 1e-3}};
  EXPECT_THROW(DimerModel{options}, InputError);
}

}  // namespace
}  // namespace lampblack::particles
