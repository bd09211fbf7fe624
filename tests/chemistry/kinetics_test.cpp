#include "chemistry/kinetics/kinetics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "chemistry/thermo/species_thermo.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::ethylene;
using lampblack::test::hydrogen;

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
  const SpeciesThermo table(mechanism.allSpecies());
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
