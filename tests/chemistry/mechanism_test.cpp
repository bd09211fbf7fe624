#include "chemistry/mechanism/mechanism.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "chemistry/kinetics/kinetics.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::ethylene;
using lampblack::test::hydrogen;
using lampblack::test::readText;

TEST(Mechanism, EthyleneFileHasThePublishedSize) {
  const auto& mechanism = ethylene();
  EXPECT_EQ(mechanism.numSpecies(), 47U);
  EXPECT_EQ(mechanism.numReactions(), 224U);
  EXPECT_EQ(mechanism.numElements(), 4U);
  const auto A2 = mechanism.speciesIndex("A2");  // naphthalene, C10H8
  EXPECT_EQ(mechanism.atoms(A2, mechanism.elementIndex("C")), 10);
  EXPECT_EQ(mechanism.atoms(A2, mechanism.elementIndex("H")), 8);
  EXPECT_NEAR(mechanism.molecularWeights()[A2], 0.128174, 1e-9);
  EXPECT_THAT(mechanism.description(), ::testing::HasSubstr("Bisetti"));
  EXPECT_FALSE(mechanism.findSpecies("A4"));
}

TEST(Mechanism, RateConstantsAreConvertedToMolAndMetres) {
  const auto& mechanism = hydrogen();
  const auto& threeBody = mechanism.reaction(0);  // 2 O + M <=> O2 + M, A = 1.2e17 cm6/mol2/s K, b = -1
  EXPECT_EQ(threeBody.type, Reaction::Type::ThreeBody);
  EXPECT_NEAR(threeBody.rate.A, 1.2e5, 1e-9);
  const auto& abstraction = mechanism.reaction(2);  // O + H2, A = 3.87e4 cm3/mol/s, Ea = 6260 cal/mol
  EXPECT_NEAR(abstraction.rate.A, 3.87e-2, 1e-15);
  EXPECT_NEAR(abstraction.rate.activationTemperature, 6260 * 4.184 / constants::gasConstant, 1e-9);
  const auto& falloff = mechanism.reaction(21);
  ASSERT_EQ(falloff.type, Reaction::Type::Falloff);
  EXPECT_NEAR(falloff.rate.A, 7.4e7, 1e-3);
  EXPECT_NEAR(falloff.lowPressureRate.A, 2.3e6, 1e-4);
  EXPECT_EQ(falloff.troe->T2.value(), 5182.0);
}

// NO, N, Y, on and the like are truth values to a YAML 1.1 reader.
TEST(Mechanism, ReadsNamesThatLookLikeBooleans) {
  const auto mechanism =
      readText("elements: [N, O, Y], species: [N, NO, O, Y, on]", R"(
- {name: N, composition: {N: 1}, thermo: *t}
- {name: NO, composition: {N: 1, O: 1}, thermo: *t}
- {name: O, composition: {O: 1}, thermo: *t}
- {name: Y, composition: {Y: 1}, thermo: *t}
- {name: on, composition: {O: 1, N: 1}, thermo: *t}

elements:
- {symbol: Y, atomic-weight: 88.90584})",
               "[{equation: NO + M <=> N + O + M, rate-constant: [1, 0, 0], efficiencies: {NO: 2, Y: "
               "3, N: 4}}]");
  EXPECT_EQ(mechanism.speciesName(1), "NO");
  EXPECT_EQ(mechanism.speciesName(3), "Y");
  EXPECT_EQ(mechanism.speciesName(4), "on");
  EXPECT_EQ(mechanism.atoms(1, mechanism.elementIndex("N")), 1);
  EXPECT_NEAR(mechanism.molecularWeights()[3], 0.08890584, 1e-12);
  EXPECT_EQ(mechanism.reaction(0).thirdBody->efficiencies.size(), 3U);
}

TEST(Mechanism, OneTemperatureRangeHoldsEverywhere) {
  const auto mechanism = readText("species: [N2]", R"(
- name: N2
  composition: {N: 2}
  thermo: {model: NASA7, temperature-ranges: [200, 3000], data: [[3.5, 0, 0, 0, 0, 0, 1]]})",
                                  "[]");
  EXPECT_EQ(mechanism.species(0).thermo.low, mechanism.species(0).thermo.high);
}

// The same rate written with a named collider, with units at Ea, as a list, and with explicit orders.
TEST(Mechanism, DifferentWaysToWriteARateAgree) {
  const std::string gas = "species: [H, O2, HO2, AR, N2]";
  const std::string species = R"(
- {name: H, composition: {H: 1}, thermo: *t}
- {name: O2, composition: {O: 2}, thermo: *t}
- {name: HO2, composition: {H: 1, O: 2}, thermo: *t}
- {name: AR, composition: {Ar: 1}, thermo: *t}
- {name: N2, composition: {N: 2}, thermo: *t})";
  const std::string rate = "rate-constant: {A: 7.0e+17, b: -0.8, Ea: 1000}";
  const std::string forms[] = {
      "[{equation: H + O2 + AR <=> HO2 + AR, " + rate + "}]",
      "[{equation: H + O2 + AR <=> HO2 + AR, type: three-body, " + rate + "}]",
      "[{equation: H + O2 + M <=> HO2 + M, type: three-body, default-efficiency: 0, efficiencies: {AR: 1}, " + rate +
          "}]",
      "[{equation: H + O2 + M <=> HO2 + M, efficiencies: {H: 0, O2: 0, HO2: 0, N2: 0}, " + rate + "}]",
      "[{equation: H + O2 + AR = HO2 + AR, rate-constant: [7.0e+17, -0.8, 1 kcal/mol]}]",
      "[{equation: H + O2 + AR <=> HO2 + AR, rate-constant: {A: 7.0e+17, b: -0.8, Ea: 4.184 kJ/mol}}]",
  };
  std::vector<double> c{0.3, 2.0, 0.1, 5.0, 11.0}, expected;
  for (const auto& form : forms) {
    const auto mechanism = readText(gas, species, form);
    Kinetics kinetics(mechanism);
    std::vector<double> wdot(5);
    kinetics.netProductionRates(1100, c, wdot);
    if (expected.empty()) expected = wdot;
    for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(wdot[k], expected[k], 1e-13 * std::abs(expected[0])) << form;
  }
  EXPECT_NE(expected[0], 0);
  // An irreversible reaction with decimal coefficients and an order of its own.
  const auto lumped = readText(gas, species,
                               "[{equation: 0.5 O2 + H => 0.5 HO2 + 0.5 H, orders: {O2: 1.5}, "
                               "rate-constant: {A: 2.0e+6, b: 0, Ea: 0}}]");
  Kinetics kinetics(lumped);
  std::vector<double> wdot(5);
  kinetics.netProductionRates(1100, c, wdot);
  const double q = 2.0e6 * std::pow(1e-6, 1.5) * std::pow(2.0, 1.5) * 0.3;
  EXPECT_NEAR(wdot[1], -0.5 * q, 1e-14 * q);
  EXPECT_NEAR(wdot[0], -0.5 * q, 1e-14 * q);
  EXPECT_NEAR(wdot[2], 0.5 * q, 1e-14 * q);
}

// Four reactants and products at once, reversible: the path of explicit powers, with its derivatives.
TEST(Mechanism, ManyReactantsUseExplicitPowers) {
  const auto mechanism = readText("species: [H, O2, HO2, H2]", R"(
- {name: H, composition: {H: 1}, thermo: *t}
- {name: O2, composition: {O: 2}, thermo: *t}
- {name: HO2, composition: {H: 1, O: 2}, thermo: *t}
- {name: H2, composition: {H: 2}, thermo: *u})",
                                  "[{equation: 4 H + O2 <=> H2 + H + HO2, rate-constant: {A: 1.0e+20, b: 0, Ea: 0}}]");
  Kinetics kinetics(mechanism);
  const std::vector<double> c{0.5, 2.0, 0.25, 3.0};
  std::vector<double> kf(1), kr(1), Kc(1), wdot(4), J(16), byT(4);
  kinetics.rateConstants(1500, c, kf, kr);
  kinetics.equilibriumConstants(1500, Kc);
  EXPECT_NEAR(kf[0] / kr[0] / Kc[0], 1, 1e-12);
  kinetics.netProductionRatesAndJacobian(1500, c, wdot, J, byT);
  const double forward = kf[0] * std::pow(0.5, 4) * 2, reverse = kr[0] * 3.0 * 0.5 * 0.25;
  EXPECT_NEAR(wdot[1], -(forward - reverse), 1e-12 * (forward + reverse));
  EXPECT_NEAR(J[0 * 4 + 1], -(4 * forward - reverse) / 0.5, 1e-12 * (forward + reverse));
  EXPECT_NEAR(J[3 * 4 + 1], reverse / 3.0, 1e-12 * (forward + reverse));
  std::vector<double> above(4), below(4);
  kinetics.netProductionRates(1500.5, c, above);
  kinetics.netProductionRates(1499.5, c, below);
  EXPECT_NEAR(byT[1], above[1] - below[1], 1e-5 * std::abs(byT[1]));
}

}  // namespace
