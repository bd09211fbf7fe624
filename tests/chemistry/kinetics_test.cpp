#include "chemistry/kinetics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/table.hpp"

namespace {

using namespace lampblack;
using lampblack::testing::ethylene;
using lampblack::testing::hydrogen;
using lampblack::testing::measured;
using lampblack::testing::raise;
using lampblack::testing::Table;

std::vector<double> concentrations(const std::vector<double>& X, double T, double p) {
  auto c = X;
  for (double& v : c) v *= p / (constants::gasConstant * T);
  return c;
}

double order(const std::vector<StoichiometricTerm>& terms) {
  double sum = 0;
  for (const auto& t : terms) sum += t.coefficient;
  return sum;
}

// Cantera's rate constants are in kmol and exclude [M], as here; those of fall-off reactions are effective.
TEST(Kinetics, RateConstantsAgreeWithCantera) {
  const auto& mechanism = hydrogen();
  Kinetics kinetics(mechanism);
  const Table states("kinetics_h2o2_states.csv"), reactions("kinetics_h2o2_reactions.csv");
  const std::size_t n = mechanism.numReactions();
  ASSERT_EQ(reactions.size(), states.size() * n);
  std::vector<double> kf(n), kr(n), qf(n), qr(n);
  double worstForward = 0, worstReverse = 0;
  for (std::size_t s = 0; s < states.size(); ++s) {
    const double T = states.number(s, "T"), p = states.number(s, "p");
    const auto c = concentrations(states.moleFractions(s, mechanism), T, p);
    kinetics.rateConstants(T, c, kf, kr);
    kinetics.ratesOfProgress(T, c, qf, qr);
    double largest = 0;
    for (std::size_t r = 0; r < n; ++r) largest = std::max({largest, qf[r], qr[r]});
    for (std::size_t r = 0; r < n; ++r) {
      const auto& reaction = mechanism.reaction(r);
      // A collider named in the equation ("H + O2 + AR") is a third body there and a reactant here: same order.
      const double extra = reaction.type == Reaction::Type::ThreeBody ? 1 : 0;
      const double kmolForward = std::pow(1e3, order(reaction.reactants) + extra - 1);
      const double kmolReverse = std::pow(1e3, order(reaction.products) + extra - 1);
      const std::size_t row = s * n + r;
      const double forward = reactions.number(row, "kf"), reverse = reactions.number(row, "kr");
      worstForward = std::max(worstForward, std::abs(kf[r] * kmolForward / forward - 1));
      if (reverse > 1e-280) worstReverse = std::max(worstReverse, std::abs(kr[r] * kmolReverse / reverse - 1));
      EXPECT_NEAR(qf[r], 1e3 * reactions.number(row, "qf"), 1e-10 * largest);
      EXPECT_NEAR(qr[r], 1e3 * reactions.number(row, "qr"), 1e-10 * largest);
    }
  }
  measured("forward rate constants", worstForward);
  measured("reverse rate constants", worstReverse);
  EXPECT_LT(worstForward, 1e-10);
  EXPECT_LT(worstReverse, 1e-9);
}

TEST(Kinetics, NetProductionRatesAgreeWithCantera) {
  const auto& mechanism = hydrogen();
  Kinetics kinetics(mechanism);
  const Table states("kinetics_h2o2_states.csv"), species("kinetics_h2o2_species.csv");
  const std::size_t n = mechanism.numSpecies();
  std::vector<double> wdot(n);
  double worst = 0;
  for (std::size_t s = 0; s < states.size(); ++s) {
    const double T = states.number(s, "T"), p = states.number(s, "p");
    kinetics.netProductionRates(T, concentrations(states.moleFractions(s, mechanism), T, p), wdot);
    double largest = 0;
    for (std::size_t k = 0; k < n; ++k) largest = std::max(largest, 1e3 * species.number(s * n + k, "creation"));
    for (std::size_t k = 0; k < n; ++k) {
      const double reference = 1e3 * species.number(s * n + k, "net");
      raise(worst, (wdot[k] - reference) / largest);
      EXPECT_NEAR(wdot[k], reference, 1e-10 * largest) << mechanism.speciesName(k);
    }
  }
  measured("net rates, of the largest creation rate", worst);
}

TEST(Kinetics, ConservesElements) {
  double worst = 0;
  for (const auto* mechanism : {&hydrogen(), &ethylene()}) {
    Kinetics kinetics(*mechanism);
    const std::size_t n = mechanism->numSpecies();
    std::vector<double> c(n), wdot(n);
    for (std::size_t k = 0; k < n; ++k) c[k] = 0.1 + 0.7 * static_cast<double>((k * 7) % 11);
    for (const double T : {300.0, 1000.0, 1000.1, 2500.0}) {
      kinetics.netProductionRates(T, c, wdot);
      for (std::size_t i = 0; i < mechanism->numElements(); ++i) {
        double sum = 0, size = 0;
        for (std::size_t k = 0; k < n; ++k) {
          sum += wdot[k] * mechanism->atoms(k, i);
          size += std::abs(wdot[k]) * mechanism->atoms(k, i);
        }
        if (size > 0) raise(worst, sum / size);
        EXPECT_LE(std::abs(sum), 1e-13 * size) << mechanism->elementName(i) << " at " << T;
      }
    }
  }
  measured("sum over species, of the sum of magnitudes", worst);
}

// kf/kr = Kc, and at concentrations with prod c^nu = Kc nothing happens.
TEST(Kinetics, ForwardAndReverseBalanceAtEquilibrium) {
  for (const auto* mechanism : {&hydrogen(), &ethylene()}) {
    Kinetics kinetics(*mechanism);
    const std::size_t n = mechanism->numSpecies(), reactions = mechanism->numReactions();
    std::vector<double> c(n, 1.0), kf(reactions), kr(reactions), Kc(reactions);
    for (const double T : {600.0, 1000.0, 1800.0, 2600.0}) {
      kinetics.rateConstants(T, c, kf, kr);
      kinetics.equilibriumConstants(T, Kc);
      for (std::size_t r = 0; r < reactions; ++r) {
        if (mechanism->reaction(r).reversible)
          EXPECT_NEAR(kf[r] / kr[r] / Kc[r], 1, 1e-11) << mechanism->reaction(r).equation;
        else
          EXPECT_EQ(kr[r], 0.0);
      }
    }
  }
}

// Element potentials make an equilibrium of all reactions at once: c_k = (p0/RT) exp(-g_k/RT + sum_i lambda_i a_ki).
// For the elementary reaction rates to vanish there, every reverse rate constant must be right.
TEST(Kinetics, ElementPotentialsGiveNoReaction) {
  const auto& mechanism = hydrogen();
  Kinetics kinetics(mechanism);
  const Nasa7Table table(mechanism.allSpecies());
  const std::size_t n = mechanism.numSpecies(), reactions = mechanism.numReactions();
  std::vector<double> g(n), c(n), qf(reactions), qr(reactions);
  for (const double T : {1200.0, 2400.0}) {
    table.gibbsOverRT(T, std::log(T), g.data());
    for (std::size_t k = 0; k < n; ++k) {
      double exponent = -g[k];
      const double potential[] = {-12.0, -14.0, -13.0, -22.0};
      for (std::size_t i = 0; i < 4; ++i) exponent += potential[i] * mechanism.atoms(k, i);
      c[k] = constants::oneAtmosphere / (constants::gasConstant * T) * std::exp(exponent);
    }
    kinetics.ratesOfProgress(T, c, qf, qr);
    for (std::size_t r = 0; r < reactions; ++r) EXPECT_NEAR(qf[r] / qr[r], 1, 1e-11) << mechanism.reaction(r).equation;
  }
}

// Pr -> 0 and Pr -> infinity of a Troe reaction are its two limits.
TEST(Kinetics, FalloffReachesItsLimits) {
  const auto& mechanism = hydrogen();
  Kinetics kinetics(mechanism);
  std::size_t falloff = 0;
  while (mechanism.reaction(falloff).type != Reaction::Type::Falloff) ++falloff;
  const auto& reaction = mechanism.reaction(falloff);
  const auto k = [](const Arrhenius& a, double T) {
    return a.A * std::pow(T, a.b) * std::exp(-a.activationTemperature / T);
  };
  const double T = 1300;
  std::vector<double> c(mechanism.numSpecies(), 0.0), kf(mechanism.numReactions()), kr(mechanism.numReactions());
  const auto N2 = mechanism.speciesIndex("N2");
  c[N2] = 1e-25;  // the broadening approaches one only as 1/log(Pr)^2
  kinetics.rateConstants(T, c, kf, kr);
  EXPECT_NEAR(kf[falloff] / (k(reaction.lowPressureRate, T) * c[N2]), 1, 0.3);
  c[N2] = 1e40;
  kinetics.rateConstants(T, c, kf, kr);
  EXPECT_NEAR(kf[falloff] / k(reaction.rate, T), 1, 0.3);
  c[N2] = 0;
  kinetics.rateConstants(T, c, kf, kr);
  EXPECT_LT(kf[falloff], 1e-280);
  EXPECT_GE(kf[falloff], 0.0);
}

}  // namespace
