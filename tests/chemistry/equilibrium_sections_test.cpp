// Equilibria with sections of soot of up to 1e9 atoms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "chemistry/thermo/equilibrium.hpp"
#include "chemistry/thermo/species_thermo.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/equilibrium_support.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::content;
using lampblack::test::massFractions;
using lampblack::test::measured;
using lampblack::test::moleFractions;

// H2, O2, H2O, CO, CO2, CH4, C2H2, C2H4, H, O, OH and a section of soot (C H0.3)n, all of constant heat capacity; per
// atom of carbon the section is the same whatever its size.
Mechanism withSection(double carbon, bool smallerToo = false) {
  std::string text =
      "phases: [{name: gas, thermo: ideal-gas, elements: [H, C, O], species: all}]\nunits: {quantity: mol}\nspecies:\n";
  const auto add = [&](const char* name, const std::string& atoms, double h, double s, double cp) {
    text += fmt::format(
        "- {{name: {}, composition: {{{}}}, thermo: {{model: constant-cp, T0: 298.15, h0: {} kJ/mol, s0: {}, "
        "cp0: {}}}}}\n",
        name, atoms, h, s, cp);
  };
  add("H2", "H: 2", 0, 130.7, 31);
  add("O2", "O: 2", 0, 205.1, 34);
  add("H2O", "H: 2, O: 1", -241.8, 188.8, 41);
  add("CO", "C: 1, O: 1", -110.5, 197.7, 32);
  add("CO2", "C: 1, O: 2", -393.5, 213.8, 52);
  add("CH4", "C: 1, H: 4", -74.6, 186.3, 72);
  add("C2H2", "C: 2, H: 2", 227.4, 200.9, 63);
  add("C2H4", "C: 2, H: 4", 52.4, 219.3, 85);
  add("H", "H: 1", 218, 114.7, 20.8);
  add("O", "O: 1", 249.2, 161.1, 20.9);
  add("OH", "O: 1, H: 1", 38.99, 183.7, 30.5);
  add("BIG", fmt::format("C: {}, H: {}", carbon, 0.3 * carbon), 2 * carbon, 8 * carbon, 22 * carbon);
  for (double c = 20; smallerToo && c < carbon; c *= 2)
    for (const double hydrogen : {0.8, 0.5, 0.25})
      add(fmt::format("BIN{}_{}", c, hydrogen).c_str(), fmt::format("C: {}, H: {}", c, hydrogen * c),
          c * (1.56 + 1.5 / std::cbrt(c) + 0.8 * hydrogen), c * (8 + 10.8 * hydrogen + 2 / std::cbrt(c)),
          c * (22 + 6 * hydrogen));
  return lampblack::test::readFileText(text);
}

// Sections from 20 atoms of carbon on, each twice as large as the last, of three contents of hydrogen.
TEST(Equilibrium, WithManySections) {
  const auto mechanism = withSection(3e8, true);
  Equilibrium equilibrium(mechanism);
  for (const double phi : {2.9, 4.0, 10.0})
    for (const double T : {600.0, 1800.0, 2600.0}) {
      auto Y = massFractions(mechanism, fmt::format("C2H4: {}, O2: 3", phi));
      const auto before = Y;
      ASSERT_NO_THROW(equilibrium.atTemperatureAndPressure(T, 1e6, Y)) << phi << " " << T;
      for (std::size_t e = 0; e < 3; ++e)
        EXPECT_NEAR(content(mechanism, e, Y) / content(mechanism, e, before), 1, 1e-13);
    }
}

// By a minimisation of Gibbs' energy of its own kind (numpy, balances to 4e-13), 1800 K, 1 atm, phi 4.
TEST(Equilibrium, WithASectionOfSoot) {
  const auto mechanism = withSection(1e5);
  auto Y = massFractions(mechanism, "C2H4: 4, O2: 3");
  Equilibrium(mechanism).atTemperatureAndPressure(1800, constants::oneAtmosphere, Y);
  const auto X = moleFractions(mechanism, Y);
  const std::pair<const char*, double> expected[] = {{"H2", 0.5363},    {"CO", 0.4405},     {"CH4", 0.01085},
                                                     {"C2H2", 0.01177}, {"C2H4", 3.629e-4}, {"H", 2.416e-4},
                                                     {"H2O", 8.972e-6}, {"CO2", 2.358e-6},  {"BIG", 1.117e-6}};
  for (const auto& [name, value] : expected) EXPECT_NEAR(X[mechanism.speciesIndex(name)], value, 1e-3 * value) << name;
}

// There or not there, from sections that the path finds at once to those of 1e9 atoms of carbon, lean to very rich:
// atoms are kept, all species have the potentials of their elements, and a section that is not there has none to gain.
TEST(Equilibrium, WithSectionsOfAnySize) {
  double balance = 0, potential = 0;
  int present = 0, absent = 0;
  for (const double carbon : {1e2, 1e5, 1e7, 1e9}) {
    const auto mechanism = withSection(carbon);
    const Thermo thermo(mechanism);
    SpeciesThermo species(mechanism.allSpecies());
    Equilibrium equilibrium(mechanism);
    for (const double phi : {1.0, 2.9, 3.05, 4.0, 6.0, 10.0})
      for (const double T0 : {300.0, 1400.0, 2200.0})
        for (const double p : {1e4, 1e7})
          for (const bool adiabatic : {false, true}) {
            SCOPED_TRACE(fmt::format("{} C, phi {}, {} K, {} Pa, {}", carbon, phi, T0, p, adiabatic));
            auto Y = massFractions(mechanism, fmt::format("C2H4: {}, O2: 3", phi));
            const auto before = Y;
            const double h = thermo.enthalpyMass(T0, Y);
            double T = T0;
            if (adiabatic)
              T = equilibrium.atEnthalpyAndPressure(h, p, Y);
            else
              equilibrium.atTemperatureAndPressure(T, p, Y);
            if (adiabatic) {
              EXPECT_NEAR(thermo.enthalpyMass(T, Y), h, 1e-9 * thermo.cpMass(T, Y) * T);
            }
            for (std::size_t e = 0; e < 3; ++e)
              balance = std::max(balance, std::abs(content(mechanism, e, Y) / content(mechanism, e, before) - 1));
            const auto X = moleFractions(mechanism, Y);
            std::vector<double> g(X.size());
            species.gibbsOverRT(T, std::log(T), g.data());
            const auto of = [&](const char* name) {
              const auto k = mechanism.speciesIndex(name);
              return g[k] + std::log(X[k] * p / constants::oneAtmosphere);
            };
            const double H = of("H2") / 2, O = of("H2O") - 2 * H, C = of("CO") - O;
            for (std::size_t k = 0; k < X.size(); ++k) {
              const double atoms = mechanism.atoms(k, 0) + mechanism.atoms(k, 1) + mechanism.atoms(k, 2);
              const double formed =
                  (mechanism.atoms(k, 0) * H + mechanism.atoms(k, 1) * C + mechanism.atoms(k, 2) * O) / atoms;
              const double own = (g[k] + std::log(std::max(X[k], 1e-300) * p / constants::oneAtmosphere)) / atoms;
              if (X[k] > 1e-290)
                potential = std::max(potential, std::abs(own - formed));
              else
                EXPECT_GT(own, formed);
            }
            ++(X.back() > 1e-290 ? present : absent);
          }
  }
  measured("sections of 1e2 to 1e9 C, worst element, of itself", balance);
  measured("sections of 1e2 to 1e9 C, worst potential, RT per atom", potential);
  EXPECT_LT(balance, 1e-13);
  EXPECT_LT(potential, 1e-10);
  EXPECT_GT(present, 50);
  EXPECT_GT(absent, 50);
}

}  // namespace
