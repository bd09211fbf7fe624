#include "chemistry/thermo/thermo.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::hydrogen;
using lampblack::test::measured;
using lampblack::test::raise;
using lampblack::test::Table;

TEST(Thermo, TemperatureComesBackFromEnthalpyWhateverTheGuess) {
  const auto& mechanism = lampblack::test::ethylene();
  const Thermo thermo(mechanism);
  const Table states("counterflow_c2h4_states.csv");
  std::vector<double> Y(mechanism.numSpecies());
  double worst = 0;
  for (std::size_t s = 0; s < states.size(); ++s) {
    const double T = states.number(s, "T");
    thermo.moleToMass(states.moleFractions(s, mechanism), Y);
    const double h = thermo.enthalpyMass(T, Y);
    for (const double guess : {T, T + 50, 300.0, 3000.0, -1.0, 1e9, std::nan("")}) {
      const double found = thermo.temperatureFromEnthalpy(h, Y, guess);
      raise(worst, found - T);
      EXPECT_NEAR(found, T, 1e-9) << guess;
    }
  }
  measured("temperature from enthalpy, K", worst);
}

// Species whose polynomials change at different temperatures, 200 to 3500 K, from guesses on the other side of some of
// them. Off the changes themselves, where enthalpies jump by what their data leave.
TEST(Thermo, TemperatureComesBackWhereverPolynomialsChange) {
  const auto mechanism = Mechanism::fromFile(test::sourcePath("cases/mechanisms/methane_gri30_53.yaml"));
  const Thermo thermo(mechanism);
  std::set<double> changes;
  for (const auto& species : mechanism.allSpecies()) changes.insert(species.thermo.midTemperature);
  ASSERT_GT(changes.size(), 3u);
  std::vector<double> Y(mechanism.numSpecies(), 1.0 / static_cast<double>(mechanism.numSpecies()));
  for (double T = 200; T < 3500; T += 6.5) {
    if (std::ranges::any_of(changes, [&](double change) { return std::abs(T - change) < 0.5; })) continue;
    const double h = thermo.enthalpyMass(T, Y);
    for (const double guess : {T + 400, T - 150})
      EXPECT_NEAR(thermo.temperatureFromEnthalpy(h, Y, guess), T, 1e-9) << T;
  }
}

TEST(Thermo, TemperatureComesBackFromInternalEnergyWhateverTheGuess) {
  const auto& mechanism = lampblack::test::ethylene();
  const Thermo thermo(mechanism);
  const Table states("counterflow_c2h4_states.csv");
  std::vector<double> Y(mechanism.numSpecies());
  double worst = 0;
  for (std::size_t s = 0; s < states.size(); ++s) {
    const double T = states.number(s, "T");
    thermo.moleToMass(states.moleFractions(s, mechanism), Y);
    const double u = thermo.internalEnergyMass(T, Y);
    for (const double guess : {T, T + 50, 300.0, 3000.0, -1.0, 1e9, std::nan("")})
      raise(worst, thermo.temperatureFromInternalEnergy(u, Y, guess) - T);
  }
  measured("temperature from internal energy, K", worst);
  EXPECT_LT(worst, 1e-9);
  EXPECT_THROW(thermo.temperatureFromInternalEnergy(1e9, Y, 1000), NumericsError);
}

// u = h - p/rho, cv = cp - R/W, g = h - T s, and the mixture's from those of the species.
TEST(Thermo, EnergiesAndEntropiesFitTogether) {
  const auto& mechanism = hydrogen();
  const Thermo thermo(mechanism);
  const std::size_t n = mechanism.numSpecies();
  const double T = 1234, p = 3e5;
  std::vector<double> Y(n), h(n), u(n), s(n), g(n);
  thermo.moleToMass(parseComposition(mechanism, "H2: 0.3, O2: 0.2, N2: 0.5"), Y);
  EXPECT_NEAR(thermo.internalEnergyMass(T, Y) / (thermo.enthalpyMass(T, Y) - p / thermo.density(T, p, Y)), 1, 1e-13);
  EXPECT_NEAR(thermo.cvMass(T, Y) / (thermo.cpMass(T, Y) - p / (thermo.density(T, p, Y) * T)), 1, 1e-14);
  thermo.speciesEnthalpies(T, h);
  thermo.speciesInternalEnergies(T, u);
  thermo.speciesEntropies(T, s);
  thermo.speciesGibbs(T, g);
  double mixture = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double RT = constants::gasConstant * T / mechanism.molecularWeights()[k];
    EXPECT_NEAR(u[k], h[k] - RT, 1e-13 * std::abs(h[k]));
    EXPECT_NEAR(g[k], h[k] - T * s[k], 1e-13 * std::abs(T * s[k]));
    mixture += Y[k] * u[k];
  }
  EXPECT_NEAR(mixture / thermo.internalEnergyMass(T, Y), 1, 1e-13);
  // Pressure and mixing: a gas alone at 1 atm has its standard entropy.
  std::vector<double> alone(n, 0.0);
  const auto N2 = mechanism.speciesIndex("N2");
  alone[N2] = 1;
  const double R = constants::gasConstant / mechanism.molecularWeights()[N2];
  EXPECT_NEAR(thermo.entropyMass(T, constants::oneAtmosphere, alone), s[N2], 1e-13 * s[N2]);
  EXPECT_NEAR(thermo.entropyMass(T, 2 * constants::oneAtmosphere, alone), s[N2] - R * std::log(2.0), 1e-13 * s[N2]);
}

TEST(Thermo, EnthalpyOutsideTheRangeIsAnError) {
  const auto& mechanism = hydrogen();
  const Thermo thermo(mechanism);
  std::vector<double> Y(mechanism.numSpecies(), 0.0);
  Y[mechanism.speciesIndex("N2")] = 1;
  EXPECT_THROW(thermo.temperatureFromEnthalpy(1e9, Y, 1000), NumericsError);
  EXPECT_THROW(thermo.temperatureFromEnthalpy(-1e9, Y, 1000), NumericsError);
  EXPECT_THROW(thermo.temperatureFromEnthalpy(std::nan(""), Y, 1000), NumericsError);
}

TEST(Thermo, MassAndMoleFractionsAreInverse) {
  const auto& mechanism = hydrogen();
  const Thermo thermo(mechanism);
  const auto X = parseComposition(mechanism, "H2: 0.3, O2: 0.2, N2: 0.5");
  std::vector<double> Y(X.size()), back(X.size());
  thermo.moleToMass(X, Y);
  thermo.massToMole(Y, back);
  for (std::size_t k = 0; k < X.size(); ++k) EXPECT_NEAR(back[k], X[k], 1e-15);
}

// The data's two ranges meet at the middle temperature: cp and h jump there only by the digits of the fit.
TEST(Thermo, RangesJoin) {
  const auto& mechanism = lampblack::test::ethylene();
  const Thermo thermo(mechanism);
  std::vector<double> below(mechanism.numSpecies()), above(mechanism.numSpecies());
  for (std::size_t k = 0; k < mechanism.numSpecies(); ++k) {
    const double T = mechanism.species(k).thermo.midTemperature;
    thermo.speciesEnthalpies(T, below);
    thermo.speciesEnthalpies(T * (1 + 1e-12), above);
    EXPECT_NEAR(above[k], below[k], 3e-3 * constants::gasConstant / mechanism.molecularWeights()[k] * T)
        << mechanism.speciesName(k);
  }
}

}  // namespace
