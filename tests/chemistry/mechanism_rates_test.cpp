// Every type of rate constant that the reader knows, on numbers worked out by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::kelvinPerCalorie;
using lampblack::test::readText;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Type = Reaction::Type;

// The file's units are cm, mol and cal/mol. Reactions start in line 13.
Mechanism read(const std::string& reactions) {
  return readText("species: [H, O2, HO2, AR, N2]", R"(
- {name: H, composition: {H: 1}, thermo: *t}
- {name: O2, composition: {O: 2}, thermo: *t}
- {name: HO2, composition: {H: 1, O: 2}, thermo: *t}
- {name: AR, composition: {Ar: 1}, thermo: *t}
- {name: N2, composition: {N: 2}, thermo: *t})",
                  reactions);
}

Reaction readOne(const std::string& reaction) {
  return read("- " + reaction).reaction(0);
}

void expectRate(const Arrhenius& rate, double A, double b, double Ta) {
  EXPECT_NEAR(rate.A, A, 1e-13 * std::abs(A));
  EXPECT_DOUBLE_EQ(rate.b, b);
  EXPECT_NEAR(rate.activationTemperature, Ta, 1e-13 * std::abs(Ta));
}

TEST(MechanismRates, FalloffWithTroeOfThreeAndFourParameters) {
  const std::string limits =
      "type: falloff, high-P-rate-constant: {A: 4.65e+12, b: 0.44, Ea: 0}, "
      "low-P-rate-constant: {A: 6.366e+20, b: -1.72, Ea: 524.8}";
  const auto three =
      readOne("{equation: H + O2 (+M) <=> HO2 (+M), " + limits + ", Troe: {A: 0.5, T3: 30.0, T1: 90000}}");
  EXPECT_EQ(three.type, Type::Falloff);
  expectRate(three.rate, 4.65e6, 0.44, 0);                                      // cm3/mol/s to m3/mol/s
  expectRate(three.lowPressureRate, 6.366e8, -1.72, 524.8 * kelvinPerCalorie);  // cm6/mol2/s to m6/mol2/s
  EXPECT_EQ(three.troe->A, 0.5);
  EXPECT_EQ(three.troe->T3, 30);
  EXPECT_EQ(three.troe->T1, 90000);
  EXPECT_FALSE(three.troe->T2);
  EXPECT_EQ(three.thirdBody->defaultEfficiency, 1);
  EXPECT_EQ(three.reactants.size(), 2U);
  const auto four =
      readOne("{equation: H + O2 ( + M) <=> HO2 (+ M), " + limits + ", Troe: {A: 0.5, T3: 30 K, T1: 90, T2: 5182}}");
  EXPECT_EQ(four.troe->T2, 5182);
  const auto lindemann = readOne("{equation: H + O2 (+M) <=> HO2 (+M), " + limits + "}");
  EXPECT_FALSE(lindemann.troe);
  EXPECT_FALSE(lindemann.sri);
}

// exp(-0/T) = 1 would be no broadening at all; Cantera leaves the term out, too.
TEST(MechanismRates, TroeWithT2OfZeroIsThreeParametersAndAWarning) {
  const auto mechanism = read(
      "- {equation: H + O2 (+M) <=> HO2 (+M), type: falloff, high-P-rate-constant: [1, 0, 0], low-P-rate-constant: "
      "[1, 0, 0], Troe: {A: 0.5, T3: 30.0, T1: 90, T2: 0}}");
  EXPECT_FALSE(mechanism.reaction(0).troe->T2);
  EXPECT_THAT(mechanism.warnings(),
              ElementsAre(HasSubstr(".yaml:13: reaction 'H + O2 (+M) <=> HO2 (+M)', 'Troe': T2")));
}

TEST(MechanismRates, FalloffWithSriOfThreeAndFiveParameters) {
  const std::string start =
      "{equation: H + O2 (+M) <=> HO2 (+M), type: falloff, high-P-rate-constant: [1e12, 0, 0], low-P-rate-constant: "
      "[1e20, 0, 0], SRI: ";
  const auto three = readOne(start + "{A: 0.54, B: 201.0, C: 1024.0}}");
  EXPECT_EQ(three.sri->a, 0.54);
  EXPECT_EQ(three.sri->b, 201);
  EXPECT_EQ(three.sri->c, 1024);
  EXPECT_EQ(three.sri->d, 1);
  EXPECT_EQ(three.sri->e, 0);
  const auto five = readOne(start + "{A: 0.54, B: 201.0, C: 1024.0, D: 1.1, E: 0.2}}");
  EXPECT_EQ(five.sri->d, 1.1);
  EXPECT_EQ(five.sri->e, 0.2);
}

// k_0 [M]/k_inf has no unit: k_0 is of the reaction's order, k_inf one less.
TEST(MechanismRates, ChemicallyActivated) {
  const auto reaction = readOne(
      "{equation: H + O2 (+M) <=> HO2 (+M), type: chemically-activated, high-P-rate-constant: [5.88e-14, 6.721, "
      "-3022.227], low-P-rate-constant: [2.82320078e+08, 1.46878, -3270.56495], efficiencies: {AR: 0.5}}");
  EXPECT_EQ(reaction.type, Type::ChemicallyActivated);
  expectRate(reaction.lowPressureRate, 282.320078, 1.46878, -3270.56495 * kelvinPerCalorie);
  expectRate(reaction.rate, 5.88e-14, 6.721, -3022.227 * kelvinPerCalorie);
  EXPECT_EQ(reaction.thirdBody->efficiencies[0].coefficient, 0.5);
}

TEST(MechanismRates, PressuresInAnyOrderAndRepeated) {
  const auto reaction = readOne(R"(equation: H + O2 <=> HO2
    type: pressure-dependent-Arrhenius
    rate-constants:
    - {P: 1.01325 MPa, A: 1.68e+16, b: -0.6, Ea: 14754}
    - {P: 1.0 atm, A: 1.26e+20, b: -1.83, Ea: 15003}
    - {P: 1.0 atm, A: -1.26e+19, b: -1.9, Ea: 15100}
    - {P: 0.039474 atm, A: 2.72e+09 cm^3/mol/s, b: 1.2, Ea: 6834}
    - {P: 1e-2, A: 1.0 m^3/kmol/s, b: 0, Ea: 0})");
  EXPECT_EQ(reaction.type, Type::PressureLog);
  EXPECT_FALSE(reaction.thirdBody);
  const auto& rates = reaction.pressureRates;
  ASSERT_EQ(rates.size(), 5U);
  EXPECT_EQ(rates[0].pressure, 1e-2);
  EXPECT_DOUBLE_EQ(rates[1].pressure, 0.039474 * 101325);
  EXPECT_EQ(rates[2].pressure, 101325);
  EXPECT_EQ(rates[3].pressure, 101325);
  EXPECT_DOUBLE_EQ(rates[4].pressure, 1.01325e6);
  expectRate(rates[0].rate, 1e-3, 0, 0);
  expectRate(rates[1].rate, 2.72e3, 1.2, 6834 * kelvinPerCalorie);
  expectRate(rates[2].rate, 1.26e14, -1.83, 15003 * kelvinPerCalorie);
  expectRate(rates[3].rate, -1.26e13, -1.9, 15100 * kelvinPerCalorie);
  expectRate(rates[4].rate, 1.68e10, -0.6, 14754 * kelvinPerCalorie);
}

TEST(MechanismRates, PressuresFollowTheUnitsOfTheReaction) {
  const auto reaction = readOne(
      "{units: {pressure: bar, length: m, quantity: kmol, activation-energy: K}, equation: H + O2 => HO2, type: "
      "pressure-dependent-Arrhenius, rate-constants: [{P: 2, A: 3.0e+5, b: 0, Ea: 10}]}");
  EXPECT_EQ(reaction.pressureRates[0].pressure, 2e5);
  expectRate(reaction.pressureRates[0].rate, 300, 0, 10);
}

// log10 of k in cm3/mol/s is that in m3/mol/s plus six.
TEST(MechanismRates, ChebyshevCarriesTheUnitsInItsFirstCoefficient) {
  for (const std::string equation : {"H + O2 <=> HO2", "H + O2 (+M) <=> HO2 (+M)"}) {
    const auto reaction = readOne("{equation: " + equation + R"(, type: Chebyshev, temperature-range: [290, 3000 K],
    pressure-range: [0.01 atm, 100 atm], data: [[8.2883, -1.1397, -0.12059], [1.9764, 1.0037, 7.2865e-03]]})");
    EXPECT_EQ(reaction.type, Type::Chebyshev);
    EXPECT_FALSE(reaction.thirdBody);
    const auto& rate = *reaction.chebyshev;
    EXPECT_EQ(rate.minTemperature, 290);
    EXPECT_EQ(rate.maxTemperature, 3000);
    EXPECT_DOUBLE_EQ(rate.minPressure, 1013.25);
    EXPECT_DOUBLE_EQ(rate.maxPressure, 10132500);
    EXPECT_EQ(rate.numTemperature, 2U);
    EXPECT_EQ(rate.numPressure, 3U);
    ASSERT_EQ(rate.coefficients.size(), 6U);
    EXPECT_NEAR(rate.coefficients[0], 8.2883 - 6, 1e-14);
    EXPECT_EQ(rate.coefficients[2], -0.12059);
    EXPECT_EQ(rate.coefficients[3], 1.9764);
  }
}

TEST(MechanismRates, NegativeRatesWhereAllowed) {
  const auto plain = readOne("{equation: H + O2 => HO2, negative-A: true, rate-constant: [-2e6, 0, 0]}");
  expectRate(plain.rate, -2, 0, 0);
  const auto falloff = readOne(
      "{equation: H + O2 (+M) => HO2 (+M), type: falloff, negative-A: true, high-P-rate-constant: [-2e6, 0, 0], "
      "low-P-rate-constant: [-3e12, 0, 0]}");
  expectRate(falloff.rate, -2, 0, 0);
  expectRate(falloff.lowPressureRate, -3, 0, 0);
}

// Orders replace coefficients, and set the unit of A.
TEST(MechanismRates, OrdersOfAnySpeciesAndSign) {
  const auto reaction = readOne(
      "{equation: H + O2 => HO2, nonreactant-orders: true, negative-orders: true, orders: {O2: 1.5, AR: -0.25}, "
      "rate-constant: {A: 1.0e+6, b: 0, Ea: 0}}");
  ASSERT_EQ(reaction.orders.size(), 2U);
  EXPECT_EQ(reaction.orders[0].species, 1U);
  EXPECT_EQ(reaction.orders[0].coefficient, 1.5);
  EXPECT_EQ(reaction.orders[1].species, 3U);
  EXPECT_EQ(reaction.orders[1].coefficient, -0.25);
  expectRate(reaction.rate, 1e6 * std::pow(1e-6, 1 + 1.5 - 0.25 - 1), 0, 0);
  EXPECT_EQ(readOne("{equation: H + O2 => HO2, orders: {}, rate-constant: [1, 0, 0]}").orders.size(), 0U);
}

// With efficiency one, the collider is a reactant like any other; otherwise it is a third body of its own.
TEST(MechanismRates, NamedColliders) {
  for (const std::string extra : {"", "type: three-body, ", "efficiencies: {AR: 1}, ",
                                  "type: three-body, efficiencies: {AR: 1}, default-efficiency: 0, "}) {
    const auto plain = readOne("{equation: H + O2 + AR <=> HO2 + AR, " + extra + "rate-constant: [7e17, -0.8, 0]}");
    EXPECT_EQ(plain.type, Type::Elementary) << extra;
    EXPECT_EQ(plain.reactants.size(), 3U);
    EXPECT_FALSE(plain.thirdBody);
    expectRate(plain.rate, 7e5, -0.8, 0);
  }
  const auto weak =
      readOne("{equation: H + 2 O2 <=> HO2 + O2, efficiencies: {O2: 0.7}, rate-constant: [7e17, -0.8, 0]}");
  EXPECT_EQ(weak.type, Type::ThreeBody);
  ASSERT_EQ(weak.reactants.size(), 2U);
  EXPECT_EQ(weak.reactants[1].coefficient, 1);
  EXPECT_EQ(weak.products.size(), 1U);
  EXPECT_EQ(weak.thirdBody->defaultEfficiency, 0);
  EXPECT_EQ(weak.thirdBody->efficiencies[0].species, 1U);
  EXPECT_EQ(weak.thirdBody->efficiencies[0].coefficient, 0.7);
  expectRate(weak.rate, 7e5, -0.8, 0);
  // N2 and AR stand on both sides: the efficiencies say which is the collider.
  const auto chosen =
      readOne("{equation: H + AR + N2 + O2 => HO2 + AR + N2, efficiencies: {N2: 2}, rate-constant: [1, 0, 0]}");
  EXPECT_EQ(chosen.thirdBody->efficiencies[0].species, 4U);
  EXPECT_EQ(chosen.reactants.size(), 3U);
  const auto falloff = readOne(
      "{equation: H + O2 (+AR) <=> HO2 (+AR), type: falloff, efficiencies: {AR: 0.7}, high-P-rate-constant: [1, 0, 0], "
      "low-P-rate-constant: [1, 0, 0]}");
  EXPECT_EQ(falloff.thirdBody->defaultEfficiency, 0);
  EXPECT_EQ(falloff.thirdBody->efficiencies[0].coefficient, 0.7);
}

TEST(MechanismRates, UnitsBehindNumbers) {
  const auto A = [](const std::string& reaction, const std::string& rate) {
    return readOne("{equation: " + reaction + ", rate-constant: " + rate + "}").rate;
  };
  expectRate(A("H + O2 => HO2", "{A: 1.0e+13 cm^3/mol/s, b: 0, Ea: 0}"), 1e7, 0, 0);
  expectRate(A("H + O2 => HO2", "{A: 1.0e+13 m^3/kmol/s, b: 0, Ea: 2 kJ/mol}"), 1e10, 0, 2000 / constants::gasConstant);
  expectRate(A("H + O2 => HO2", "[1.0e-11 cm^3/molec/s, 0, 1 eV]"), 1e-17 * constants::avogadro, 0,
             1.602176634e-19 / constants::boltzmann);
  expectRate(A("H + O2 + M => HO2 + M", "[6 L^2/mol^2/min, 0.5, 300 K]"), 1e-7, 0.5, 300);
  expectRate(A("H + O2 + M => HO2 + M", "[2 cm^6*mol^-2*s^-1, 0, 0]"), 2e-12, 0, 0);
  expectRate(A("HO2 => H + O2", "[3 1/ms, 0, 10 kcal/mol]"), 3000, 0, 10000 * kelvinPerCalorie);
  expectRate(A("HO2 => H + O2", "{A: 3, b: 0, Ea: 0}"), 3, 0, 0);
}

}  // namespace
