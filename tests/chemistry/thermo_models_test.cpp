// Shomate polynomials and constant heat capacities against their formulas and published values.
#include <gtest/gtest.h>

#include <cmath>

#include "chemistry/thermo/species_thermo.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::readText;

constexpr double R = constants::gasConstant;

// Nitrogen of Chase (1998), in the coefficients of the NIST Chemistry WebBook.
constexpr double kLow[] = {28.98641, 1.853978, -9.647459, 16.63537, 0.000117, -8.671914, 226.4168};
constexpr double kHigh[] = {19.50583, 19.88705, -8.598535, 1.369784, 0.527601, -4.935202, 212.3900};
const char* const kNitrogen = R"(
- name: N2
  composition: {N: 2}
  thermo:
    model: Shomate
    temperature-ranges: [100, 500, 2000]
    reference-pressure: 1 bar
    data:
    - [28.98641, 1.853978, -9.647459, 16.63537, 0.000117, -8.671914, 226.4168]
    - [19.50583, 19.88705, -8.598535, 1.369784, 0.527601, -4.935202, 212.3900])";

TEST(ThermoModels, ShomateIsItsFormula) {
  const auto mechanism = readText("species: [N2]", kNitrogen, "[]");
  const auto& species = mechanism.species(0);
  for (const double T : {150.0, 298.15, 450.0, 600.0, 1800.0}) {
    const auto& c = T < 500 ? kLow : kHigh;
    const double t = T / 1000;
    const double cp = c[0] + c[1] * t + c[2] * t * t + c[3] * t * t * t + c[4] / (t * t);
    const double h = c[0] * t + c[1] * t * t / 2 + c[2] * t * t * t / 3 + c[3] * std::pow(t, 4) / 4 - c[4] / t + c[5];
    const double s =
        c[0] * std::log(t) + c[1] * t + c[2] * t * t / 2 + c[3] * t * t * t / 3 - c[4] / (2 * t * t) + c[6];
    EXPECT_NEAR(cpOverR(species, T) * R, cp, 1e-12 * cp);
    EXPECT_NEAR(enthalpyOverRT(species, T) * R * T, 1e3 * h, 1e-12 * 1e3 * (std::abs(h) + cp * t));
    EXPECT_NEAR(entropyOverR(species, T) * R, s - R * std::log(1.01325), 1e-12 * s);
  }
}

// The tables: cp, s (1 bar) and h - h(298.15 K) to their last digits.
TEST(ThermoModels, ShomateGivesThePublishedValuesOfNitrogen) {
  const auto mechanism = readText("species: [N2]", kNitrogen, "[]");
  const auto& species = mechanism.species(0);
  const double shift = R * std::log(1.01325);
  EXPECT_NEAR(cpOverR(species, 300) * R, 29.125, 0.01);
  EXPECT_NEAR(entropyOverR(species, 300) * R + shift, 191.789, 0.01);
  EXPECT_NEAR(enthalpyOverRT(species, 298.15) * R * 298.15, 0, 5);
  EXPECT_NEAR(cpOverR(species, 1000) * R, 32.697, 0.01);
  EXPECT_NEAR(entropyOverR(species, 1000) * R + shift, 228.170, 0.02);
  EXPECT_NEAR(enthalpyOverRT(species, 1000) * R * 1000, 21463, 10);
}

TEST(ThermoModels, ConstantHeatCapacityIsItsFormula) {
  const auto mechanism = readText("species: [A, B, C]", R"(
- {name: A, composition: {H: 1}, thermo: {model: constant-cp, T0: 1000 K, h0: 9.22 kcal/mol, s0: -3.02 cal/mol/K,
   cp0: 5.95 cal/mol/K, T-min: 250 K, T-max: 4000}}
- {name: B, composition: {H: 1}, thermo: {model: constant-cp, units: {energy: J, quantity: kmol}, h0: 2e8, s0: 1e5,
   cp0: 2.1e4, reference-pressure: 1 bar}}
- {name: C, composition: {H: 1}, thermo: {model: constant-cp}})",
                                  "[]");
  const double calorie = 4.184;
  for (const double T : {250.0, 1000.0, 3300.0}) {
    const auto &a = mechanism.species(0), &b = mechanism.species(1), &c = mechanism.species(2);
    EXPECT_NEAR(cpOverR(a, T) * R, 5.95 * calorie, 1e-12);
    EXPECT_NEAR(enthalpyOverRT(a, T) * R * T, calorie * (9220 + 5.95 * (T - 1000)), 1e-9);
    EXPECT_NEAR(entropyOverR(a, T) * R, calorie * (-3.02 + 5.95 * std::log(T / 1000)), 1e-11);
    EXPECT_NEAR(cpOverR(b, T) * R, 21, 1e-12);
    EXPECT_NEAR(enthalpyOverRT(b, T) * R * T, 2e5 + 21 * (T - 298.15), 1e-8);
    EXPECT_NEAR(entropyOverR(b, T) * R, 100 + 21 * std::log(T / 298.15) - R * std::log(1.01325), 1e-11);
    EXPECT_EQ(cpOverR(c, T), 0);
    EXPECT_EQ(enthalpyOverRT(c, T), 0);
  }
  EXPECT_EQ(mechanism.species(0).thermo.minTemperature, 250);
  EXPECT_EQ(mechanism.species(0).thermo.maxTemperature, 4000);
  EXPECT_EQ(mechanism.species(1).thermo.minTemperature, 0);
  EXPECT_GT(mechanism.species(1).thermo.maxTemperature, 1e6);
}

}  // namespace
