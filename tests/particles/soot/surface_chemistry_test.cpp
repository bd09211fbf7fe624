#include "particles/soot/surface_chemistry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <utility>

#include "core/modules.hpp"
#include "tests/particles/soot_fixtures.hpp"

namespace lampblack::particles {
namespace {

TEST(SurfaceChemistry, ActiveFractionUsesTheDecimalLogarithmAndStaysInItsBounds) {
  // T = 1600 K, mu1 = 1e4: a = 3.642, b = -0.292, tanh(3.642/4 - 0.292).
  EXPECT_NEAR(activeSiteFraction(1600, 1e4), std::tanh(3.642 / 4 - 0.292), 1e-14);
  for (double T = 300; T < 3500; T += 50) {
    for (double mu = 2; mu < 1e12; mu *= 7) {
      const double alpha = activeSiteFraction(T, mu);
      ASSERT_GE(alpha, 0);
      ASSERT_LE(alpha, 1);
    }
  }
}

// What the rates are multiplied with: Wang (2025), eqs. 7-47 to 7-49, worked out by hand.
TEST(SurfaceChemistry, AlphaOfTheModelIsThatOfAppelBockhornAndFrenklach) {
  const SootModelOptions options;
  for (const auto& [T, a, b] : {std::tuple{1400.0, 4.768, -0.428}, {1600.0, 3.642, -0.292}, {1900.0, 1.953, -0.088}})
    for (const double mu : {60.0, 1e4, 1e7})
      EXPECT_NEAR(SurfaceChemistry(options, T).alpha(mu), std::tanh(a / std::log10(mu) + b), 1e-14) << T << " " << mu;
}

TEST(SurfaceChemistry, AlphaOfATableIsStraightInBetweenAndConstantOutside) {
  SootModelOptions options;
  options.alphaTable = {{1500, 0.9}, {1700, 0.5}, {1800, 0.1}};
  for (const auto& [T, expected] : {std::pair{300.0, 0.9},
                                    {1500.0, 0.9},
                                    {1550.0, 0.8},
                                    {1700.0, 0.5},
                                    {1775.0, 0.2},
                                    {1800.0, 0.1},
                                    {2500.0, 0.1}})
    EXPECT_NEAR(SurfaceChemistry(options, T).alpha(1e4), expected, 1e-15) << T;
  options.alpha = 0.3;  // a constant comes first
  EXPECT_EQ(SurfaceChemistry(options, 1550).alpha(1e4), 0.3);
}

// Other constants than the published: each where it belongs, and radical sites bounded by the sites there are.
TEST(SurfaceChemistry, ConstantsOfTheOptionsTakeThePlaceOfThePublished) {
  const test::FlameGas gas(1700, 1e-3, 0.03, 1e-4, 0.08, 0.2, 0.03, {});
  const auto ratesOf = [&](const SurfaceRateConstants& constants) {
    SootModelOptions options;
    options.surface = constants;
    return SurfaceChemistry(options, 1700).rates(gas.concentrations, 0.4);
  };
  const SurfaceRates published = ratesOf({});
  // Radical sites over C-H sites, from the growth: alpha sites r k.
  const double k4 = 80 * std::pow(1700.0, 1.56) * std::exp(-3.8 / (1.98720425864083e-3 * 1700));
  const double sites = 0.4 * 2.3e19 / constants::avogadro, r = published.growth / (sites * k4);
  ASSERT_GT(r, 1e-3);
  SurfaceRateConstants bounded;
  bounded.bounded = true;
  EXPECT_NEAR(ratesOf(bounded).growth / (sites * k4), r / (1 + r), 1e-6 * r);
  EXPECT_NEAR(ratesOf(bounded).oxidationO2 / published.oxidationO2, 1 / (1 + r), 1e-9);
  EXPECT_EQ(ratesOf(bounded).oxidationOH, published.oxidationOH);
  // O2 that closes no site: oxidation at the same constant of more radical sites.
  SurfaceRateConstants open;
  open.closeByO2 = RateConstant{0, 0, 0};
  const double more = ratesOf(open).growth / published.growth;
  EXPECT_GT(more, 1.05);
  EXPECT_NEAR(ratesOf(open).oxidationO2 / published.oxidationO2, more, 1e-12);
  SurfaceRateConstants twice;
  twice.closeByO2 = RateConstant{4.4e12, 0, 7.5};
  // 1/growth is linear in what closes.
  EXPECT_NEAR(1 / ratesOf(twice).growth - 1 / published.growth, 1 / published.growth - 1 / ratesOf(open).growth,
              1e-9 / published.growth);
  SurfaceRateConstants growing;
  growing.growth.A = 0;
  EXPECT_EQ(ratesOf(growing).growth, 0);
  EXPECT_GT(ratesOf(growing).oxidationO2, published.oxidationO2);
}

TEST(SurfaceChemistry, RatesAreThoseOfTheTableWorkedOutInMolesAndCentimetres) {
  const test::FlameGas gas(1700, 1e-3, 0.03, 1e-4, 0.08, 2e-4, 0.03, {});
  const SootModelOptions options;
  const SurfaceChemistry chemistry(options, 1700);
  const double alpha = 0.4;
  const SurfaceRates rates = chemistry.rates(gas.concentrations, alpha);

  const auto k = [](double A, double n, double E) {
    return A * std::pow(1700.0, n) * std::exp(-E / (1.98720425864083e-3 * 1700));
  };
  const auto c = [](double x) { return x * 1e-6; };  // mol/cm3
  using S = SootSpecies;
  const double open = k(4.2e13, 0, 13) * c(gas[S::H]) + k(1e10, 0.734, 1.43) * c(gas[S::OH]);
  const double close = k(3.9e12, 0, 11) * c(gas[S::H2]) + k(3.68e8, 1.139, 17.1) * c(gas[S::H2O]) +
                       k(2e13, 0, 0) * c(gas[S::H]) + k(8e7, 1.56, 3.8) * c(gas[S::C2H2]) +
                       k(2.2e12, 0, 7.5) * c(gas[S::O2]);
  const double radicals = alpha * 2.3e15 / constants::avogadro * open / close;  // mol/cm2
  const double growth = k(8e7, 1.56, 3.8) * c(gas[S::C2H2]) * radicals * 1e4;   // mol/m2/s
  EXPECT_NEAR(rates.growth * gas[S::C2H2] / growth, 1, 1e-9);
  EXPECT_NEAR(rates.oxidationO2 * gas[S::O2] / (k(2.2e12, 0, 7.5) * c(gas[S::O2]) * radicals * 1e4), 1, 1e-9);
}

TEST(SurfaceChemistry, HydroxylOxidationIsTheCollisionRateTimesItsEfficiency) {
  const test::FlameGas gas(1700, 0, 0, 1e-3, 0, 0, 0, {});
  const SurfaceChemistry chemistry(SootModelOptions{}, 1700);
  const double meanSpeed = std::sqrt(8 * constants::gasConstant * 1700 / (constants::pi * 17.007e-3));
  EXPECT_NEAR(chemistry.rates(gas.concentrations, 0.0).oxidationOH, 0.13 * meanSpeed / 4, 1e-10);
}

TEST(SurfaceChemistry, WithoutAnySpeciesNothingHappens) {
  const SurfaceChemistry chemistry(SootModelOptions{}, 1700);
  const SurfaceRates rates = chemistry.rates(SootSpeciesArray{}, 1.0);
  EXPECT_EQ(rates.growth, 0);
  EXPECT_EQ(rates.oxidationO2, 0);
}

}  // namespace
}  // namespace lampblack::particles
