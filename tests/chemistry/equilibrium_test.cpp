#include "chemistry/thermo/equilibrium.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

#include "chemistry/kinetics/kinetics.hpp"
#include "chemistry/thermo/species_thermo.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "tests/chemistry/equilibrium_support.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/effort.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::content;
using lampblack::test::fewOrMany;
using lampblack::test::hydrogen;
using lampblack::test::massFractions;
using lampblack::test::measured;
using lampblack::test::moleFractions;
using lampblack::test::raise;
using lampblack::test::shipped;

// Cantera 3.2.0, constant enthalpy and pressure (ignition.csv: T_equil_HP).
TEST(Equilibrium, AdiabaticTemperaturesAgreeWithCantera) {
  struct Case {
    const char *file, *X;
    double T0, T;
  };
  for (const Case& flame : {Case{"methane_gri30_53", "CH4:1, O2:2, N2:7.52", 1400, 2697.883232506094},
                            Case{"hydrogen_h2o2_10", "H2:2, O2:1, N2:3.76", 1200, 2763.31973514038}}) {
    const auto mechanism = shipped(flame.file);
    const Thermo thermo(mechanism);
    Equilibrium equilibrium(mechanism);
    auto Y = massFractions(mechanism, flame.X);
    const double h = thermo.enthalpyMass(flame.T0, Y);
    const double T = equilibrium.atEnthalpyAndPressure(h, constants::oneAtmosphere, Y);
    measured(std::string(flame.file) + ", K from Cantera", std::abs(T - flame.T));
    EXPECT_NEAR(T, flame.T, 1e-6);
    EXPECT_NEAR(thermo.enthalpyMass(T, Y), h, 1e-12 * thermo.cpMass(T, Y) * T);
  }
}

// 200 to 4000 K, 1e-6 to 100 bar; dense mixtures, mixtures over forty e-folds and of three species with traces.
class RandomStates {
 public:
  RandomStates(const Mechanism& mechanism, unsigned seed) : mechanism_(mechanism), random_(seed) {}

  void next() {
    X.assign(mechanism_.numSpecies(), 0.0);
    const int kind = count_++ % 3;
    if (kind == 0)
      for (double& x : X) x = uniform(0, 1);
    else if (kind == 1)
      for (double& x : X) x = std::exp(uniform(-40, 0));
    else
      for (int i = 0; i < 5; ++i) X[random_() % X.size()] = i < 3 ? uniform(0.1, 1) : std::exp(uniform(-60, 0));
    double sum = 0;
    for (const double x : X) sum += x;
    for (double& x : X) x /= sum;
    T = uniform(200, 4000);
    p = std::exp(uniform(std::log(0.1), std::log(1e7)));
  }

  double T = 0, p = 0;
  std::vector<double> X;

 private:
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }

  const Mechanism& mechanism_;
  std::mt19937_64 random_;
  int count_ = 0;
};

class EquilibriumOf : public ::testing::TestWithParam<const char*> {};

// Every reversible reaction runs as fast backward as forward, and the atoms are those that were there. Rates are
// exponentials of up to 1e3 or so: 1e-16 of it, and four potentials a reaction, is below 1e-11.
TEST_P(EquilibriumOf, BalancesReactionsAndKeepsAtoms) {
  const auto mechanism = shipped(GetParam());
  const Thermo thermo(mechanism);
  Equilibrium equilibrium(mechanism);
  Kinetics kinetics(mechanism);
  RandomStates state(mechanism, 3);
  const std::size_t n = mechanism.numSpecies();
  std::vector<double> Y(n), start(n), c(n), forward(mechanism.numReactions()), reverse(forward.size());
  double worstRate = 0, worstAtoms = 0, iterations = 0;
  std::size_t compared = 0;
  const int states = 200;
  for (int i = 0; i < states; ++i) {
    state.next();
    thermo.moleToMass(state.X, start);
    Y = start;
    ASSERT_NO_THROW(equilibrium.atTemperatureAndPressure(state.T, state.p, Y));
    iterations += static_cast<double>(equilibrium.iterations()) / states;
    for (std::size_t e = 0; e < mechanism.numElements(); ++e) {
      const double before = content(mechanism, e, start);
      if (before > 0) raise(worstAtoms, content(mechanism, e, Y) / before - 1);
    }
    const auto X = moleFractions(mechanism, Y);
    for (std::size_t k = 0; k < n; ++k) c[k] = X[k] * state.p / (constants::gasConstant * state.T);
    kinetics.ratesOfProgress(state.T, c, forward, reverse);
    for (std::size_t r = 0; r < forward.size(); ++r) {
      // Exponentials saturate near 1e-307.
      if (!mechanism.reaction(r).reversible || !(forward[r] > 1e-200 && reverse[r] > 1e-200)) continue;
      raise(worstRate, reverse[r] / forward[r] - 1);
      ++compared;
    }
  }
  measured("reverse over forward rate, from 1", worstRate);
  measured("elements", worstAtoms);
  measured("iterations", iterations);
  EXPECT_GT(compared, forward.size());
  EXPECT_LT(worstRate, 1e-11);
  EXPECT_LT(worstAtoms, 1e-12);
}

// An equilibrium found again from its enthalpy, entropy, energy and density. Not at 1000 K, where many polynomials
// change range and their enthalpies jump by 1e-8 or so.
TEST_P(EquilibriumOf, IsTheSameFromAnyPairOfProperties) {
  const auto mechanism = shipped(GetParam());
  const Thermo thermo(mechanism);
  Equilibrium equilibrium(mechanism);
  RandomStates state(mechanism, 4);
  std::vector<double> Y(mechanism.numSpecies()), start(Y.size());
  double worst = 0;
  for (int i = 0; i < 30; ++i) {
    state.next();
    thermo.moleToMass(state.X, start);
    const double T = 450 + 100 * i;
    Y = start;
    equilibrium.atTemperatureAndPressure(T, state.p, Y);
    const double h = thermo.enthalpyMass(T, Y), density = thermo.density(T, state.p, Y);
    auto again = start;
    raise(worst, equilibrium.atEnthalpyAndPressure(h, state.p, again) / T - 1);
    again = start;
    raise(worst, equilibrium.atEntropyAndPressure(thermo.entropyMass(T, state.p, Y), state.p, again) / T - 1);
    again = start;
    raise(worst, equilibrium.atEnergyAndDensity(thermo.internalEnergyMass(T, Y), density, again) / T - 1);
    again = start;
    equilibrium.atTemperatureAndDensity(T, density, again);
    for (std::size_t k = 0; k < Y.size(); ++k) raise(worst, again[k] - Y[k]);
  }
  measured("temperature, and mass fractions", worst);
  EXPECT_LT(worst, 1e-12);
}

// Only the elements count, not what they are given as.
TEST_P(EquilibriumOf, ForgetsTheCompositionItStartedFrom) {
  const auto mechanism = shipped(GetParam());
  const Thermo thermo(mechanism);
  Equilibrium equilibrium(mechanism);
  RandomStates state(mechanism, 5);
  std::vector<double> Y(mechanism.numSpecies());
  double worst = 0;
  for (int i = 0; i < 50; ++i) {
    state.next();
    thermo.moleToMass(state.X, Y);
    auto other = Y;
    equilibrium.atTemperatureAndPressure(0.5 * (state.T + 2000), 1e5, other);
    equilibrium.atTemperatureAndPressure(state.T, state.p, other);
    equilibrium.atTemperatureAndPressure(state.T, state.p, Y);
    for (std::size_t k = 0; k < Y.size(); ++k) raise(worst, other[k] - Y[k]);
  }
  measured("mass fractions", worst);
  EXPECT_LT(worst, 1e-12);
}

// The number of docs/theory/chemistry.md: in a long run 4000 of each mechanism.
TEST_P(EquilibriumOf, IsFoundForRandomMixtures) {
  const auto mechanism = shipped(GetParam());
  const Thermo thermo(mechanism);
  Equilibrium equilibrium(mechanism);
  RandomStates state(mechanism, 6);
  std::vector<double> Y(mechanism.numSpecies());
  const int states = fewOrMany(100, 4000);
  int lost = 0;
  for (int i = 0; i < states; ++i) {
    state.next();
    thermo.moleToMass(state.X, Y);
    try {
      equilibrium.atTemperatureAndPressure(state.T, state.p, Y);
    } catch (const NumericsError& error) {
      ++lost;
      std::cout << error.what() << '\n';
    }
  }
  measured("not found", lost);
  EXPECT_EQ(lost, 0);
}

INSTANTIATE_TEST_SUITE_P(Mechanisms, EquilibriumOf,
                         ::testing::Values("hydrogen_h2o2_10", "hydrogen_sandiego_9", "methane_drm19_21",
                                           "methane_gri30_53", "ethylene_bisetti2012_47", "ethylene_abf2000_101",
                                           "ethylene_narayanaswamy2010_158", "ethylene_km2_202", "silica_teos_29"),
                         [](const auto& param) { return std::string(param.param); });

// H2 = 2 H alone: with degree of dissociation a, 4 a^2/(1 - a^2) p/p0 = Kp.
TEST(Equilibrium, OfADissociationIsTheExactOne) {
  const auto& mechanism = hydrogen();
  Kinetics kinetics(mechanism);
  Equilibrium equilibrium(mechanism);
  const auto reactions = mechanism.reactions();
  const auto recombination =
      static_cast<std::size_t>(std::find_if(reactions.begin(), reactions.end(),
                                            [](const Reaction& r) { return r.equation == "2 H + M <=> H2 + M"; }) -
                               reactions.begin());
  ASSERT_LT(recombination, reactions.size());
  std::vector<double> Kc(reactions.size());
  double worst = 0;
  for (const double T : {200.0, 300.0, 1000.0, 2500.0, 4000.0})
    for (const double p : {0.1, 1e5, 1e7}) {
      kinetics.equilibriumConstants(T, Kc);
      const double Kp = constants::gasConstant * T / Kc[recombination] / p;  // times p0/p
      const double a = std::sqrt(Kp / (Kp + 4));
      auto Y = massFractions(mechanism, "H: 1");
      equilibrium.atTemperatureAndPressure(T, p, Y);
      const auto X = moleFractions(mechanism, Y);
      raise(worst, X[mechanism.speciesIndex("H")] / (2 * a / (1 + a)) - 1);
      EXPECT_EQ(Y[mechanism.speciesIndex("O2")], 0);
    }
  measured("amount of H", worst);
  EXPECT_LT(worst, 1e-12);
}

// Ar = Ar+ + e-, a gas of no charge: with degree of ionisation a, a^2/(1 - a^2) p/p0 = Kp (Saha 1920).
TEST(Equilibrium, OfAnIonisationIsTheExactOne) {
  const double electronWeight = 5.48579909e-7;
  const auto monatomic = [](double enthalpy, double entropy) {
    Nasa7 data;
    data.minTemperature = 200, data.midTemperature = 1000, data.maxTemperature = 6000;
    data.low = data.high = {2.5, 0, 0, 0, 0, enthalpy, entropy};
    return data;
  };
  std::vector<Species> species(3);
  species[0].name = "AR", species[0].atoms = {1, 0}, species[0].molecularWeight = 39.95e-3;
  species[0].thermo = monatomic(-745.375, 4.36);
  species[1].name = "AR+", species[1].atoms = {1, -1}, species[1].molecularWeight = 39.95e-3 - electronWeight;
  species[1].thermo = monatomic(180000, 5.8);
  species[2].name = "E", species[2].atoms = {0, 1}, species[2].molecularWeight = electronWeight;
  species[2].thermo = monatomic(-745.375, -11.73);
  const Mechanism mechanism("argon", "", {{"Ar", 39.95e-3}, {"E", electronWeight}}, species, {});
  Equilibrium equilibrium(mechanism);
  for (const double T : {300.0, 2000.0, 5900.0}) {
    const double p = 10.0;
    const double lnK = -(180000 - 745.375 + 745.375) / T + (5.8 - 11.73 - 4.36) + 2.5 * (std::log(T) - 1);
    const double K = std::exp(lnK) * constants::oneAtmosphere / p;
    std::vector<double> Y{1, 0, 0};
    equilibrium.atTemperatureAndPressure(T, p, Y);
    const auto X = moleFractions(mechanism, Y);
    const double a = std::sqrt(K / (1 + K));
    EXPECT_NEAR(X[2] / (a / (1 + a)), 1, 1e-11) << T;
    EXPECT_NEAR(X[1] / X[2], 1, 1e-11) << T;
  }
}

// Exactly as much oxygen as hydrogen needs: no element is free, everything but water comes from dissociation alone, and
// what it holds of H and O is as 2 to 1, however little it is.
TEST(Equilibrium, OfStoichiometricWaterAtLowTemperature) {
  const auto& mechanism = hydrogen();
  Equilibrium equilibrium(mechanism);
  const std::size_t H = mechanism.elementIndex("H"), O = mechanism.elementIndex("O");
  for (const double T : {200.0, 300.0, 500.0}) {
    auto Y = massFractions(mechanism, "H2: 2, O2: 1");
    equilibrium.atTemperatureAndPressure(T, constants::oneAtmosphere, Y);
    const auto X = moleFractions(mechanism, Y);
    EXPECT_NEAR(X[mechanism.speciesIndex("H2O")], 1, 1e-14);
    double excess = 0;
    for (std::size_t k = 0; k < X.size(); ++k) excess += (mechanism.atoms(k, H) - 2 * mechanism.atoms(k, O)) * X[k];
    const double hydrogenLeft = X[mechanism.speciesIndex("H2")];
    EXPECT_GT(hydrogenLeft, 0);
    EXPECT_NEAR(excess / hydrogenLeft, 0, 1e-11) << T;
  }
}

TEST(Equilibrium, KeepsTracesOfAnElement) {
  const auto& mechanism = hydrogen();
  Equilibrium equilibrium(mechanism);
  for (const double trace : {1e-20, 1e-100, 1e-200}) {
    auto Y = massFractions(mechanism, "O2: 1, N2: 3.76");
    Y[mechanism.speciesIndex("H2")] = trace;
    const double before = content(mechanism, mechanism.elementIndex("H"), Y);
    equilibrium.atTemperatureAndPressure(1500, constants::oneAtmosphere, Y);
    EXPECT_NEAR(content(mechanism, mechanism.elementIndex("H"), Y) / before, 1, 1e-12);
  }
}

TEST(Equilibrium, LeavesInertGasAlone) {
  const auto& mechanism = hydrogen();
  Equilibrium equilibrium(mechanism);
  auto Y = massFractions(mechanism, "AR: 1, N2: 1");
  const auto before = Y;
  equilibrium.atTemperatureAndPressure(3000, 1e5, Y);
  for (std::size_t k = 0; k < Y.size(); ++k) EXPECT_NEAR(Y[k], before[k], 1e-15);
}

// A pyrolysis mechanism without O2 and CO2: neither Si(OH)4 nor CO can give off anything when they are alone.
TEST(Equilibrium, LeavesOutWhatTheElementsForbid) {
  const auto mechanism = shipped("silica_teos_29");
  Equilibrium equilibrium(mechanism);
  for (const double T : {200.0, 1000.0, 4000.0}) {
    auto Y = massFractions(mechanism, "H4O4SI: 1, CO: 1");
    const auto before = Y;
    equilibrium.atTemperatureAndPressure(T, 1e5, Y);
    for (std::size_t k = 0; k < Y.size(); ++k) EXPECT_NEAR(Y[k], before[k], 1e-15) << mechanism.speciesName(k);
  }
}

TEST(Equilibrium, SaysWhatHasNone) {
  const auto& mechanism = hydrogen();
  Equilibrium equilibrium(mechanism);
  const auto air = massFractions(mechanism, "O2: 1, N2: 3.76");
  const auto message = [&](auto&& work) -> std::string {
    auto Y = air;
    try {
      work(Y);
    } catch (const NumericsError& error) {
      return error.what();
    }
    return "no error";
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(message([&](auto& Y) { equilibrium.atEnthalpyAndPressure(1e9, 1e5, Y); }),
              AllOf(HasSubstr("no temperature between 100 and 6000 K"), HasSubstr("1e+09"), HasSubstr("O2: ")));
  EXPECT_THAT(message([&](auto& Y) { equilibrium.atEntropyAndPressure(0, 1e5, Y); }), HasSubstr("entropy"));
  EXPECT_THAT(message([&](auto& Y) { equilibrium.atEnthalpyAndPressure(NAN, 1e5, Y); }), HasSubstr("nan"));
  EXPECT_THAT(message([&](auto& Y) { equilibrium.atTemperatureAndPressure(NAN, 1e5, Y); }), HasSubstr("nan"));
  EXPECT_THAT(message([&](auto& Y) { equilibrium.atTemperatureAndPressure(1000, -1, Y); }), HasSubstr("-1 Pa"));
  EXPECT_THAT(message([&](auto& Y) {
                std::fill(Y.begin(), Y.end(), 0.0);
                equilibrium.atTemperatureAndPressure(1000, 1e5, Y);
              }),
              HasSubstr("no gas"));
}

}  // namespace
