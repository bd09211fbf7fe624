// Every kind of rate constant against the plain formulas, its limits, and the errors.
#include "tests/chemistry/kinetics_rate_types.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "chemistry/kinetics/kinetics.hpp"
#include "chemistry/kinetics/kinetics_powers.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "tests/chemistry/kinetics_reference.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::ethylene;
using lampblack::test::hydrogen;
using lampblack::test::measured;
using lampblack::test::plainArrhenius;
using lampblack::test::plainRates;
using lampblack::test::raise;
using lampblack::test::RateTypes;

// Uneven concentrations with the sum p/RT.
std::vector<double> uneven(std::size_t n, double T, double p) {
  std::vector<double> c(n);
  for (std::size_t k = 0; k < n; ++k) c[k] = 1.0 + static_cast<double>((k * 7) % 11);
  const double sum = std::accumulate(c.begin(), c.end(), 0.0);
  for (double& value : c) value *= p / (constants::gasConstant * T) / sum;
  return c;
}

// The forward constant of a mechanism's only reaction, in pure argon.
double constantInArgon(Kinetics& kinetics, double T, double p) {
  std::vector<double> c(kinetics.numSpecies(), 0.0), kf(1), kr(1);
  c[hydrogen().speciesIndex("AR")] = p / (constants::gasConstant * T);
  kinetics.rateConstants(T, c, kf, kr);
  return kf[0];
}

template <class Error>
std::string messageOf(const Reaction& reaction, double T) {
  try {
    const auto mechanism = RateTypes::withOnly(reaction);
    Kinetics kinetics(mechanism);
    constantInArgon(kinetics, T, 1e5);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// Long double carries 64 bits here: its own error is a thousandth of what is allowed. Constants below 1e-290 have left
// the range of doubles with a full mantissa and add nothing to any rate.
TEST(KineticsRateTypes, ConstantsAreThePlainFormulasFrom200To4000K) {
  const auto all = RateTypes::mechanism();
  const auto methane = Mechanism::fromFile(lampblack::test::sourcePath("cases/mechanisms/methane_gri30_53.yaml"));
  const auto coronene = Mechanism::fromFile(lampblack::test::sourcePath("cases/mechanisms/ethylene_km2_202.yaml"));
  double worst = 0;
  for (const auto* mechanism : {&all, &ethylene(), &methane, &coronene}) {
    Kinetics kinetics(*mechanism);
    const std::size_t n = mechanism->numReactions();
    std::vector<double> kf(n), kr(n);
    for (double T = 200; T <= 4000; T += 190)
      for (const double p : {1e2, 1.013e5, 3e6, 2e8}) {
        const auto c = uneven(mechanism->numSpecies(), T, p);
        kinetics.rateConstants(T, c, kf, kr);
        const auto plain = plainRates<long double>(*mechanism, T, {c.begin(), c.end()});
        for (std::size_t r = 0; r < n; ++r) {
          const double forward = static_cast<double>(kf[r] / plain.kf[r] - 1);
          raise(worst, forward);
          EXPECT_LT(std::abs(forward), 1e-11) << mechanism->reaction(r).equation << " at " << T << " K, " << p;
          if (std::abs(plain.kr[r]) < 1e-290L) {
            EXPECT_LT(std::abs(kr[r]), 1e-289);
            continue;
          }
          const double reverse = static_cast<double>(kr[r] / plain.kr[r] - 1);
          raise(worst, reverse);
          EXPECT_LT(std::abs(reverse), 1e-11) << mechanism->reaction(r).equation << " at " << T << " K, " << p;
        }
      }
  }
  measured("rate constants, relative", worst);
}

TEST(KineticsRateTypes, ProductionRatesAreThePlainSums) {
  const auto mechanism = RateTypes::mechanism();
  Kinetics kinetics(mechanism);
  const std::size_t n = mechanism.numSpecies();
  std::vector<double> wdot(n);
  double worst = 0;
  for (const double T : {200.0, 640.0, 1000.0, 1700.0, 4000.0})
    for (const double p : {1e3, 1e5, 5e7}) {
      auto c = uneven(n, T, p);
      for (const std::size_t zero : {n, std::size_t{0}, std::size_t{3}, std::size_t{5}}) {
        if (zero < n) c[zero] = 0;
        kinetics.netProductionRates(T, c, wdot);
        const auto plain = plainRates<double>(mechanism, T, c);
        double largest = 0;
        for (const double w : plain.wdot) largest = std::max(largest, std::abs(w));
        for (std::size_t k = 0; k < n; ++k) {
          raise(worst, (wdot[k] - plain.wdot[k]) / largest);
          EXPECT_NEAR(wdot[k], plain.wdot[k], 1e-11 * largest) << mechanism.speciesName(k) << " at " << T;
        }
      }
    }
  measured("production rates, of the largest", worst);
}

// At Pr = 1 the exponent of the SRI formula is one.
TEST(KineticsRateTypes, SriBroadeningAtItsCentre) {
  const auto reaction = RateTypes::sriFalloff();
  const auto mechanism = RateTypes::withOnly(reaction);
  Kinetics kinetics(mechanism);
  for (const double T : {400.0, 1200.0}) {
    const double high = plainArrhenius(reaction.rate, T), low = plainArrhenius(reaction.lowPressureRate, T);
    const double M = high / low, argon = M / 0.7;
    const double F = 1.2 * std::pow(T, -0.03) * (0.45 * std::exp(-797 / T) + std::exp(-T / 979));
    EXPECT_NEAR(constantInArgon(kinetics, T, argon * constants::gasConstant * T) / (0.5 * high * F), 1, 1e-12);
  }
}

// The broadening of Troe reaches one only as 1/log(Pr)^2; of Lindemann's form the limits are exact.
TEST(KineticsRateTypes, ActivatedReactionsReachTheirLimits) {
  auto reaction = RateTypes::activated();
  reaction.troe.reset();
  const auto mechanism = RateTypes::withOnly(reaction);
  Kinetics kinetics(mechanism);
  const double T = 900, low = plainArrhenius(reaction.lowPressureRate, T), high = plainArrhenius(reaction.rate, T);
  EXPECT_NEAR(constantInArgon(kinetics, T, 1e-12) / low, 1, 1e-12);
  const double p = 1e25, M = 0.7 * p / (constants::gasConstant * T);
  EXPECT_NEAR(constantInArgon(kinetics, T, p) / (high / M), 1, 1e-12);
}

TEST(KineticsRateTypes, PressuresAreInterpolatedInLogarithms) {
  const auto reaction = RateTypes::pressureLog();
  const auto mechanism = RateTypes::withOnly(reaction);
  Kinetics kinetics(mechanism);
  for (const double T : {350.0, 2100.0}) {
    std::vector<double> k;
    for (const auto& entry : reaction.pressureRates) k.push_back(plainArrhenius(entry.rate, T));
    const double atOneBar = k[1] + k[2];
    EXPECT_NEAR(constantInArgon(kinetics, T, 1e5) / atOneBar, 1, 1e-12);
    EXPECT_NEAR(constantInArgon(kinetics, T, 1e6) / k[3], 1, 1e-12);
    EXPECT_NEAR(constantInArgon(kinetics, T, std::sqrt(1e11)) / std::sqrt(atOneBar * k[3]), 1, 1e-12);
    EXPECT_NEAR(constantInArgon(kinetics, T, 1.0) / k[0], 1, 1e-12);
    EXPECT_NEAR(constantInArgon(kinetics, T, 1e9) / k[4], 1, 1e-12);
  }
}

// In the corners of the ranges all polynomials are 1 or -1, in the middle only the even ones remain.
TEST(KineticsRateTypes, ChebyshevInCornersAndMiddle) {
  const auto reaction = RateTypes::chebyshev();
  const auto mechanism = RateTypes::withOnly(reaction);
  Kinetics kinetics(mechanism);
  const auto& a = reaction.chebyshev->coefficients;
  const auto log10k = [&](double T, double p) { return std::log10(constantInArgon(kinetics, T, p)); };
  EXPECT_NEAR(log10k(2500, 1e7), std::accumulate(a.begin(), a.end(), 0.0), 1e-12);
  EXPECT_NEAR(log10k(300, 1e7), a[0] + a[1] + a[2] - a[3] - a[4] - a[5] + a[6] + a[7] + a[8] - a[9] - a[10] - a[11],
              1e-12);
  EXPECT_NEAR(log10k(2500, 1e3), a[0] - a[1] + a[2] + a[3] - a[4] + a[5] + a[6] - a[7] + a[8] + a[9] - a[10] + a[11],
              1e-12);
  EXPECT_NEAR(log10k(2 / (1 / 300.0 + 1 / 2500.0), 1e5), a[0] - a[2] - a[6] + a[8], 1e-12);
}

// A product or reactant at zero stops a reaction of positive order; a negative order keeps it finite.
TEST(KineticsRateTypes, OrdersAtVanishingConcentrations) {
  const auto mechanism = RateTypes::withOnly(RateTypes::ordersOfAll());
  Kinetics kinetics(mechanism);
  const std::size_t n = mechanism.numSpecies();
  const auto H2 = mechanism.speciesIndex("H2"), O2 = mechanism.speciesIndex("O2"), H2O = mechanism.speciesIndex("H2O");
  std::vector<double> c(n, 0.0), wdot(n), J(n * n), byT(n);
  const double k = plainArrhenius(RateTypes::ordersOfAll().rate, 1400.0);
  const auto rate = [&](double hydrogenContent, double oxygen, double water) {
    c[H2] = hydrogenContent;
    c[O2] = oxygen;
    c[H2O] = water;
    kinetics.netProductionRatesAndJacobian(1400, c, wdot, J, byT);
    for (const double value : J) EXPECT_TRUE(std::isfinite(value));
    return -wdot[H2] / k;
  };
  EXPECT_NEAR(rate(0.2, 0.3, 0.4) / (std::sqrt(0.2) * std::pow(0.3, 1.25) * std::pow(0.4, -0.3)), 1, 1e-12);
  EXPECT_EQ(rate(0.0, 0.3, 0.4), 0);
  EXPECT_EQ(rate(0.2, 0.0, 0.4), 0);
  EXPECT_EQ(rate(0.2, -1e-9, 0.4), 0);
  EXPECT_EQ(rate(0.2, 0.3, 0.0), 0);
  EXPECT_LT(rate(-1e-12, 0.3, 0.4), 0);
  const double s = smallestConcentration;
  EXPECT_NEAR(rate(0.2, 0.3, s * (1 - 1e-9)) / rate(0.2, 0.3, s * (1 + 1e-9)), 1, 1e-8);  // continuous
}

TEST(KineticsRateTypes, MultipliersScaleBothDirections) {
  const auto mechanism = RateTypes::mechanism();
  Kinetics plain(mechanism), scaled(mechanism);
  const std::size_t n = mechanism.numReactions(), species = mechanism.numSpecies();
  for (std::size_t r = 0; r < n; ++r) scaled.setMultiplier(r, 0.5 + static_cast<double>(r));
  const auto c = uneven(species, 1300, 2e5);
  std::vector<double> qf(n), qr(n), qfScaled(n), qrScaled(n), kf(n), kr(n), kfScaled(n), krScaled(n);
  plain.ratesOfProgress(1300, c, qf, qr);
  scaled.ratesOfProgress(1300, c, qfScaled, qrScaled);
  plain.rateConstants(1300, c, kf, kr);
  scaled.rateConstants(1300, c, kfScaled, krScaled);
  std::vector<double> expected(species, 0.0), expectedByT(species), wdot(species), byT(species), J(species * species);
  for (std::size_t r = 0; r < n; ++r) {
    const double f = 0.5 + static_cast<double>(r);
    EXPECT_EQ(scaled.multiplier(r), f);
    EXPECT_NEAR(qfScaled[r], f * qf[r], 1e-13 * std::abs(qfScaled[r]));
    EXPECT_NEAR(qrScaled[r], f * qr[r], 1e-13 * std::abs(qrScaled[r]));
    EXPECT_NEAR(kfScaled[r], f * kf[r], 1e-13 * std::abs(kfScaled[r]));
    EXPECT_NEAR(krScaled[r], f * kr[r], 1e-13 * std::abs(krScaled[r]));
    for (const auto& term : plain.netStoichiometry(r)) expected[term.species] += term.coefficient * f * (qf[r] - qr[r]);
  }
  // Derivatives: each reaction's own, scaled.
  std::vector<double> sum(species * species, 0.0), sumByT(species, 0.0);
  for (std::size_t r = 0; r < n; ++r) {
    for (std::size_t other = 0; other < n; ++other) plain.setMultiplier(other, other == r ? 1.0 : 0.0);
    plain.netProductionRatesAndJacobian(1300, c, wdot, J, byT);
    for (std::size_t e = 0; e < J.size(); ++e) sum[e] += (0.5 + static_cast<double>(r)) * J[e];
    for (std::size_t k = 0; k < species; ++k) sumByT[k] += (0.5 + static_cast<double>(r)) * byT[k];
  }
  scaled.netProductionRatesAndJacobian(1300, c, wdot, J, byT);
  const auto scale = [](const std::vector<double>& v) {
    double largest = 0;
    for (const double x : v) largest = std::max(largest, std::abs(x));
    return 1e-12 * largest;
  };
  for (std::size_t k = 0; k < species; ++k) EXPECT_NEAR(wdot[k], expected[k], scale(expected));
  for (std::size_t k = 0; k < species; ++k) EXPECT_NEAR(byT[k], sumByT[k], scale(sumByT));
  for (std::size_t e = 0; e < J.size(); ++e) EXPECT_NEAR(J[e], sum[e], scale(sum));
  EXPECT_THROW(plain.setMultiplier(n, 1.0), InputError);
  EXPECT_THROW(plain.setMultiplier(0, NAN), InputError);
}

TEST(KineticsRateTypes, NonsenseIsRefused) {
  auto falling = RateTypes::pressureLog();
  falling.pressureRates[1].rate.A = 1e-3;
  const auto message = messageOf<InputError>(falling, 1000);
  EXPECT_NE(message.find("rate-types:0: reaction 'H + HO2 <=> OH'"), std::string::npos) << message;
  EXPECT_NE(message.find("100000 Pa and 300 K"), std::string::npos) << message;
  // Positive at the temperatures looked at in advance, negative far above them.
  auto later = RateTypes::pressureLog();
  later.pressureRates[1].rate = {1e6, 0, 0};
  later.pressureRates[2].rate = {-1e6, 1.0, 30000};
  EXPECT_EQ(messageOf<NumericsError>(later, 1000), "");
  EXPECT_NE(messageOf<NumericsError>(later, 6000).find("at 6000 K; expected a positive sum"), std::string::npos);
  auto unsorted = RateTypes::pressureLog();
  std::swap(unsorted.pressureRates[0], unsorted.pressureRates[3]);
  EXPECT_NE(messageOf<InputError>(unsorted, 1000).find("rising order"), std::string::npos);
  auto none = RateTypes::pressureLog();
  none.pressureRates.clear();
  EXPECT_NE(messageOf<InputError>(none, 1000).find("one pressure or more"), std::string::npos);
  auto matrix = RateTypes::chebyshev();
  matrix.chebyshev->coefficients.pop_back();
  EXPECT_NE(messageOf<InputError>(matrix, 1000).find("full matrix"), std::string::npos);
  auto range = RateTypes::chebyshev();
  range.chebyshev->maxPressure = 1e2;
  EXPECT_NE(messageOf<InputError>(range, 1000).find("rising pressures"), std::string::npos);
  auto sri = RateTypes::sriFalloff();
  sri.sri->d = 0;
  EXPECT_NE(messageOf<InputError>(sri, 1000).find("positive factor d"), std::string::npos);
  auto signs = RateTypes::activated();
  signs.lowPressureRate.A = -1;
  EXPECT_NE(messageOf<InputError>(signs, 1000).find("same sign"), std::string::npos);
  auto orders = RateTypes::ordersOfAll();
  orders.reversible = true;
  EXPECT_NE(messageOf<InputError>(orders, 1000).find("irreversible"), std::string::npos);
}

}  // namespace
