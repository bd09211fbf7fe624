// YAML files that Lampblack writes give back every double.
#include "chemistry/mechanism/mechanism_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "chemistry/kinetics/kinetics.hpp"
#include "chemistry/mechanism/yaml_text.hpp"
#include "tests/chemistry/chemkin_support.hpp"
#include "tests/chemistry/kinetics_rate_types.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::inputMessage;
using lampblack::test::readFileText;

TEST(YamlText, NumbersComeBack) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    EXPECT_EQ(std::strtod(yamlNumber(value).c_str(), nullptr), value);
  }
  EXPECT_EQ(yamlNumber(1e17), "1.0e+17");
  EXPECT_EQ(yamlNumber(101325), "101325");
  EXPECT_EQ(yamlNumber(0.1), "0.1");
  EXPECT_EQ(yamlNumber(-2.5e-7), "-2.5e-07");
  // In the unit of the file: the digits that the file had.
  for (const char* given : {"3.458", "2.605", "1.844", "107.4", "1e-3", "2.0141017781"})
    for (const double factor : {1e-10, 1e-3, 3.33564095198e-30, 1e-30})
      EXPECT_EQ(std::stod(yamlNumber(std::stod(given) * factor, factor)), std::stod(given)) << given;
}

TEST(YamlText, NamesComeBack) {
  for (const char* name :
       {"NO",     "N",          "y",   "Yes",  "off",   "ON",   "True",     "null", "NaN",  "~",  "1E5",
        "1-C4H8", "C5H5O(1,3)", "a:b", "a: b", "#x",    "x #y", "'quoted'", "CH2*", "*CH2", "&x", "-",
        "-x",     "[x]",        "{x}", "x'",   "\"x\"", "%x",   "@x",       "`x",   "x\\y", "!x", "|",
        ">",      "?",          "NO+", "e-",   ".5",    "H2O",  "=",        "C=C"}) {
    const auto list = YAML::Load("{a: [" + yamlName(name) + ", x], " + yamlName(name) + ": 1}");
    EXPECT_EQ(list["a"][0].Scalar(), name);
    EXPECT_EQ(list[name].as<int>(), 1);
  }
  for (const char* name : {"NO", "n", "Off", "1E5", "y"}) EXPECT_EQ(yamlName(name)[0], '\'') << name;
  for (const char* name : {"H2O", "CH2(S)", "A1-", "CH2*"}) EXPECT_EQ(yamlName(name), name);
  for (const char* text :
       {"one line", "two\nlines\n\n  and a: #half", " edge", "edge\n", "tab\t, \"quotes\" \\ \x01", "#"})
    EXPECT_EQ(YAML::Load("a: " + yamlBlock(text) + "\nb: 1\n")["a"].Scalar(), text);
}

void expectSame(const Arrhenius& a, const Arrhenius& b) {
  EXPECT_EQ(a.A, b.A);
  EXPECT_EQ(a.b, b.b);
  EXPECT_EQ(a.activationTemperature, b.activationTemperature);
}

void expectSame(const std::vector<StoichiometricTerm>& a, const std::vector<StoichiometricTerm>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].species, b[i].species);
    EXPECT_EQ(a[i].coefficient, b[i].coefficient);
  }
}

void expectSame(const Species& a, const Species& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.atoms, b.atoms);
  EXPECT_EQ(a.molecularWeight, b.molecularWeight);
  EXPECT_EQ(a.thermo.minTemperature, b.thermo.minTemperature);
  EXPECT_EQ(a.thermo.midTemperature, b.thermo.midTemperature);
  EXPECT_EQ(a.thermo.maxTemperature, b.thermo.maxTemperature);
  EXPECT_EQ(a.thermo.low, b.thermo.low);
  EXPECT_EQ(a.thermo.high, b.thermo.high);
  ASSERT_EQ(a.nasa9.has_value(), b.nasa9.has_value());
  if (a.nasa9) {
    EXPECT_EQ(a.nasa9->temperatures, b.nasa9->temperatures);
    EXPECT_EQ(a.nasa9->ranges, b.nasa9->ranges);
  }
  ASSERT_EQ(a.transport.has_value(), b.transport.has_value());
  if (!a.transport) return;
  EXPECT_EQ(a.transport->shape, b.transport->shape);
  EXPECT_EQ(a.transport->wellDepth, b.transport->wellDepth);
  EXPECT_EQ(a.transport->diameter, b.transport->diameter);
  EXPECT_EQ(a.transport->dipole, b.transport->dipole);
  EXPECT_EQ(a.transport->polarizability, b.transport->polarizability);
  EXPECT_EQ(a.transport->rotationalRelaxation, b.transport->rotationalRelaxation);
}

void expectSame(const Reaction& a, const Reaction& b) {
  EXPECT_EQ(a.type, b.type);
  expectSame(a.reactants, b.reactants);
  expectSame(a.products, b.products);
  expectSame(a.orders, b.orders);
  EXPECT_EQ(a.reversible, b.reversible);
  EXPECT_EQ(a.duplicate, b.duplicate);
  expectSame(a.rate, b.rate);
  expectSame(a.lowPressureRate, b.lowPressureRate);
  ASSERT_EQ(a.troe.has_value(), b.troe.has_value());
  if (a.troe) {
    EXPECT_EQ(a.troe->A, b.troe->A);
    EXPECT_EQ(a.troe->T3, b.troe->T3);
    EXPECT_EQ(a.troe->T1, b.troe->T1);
    EXPECT_EQ(a.troe->T2, b.troe->T2);
  }
  ASSERT_EQ(a.sri.has_value(), b.sri.has_value());
  if (a.sri) {
    EXPECT_EQ(a.sri->a, b.sri->a);
    EXPECT_EQ(a.sri->b, b.sri->b);
    EXPECT_EQ(a.sri->c, b.sri->c);
    EXPECT_EQ(a.sri->d, b.sri->d);
    EXPECT_EQ(a.sri->e, b.sri->e);
  }
  ASSERT_EQ(a.tsang.has_value(), b.tsang.has_value());
  if (a.tsang) {
    EXPECT_EQ(a.tsang->A, b.tsang->A);
    EXPECT_EQ(a.tsang->B, b.tsang->B);
  }
  ASSERT_EQ(a.blowersMasel.has_value(), b.blowersMasel.has_value());
  if (a.blowersMasel) {
    EXPECT_EQ(a.blowersMasel->bondEnergy, b.blowersMasel->bondEnergy);
  }
  ASSERT_EQ(a.colliders.size(), b.colliders.size());
  for (std::size_t i = 0; i < a.colliders.size(); ++i) {
    EXPECT_EQ(a.colliders[i].species, b.colliders[i].species);
    expectSame(a.colliders[i].efficiency, b.colliders[i].efficiency);
    ASSERT_EQ(a.colliders[i].ownRate, b.colliders[i].ownRate);
    if (a.colliders[i].ownRate) expectSame(a.colliders[i].rate, b.colliders[i].rate);
  }
  ASSERT_EQ(a.thirdBody.has_value(), b.thirdBody.has_value());
  if (a.thirdBody) {
    EXPECT_EQ(a.thirdBody->defaultEfficiency, b.thirdBody->defaultEfficiency);
    expectSame(a.thirdBody->efficiencies, b.thirdBody->efficiencies);
  }
  ASSERT_EQ(a.pressureRates.size(), b.pressureRates.size());
  for (std::size_t i = 0; i < a.pressureRates.size(); ++i) {
    EXPECT_EQ(a.pressureRates[i].pressure, b.pressureRates[i].pressure);
    expectSame(a.pressureRates[i].rate, b.pressureRates[i].rate);
  }
  ASSERT_EQ(a.chebyshev.has_value(), b.chebyshev.has_value());
  if (a.chebyshev) {
    EXPECT_EQ(a.chebyshev->minTemperature, b.chebyshev->minTemperature);
    EXPECT_EQ(a.chebyshev->maxTemperature, b.chebyshev->maxTemperature);
    EXPECT_EQ(a.chebyshev->minPressure, b.chebyshev->minPressure);
    EXPECT_EQ(a.chebyshev->maxPressure, b.chebyshev->maxPressure);
    EXPECT_EQ(a.chebyshev->numTemperature, b.chebyshev->numTemperature);
    EXPECT_EQ(a.chebyshev->numPressure, b.chebyshev->numPressure);
    EXPECT_EQ(a.chebyshev->coefficients, b.chebyshev->coefficients);
  }
}

std::vector<double> productionRates(const Mechanism& mechanism, double T) {
  Kinetics kinetics(mechanism);
  std::vector<double> c(mechanism.numSpecies()), wdot(mechanism.numSpecies());
  for (std::size_t k = 0; k < c.size(); ++k) c[k] = 0.5 + 0.25 * static_cast<double>(k % 5);
  kinetics.netProductionRates(T, c, wdot);
  return wdot;
}

// Written and read again, a mechanism is the same to the last bit, and so is what is computed with it; written once
// more, the file is the same too.
void expectRoundTrip(const Mechanism& mechanism) {
  const auto text = mechanismYaml(mechanism);
  const auto again = readFileText(text);
  EXPECT_EQ(again.description(), mechanism.description());
  ASSERT_EQ(again.numElements(), mechanism.numElements());
  for (std::size_t i = 0; i < mechanism.numElements(); ++i) {
    EXPECT_EQ(again.elementName(i), mechanism.elementName(i));
    EXPECT_EQ(again.atomicWeight(i), mechanism.atomicWeight(i));
  }
  ASSERT_EQ(again.numSpecies(), mechanism.numSpecies());
  for (std::size_t k = 0; k < mechanism.numSpecies(); ++k) expectSame(again.species(k), mechanism.species(k));
  ASSERT_EQ(again.numReactions(), mechanism.numReactions());
  for (std::size_t r = 0; r < mechanism.numReactions(); ++r) {
    SCOPED_TRACE(mechanism.reaction(r).equation);
    expectSame(again.reaction(r), mechanism.reaction(r));
  }
  for (const double T : {300.0, 1000.0, 1800.0}) EXPECT_EQ(productionRates(again, T), productionRates(mechanism, T));
  EXPECT_EQ(mechanismYaml(again), text);
}

TEST(MechanismWriter, ShippedMechanisms) {
  expectRoundTrip(lampblack::test::hydrogen());
  expectRoundTrip(lampblack::test::ethylene());
}

TEST(MechanismWriter, EveryFeatureOfChemkin) {
  std::ifstream file(lampblack::test::sourcePath("tests/chemistry/data/chemkin_features.inp"));
  std::ostringstream text;
  text << file.rdbuf();
  const auto mechanism = lampblack::test::readChemkinText(text.str(), nullptr, std::nullopt);
  for (const auto type : {Reaction::Type::Elementary, Reaction::Type::ThreeBody, Reaction::Type::Falloff,
                          Reaction::Type::ChemicallyActivated, Reaction::Type::PressureLog, Reaction::Type::Chebyshev})
    EXPECT_TRUE(std::ranges::any_of(mechanism.reactions(), [&](const auto& r) { return r.type == type; }));
  expectRoundTrip(mechanism);
}

TEST(MechanismWriter, EveryKindOfRate) {
  expectRoundTrip(lampblack::test::RateTypes::mechanism());
}

// Ions and electrons, Shomate polynomials and constant heat capacities.
TEST(MechanismWriter, IonsAndOtherThermo) {
  expectRoundTrip(readFileText(R"(
phases: [{name: gas, thermo: ideal-gas, kinetics: gas}]
species:
- {name: NO, composition: {N: 1, O: 1}, thermo: {model: constant-cp, h0: 9.1e7, s0: 2.1e5, cp0: 3.0e4}}
- name: NO+
  composition: {N: 1, O: 1, E: -1}
  thermo: {model: constant-cp, T0: 300 K, h0: 236 kcal/mol, s0: 47 cal/mol/K, cp0: 7 cal/mol/K, T-max: 5000 K}
- name: E
  composition: {E: 1}
  thermo: {model: Shomate, temperature-ranges: [298, 1000, 6000], reference-pressure: 1 bar,
           data: [[20.8, 1e-3, 0, 0, 1e-4, -6.2, 46], [20.7, 2e-3, 1e-4, -1e-5, 0, -6.1, 46.1]]}
reactions:
- equation: NO+ + E <=> NO
  rate-constant: {A: 1e12, b: -0.5, Ea: 0}
)"));
}

TEST(MechanismWriter, Nasa9) {
  expectRoundTrip(readFileText(R"(
phases: [{name: gas, thermo: ideal-gas, elements: [N], species: [NO]}]
elements: [{symbol: N, atomic-weight: 14.00307}]
species:
- name: NO
  composition: {N: 2}
  thermo:
    model: NASA9
    temperature-ranges: [200.0, 1000.0, 6000.0]
    data:
    - [2.210371497e4, -381.846182, 6.08273836, -8.53091441e-3, 1.384646189e-5, -9.62579362e-9, 2.519705809e-12, 710.846086, -10.76003744]
    - [5.87712406e5, -2239.249073, 6.06694922, -6.1396855e-4, 1.491806679e-7, -1.923105485e-11, 1.061954386e-15, 1.283210415e4, -15.86640027]
)"));
}

TEST(MechanismWriter, FilesAppearWhole) {
  namespace fs = std::filesystem;
  const test::ScratchFolder folder;
  const auto path = (folder.path() / "mech.yaml").string();
  writeMechanism(lampblack::test::hydrogen(), path);
  EXPECT_EQ(Mechanism::fromFile(path).numReactions(), lampblack::test::hydrogen().numReactions());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator{}), 1);
  fs::remove_all(folder.path());
  EXPECT_THAT(inputMessage([&] { writeMechanism(lampblack::test::hydrogen(), path); }),
              ::testing::HasSubstr("cannot write the mechanism file"));
}

}  // namespace
