// Rates of reactions whose activation energy follows their enthalpy, and whose colliders each have their own: read
// from a file and computed, against the published equations worked out by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "chemistry/kinetics/kinetics.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::kelvinPerCalorie;
using lampblack::test::readFileText;
using lampblack::test::readText;

// Units of the file: cm, mol, cal/mol. The phase has H, O2, HO2, AR and N2.
Mechanism withReaction(const std::string& reaction) {
  return readText("species: [H, O2, HO2, AR, N2]", R"(
- {name: H, composition: {H: 1}, thermo: *t}
- {name: O2, composition: {O: 2}, thermo: *t}
- {name: HO2, composition: {H: 1, O: 2}, thermo: *t}
- {name: AR, composition: {Ar: 1}, thermo: *t}
- {name: N2, composition: {N: 2}, thermo: *t})",
                  "\n- " + reaction);
}

double constantOf(const Mechanism& mechanism, double T, const std::vector<double>& c) {
  Kinetics kinetics(mechanism);
  std::vector<double> forward(mechanism.numReactions()), reverse(mechanism.numReactions());
  kinetics.rateConstants(T, c, forward, reverse);
  return forward[0];
}

// A + B => C with constant heat capacities has H = h_C - h_A - h_B; 1 kJ/mol = 120.27 K.
TEST(BlowersMasel, FollowsTheEnthalpyOfReaction) {
  const auto constant = [](double enthalpy) {
    const auto mechanism = readFileText(
        "units: {length: cm, quantity: mol, activation-energy: kJ/mol, energy: kJ}\n"
        "phases: [{name: g, thermo: ideal-gas, kinetics: gas}]\nspecies:\n"
        "- {name: A, composition: {H: 1}, thermo: {model: constant-cp, cp0: 0.02}}\n"
        "- {name: B, composition: {H: 1}, thermo: {model: constant-cp, T0: 1000, cp0: 0.02, h0: " +
        std::to_string(enthalpy) +
        "}}\n"
        "reactions:\n- {equation: A => B, type: Blowers-Masel, rate-constant: {A: 1e10, b: 0.5, Ea0: 50, w: 400}}\n");
    // h_A at 1000 K is cp (1000 - 298.15).
    return constantOf(mechanism, 1000, {1, 1});
  };
  const double own = 0.02 * (1000 - 298.15), RT = constants::gasConstant;  // kJ/mol at 1000 K
  const auto energy = [&](double H) { return -std::log(constant(H + own) / (1e10 * std::sqrt(1000.0))) * RT; };
  EXPECT_NEAR(energy(0), 50, 1e-4);     // the intrinsic one
  EXPECT_NEAR(energy(-210), 0, 1e-9);   // below -4 Ea0
  EXPECT_NEAR(energy(250), 250, 1e-4);  // above 4 Ea0
  // By hand: V = 800 450/350 = 1028.5714; 450 328.5714^2/427959.18 = 113.5193, 350 128.5714^2/427959.18 = 13.5193.
  EXPECT_NEAR(energy(100), 113.5193, 1e-4);
  EXPECT_NEAR(energy(-100), 13.5193, 1e-4);
}

// PLOG constants for all, argon less efficient by an efficiency that depends on temperature, N2 with its own table.
TEST(LinearBurke, IsTheMixtureRuleOfItsPaper) {
  const auto mechanism = withReaction(R"(equation: H + O2 (+M) => HO2 (+M)
  type: linear-Burke
  colliders:
  - name: M
    type: pressure-dependent-Arrhenius
    rate-constants:
    - {P: 1 atm, A: 2e12, b: 0, Ea: 0}
    - {P: 100 atm, A: 2e14, b: 0, Ea: 0}
  - name: AR
    efficiency: {A: 0.02, b: 0.5, Ea: -100}
  - name: N2
    efficiency: {A: 2, b: 0, Ea: 0}
    type: falloff
    low-P-rate-constant: {A: 1e19, b: -1, Ea: 500}
    high-P-rate-constant: {A: 5e12, b: 0.4, Ea: 0}
    Tsang: {A: 0.9, B: -2e-4})");
  const double T = 1200, total = 20 * constants::oneAtmosphere / (constants::gasConstant * T);
  const double X[] = {0.1, 0.2, 0.0, 0.4, 0.3};
  std::vector<double> c;
  for (const double x : X) c.push_back(x * total);
  const double argon = 0.02 * std::sqrt(T) * std::exp(100 * kelvinPerCalorie / T), nitrogen = 2;
  const double mix = 0.1 + 0.2 + 0.4 * argon + 0.3 * nitrogen;
  // k of M is proportional to p: 2e6 m3/mol/s at 1 atm. Argon takes it at the same pressure p mix.
  const double ofAll = 2e6 * 20 * mix;
  const double M = total * mix / nitrogen;
  const double high = 5e6 * std::pow(T, 0.4), low = 1e7 / T * std::exp(-500 * kelvinPerCalorie / T),
               Pr = low * M / high;
  const double logCentre = std::log10(0.9 - 2e-4 * T), x = std::log10(Pr) - 0.4 - 0.67 * logCentre;
  const double f = x / (0.75 - 1.27 * logCentre - 0.14 * x);
  const double ofNitrogen = high * Pr / (1 + Pr) * std::pow(10, logCentre / (1 + f * f));
  const double expected = ((0.3 + 0.4 * argon) * ofAll + 0.3 * nitrogen * ofNitrogen) / mix;
  EXPECT_NEAR(constantOf(mechanism, T, c), expected, 1e-12 * expected);
}

// Eigenvalues count by their ratio to that of M; in pure M the constant is that of M alone.
TEST(LinearBurke, EigenvaluesAreRatios) {
  const std::string table =
      "type: pressure-dependent-Arrhenius, rate-constants: [{P: 0.01 atm, A: 2e10, b: 0, Ea: 0}, {P: 100 atm, A: 2e14, "
      "b: "
      "0, "
      "Ea: 0}]";
  const auto reaction = [&](const std::string& key, const std::string& all, const std::string& argon) {
    return withReaction("{equation: H + O2 => HO2, type: linear-Burke, colliders: [{name: M, " + all + table +
                        "}, {name: AR, " + key + ": " + argon + "}]}");
  };
  const auto ratios = reaction("eig0", "eig0: {A: 4e3, b: -1, Ea: 500}, ", "{A: 1e3, b: -0.5, Ea: 300}");
  const auto efficiencies = reaction("efficiency", "", "{A: 0.25, b: 0.5, Ea: -200}");
  const std::vector<double> mixed{1, 2, 0, 5, 3}, pure{1, 2, 0, 0, 3};
  EXPECT_DOUBLE_EQ(constantOf(ratios, 900, mixed), constantOf(efficiencies, 900, mixed));
  const double p = constants::gasConstant * 900 * 6;
  EXPECT_NEAR(constantOf(ratios, 900, pure), 2e6 * p / constants::oneAtmosphere,
              1e-12 * 2e6 * p / constants::oneAtmosphere);
}

// A collider that the phase does not have can be left out.
TEST(LinearBurke, UndeclaredCollidersAreLeftOutWhereThePhaseSaysSo) {
  const auto mechanism = readText("species: [H, O2, HO2], skip-undeclared-third-bodies: true", R"(
- {name: H, composition: {H: 1}, thermo: *t}
- {name: O2, composition: {O: 2}, thermo: *t}
- {name: HO2, composition: {H: 1, O: 2}, thermo: *t})",
                                  "\n- {equation: H + O2 => HO2, type: linear-Burke, colliders: [{name: M, type: "
                                  "falloff, low-P-rate-constant: [1, 0, 0], high-P-rate-constant: [1, 0, 0]}, {name: "
                                  "HE, efficiency: [1, 0, 0]}]}");
  EXPECT_EQ(mechanism.reaction(0).colliders.size(), 1U);
}

}  // namespace
