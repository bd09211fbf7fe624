#include "chemistry/transport/transport.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "chemistry/thermo/thermo.hpp"
#include "chemistry/transport/pure_gas.hpp"
#include "core/errors.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::ethylene;
using lampblack::test::hydrogen;
using lampblack::test::measured;
using lampblack::test::raise;
using lampblack::test::Table;

struct TransportTables {
  const char* tables;
  const char* mechanism;
};

struct Deviation {
  double viscosity = 0, conductivity = 0, diffusion = 0, molar = 0, mass = 0, thermal = 0, pureViscosity = 0;
};

class TransportReference : public ::testing::TestWithParam<TransportTables> {
 protected:
  Table table(const std::string& kind) const {
    return Table(std::string("transport_") + GetParam().tables + "_" + kind + ".csv");
  }
  // Largest relative differences over the eight states. Those of thermal diffusion coefficients, which change sign, are
  // relative to the coefficient or to a hundredth of the mixture's largest.
  Deviation fromCantera(CollisionIntegrals integrals) const {
    TransportOptions options;
    options.integrals = integrals;
    Transport transport(mechanism, options);
    const auto states = table("states"), mixture = table("mixture"), species = table("species");
    const std::size_t n = mechanism.numSpecies();
    std::vector<double> D(n), molar(n), mass(n), DT(n);
    Deviation worst;
    for (std::size_t s = 0; s < states.size(); ++s) {
      const double T = states.number(s, "T"), p = states.number(s, "p");
      const auto X = states.moleFractions(s, mechanism);
      const auto properties = transport.mixture(T, p, X, D);
      transport.molarDiffusion(T, p, X, molar);
      transport.massDiffusion(T, p, X, mass);
      transport.thermalDiffusion(T, p, X, DT);
      raise(worst.viscosity, properties.viscosity / mixture.number(s, "mu_mixavg") - 1);
      raise(worst.conductivity, properties.conductivity / mixture.number(s, "lambda_mixavg") - 1);
      double largest = 0;
      for (std::size_t k = 0; k < n; ++k)
        largest = std::max(largest, std::abs(species.number(s * n + k, "DT_mixavg_model")));
      for (std::size_t k = 0; k < n; ++k) {
        const std::size_t row = s * n + k;
        EXPECT_EQ(species.text(row, "species"), mechanism.speciesName(k));
        raise(worst.diffusion, D[k] / species.number(row, "D_mix_avg") - 1);
        raise(worst.molar, molar[k] / species.number(row, "D_mix_avg_mole") - 1);
        raise(worst.mass, mass[k] / species.number(row, "D_mix_avg_mass") - 1);
        raise(worst.pureViscosity, transport.speciesViscosity(T, k) / species.number(row, "mu_pure") - 1);
        const double thermal = species.number(row, "DT_mixavg_model");
        raise(worst.thermal, (DT[k] - thermal) / std::max(std::abs(thermal), 0.01 * largest));
      }
    }
    measured("mixture viscosity", worst.viscosity);
    measured("mixture conductivity", worst.conductivity);
    measured("mixture diffusion", worst.diffusion);
    measured("mixture diffusion, molar fluxes", worst.molar);
    measured("mixture diffusion, gradients of mass fractions", worst.mass);
    measured("thermal diffusion", worst.thermal);
    measured("pure viscosity", worst.pureViscosity);
    return worst;
  }

  Mechanism mechanism =
      Mechanism::fromFile(lampblack::test::sourcePath(std::string("cases/mechanisms/") + GetParam().mechanism));
};

// The same theory, equations and tables: what is left is Cantera's own fit of degree 4 in ln T.
TEST_P(TransportReference, DefaultIntegrals) {
  const auto worst = fromCantera(CollisionIntegrals::MonchickMason);
  EXPECT_LT(worst.viscosity, 0.001);
  EXPECT_LT(worst.conductivity, 0.005);
  EXPECT_LT(worst.diffusion, 0.001);
  EXPECT_LT(worst.molar, 0.001);
  EXPECT_LT(worst.mass, 0.001);
  EXPECT_LT(worst.thermal, 0.01);
  EXPECT_LT(worst.pureViscosity, 0.003);
}

TEST_P(TransportReference, WangFits) {
  const auto worst = fromCantera(CollisionIntegrals::WangFits);
  EXPECT_LT(worst.viscosity, 0.03);
  EXPECT_LT(worst.conductivity, 0.03);
  EXPECT_LT(worst.diffusion, 0.01);
  EXPECT_LT(worst.molar, 0.01);
  EXPECT_LT(worst.mass, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Cantera, TransportReference,
                         ::testing::Values(TransportTables{"h2o2", "hydrogen_h2o2_10.yaml"},
                                           TransportTables{"gri30", "methane_gri30_53.yaml"}),
                         [](const auto& reference) { return std::string(reference.param.tables); });

TEST(Transport, BinaryCoefficientsAgreeWithCantera) {
  const Transport transport(hydrogen());
  const Table states("transport_h2o2_states.csv"), binary("transport_h2o2_binary.csv");
  double worst = 0;
  for (std::size_t row = 0; row < binary.size(); ++row) {
    const auto s = static_cast<std::size_t>(binary.number(row, "state"));
    const auto j = hydrogen().speciesIndex(binary.text(row, "i")), k = hydrogen().speciesIndex(binary.text(row, "j"));
    raise(worst,
          transport.binaryDiffusion(states.number(s, "T"), states.number(s, "p"), j, k) / binary.number(row, "D") - 1);
  }
  measured("pairs", worst);
  EXPECT_LT(worst, 0.003);
}

// From two to 202 species, coronene among them.
TEST(Transport, PolynomialsFollowKineticTheory) {
  const auto coronene = Mechanism::fromFile(lampblack::test::sourcePath("cases/mechanisms/ethylene_km2_202.yaml"));
  for (const auto* mechanism : {&hydrogen(), &ethylene(), &coronene}) {
    const double error = Transport(*mechanism).largestFitError(PureGas(*mechanism));
    measured(std::to_string(mechanism->numSpecies()) + " species", error);
    EXPECT_LT(error, 1e-3);
  }
}

// A gas alone has its own viscosity and conductivity, and every other gas diffuses into it with the binary coefficient.
TEST(Transport, AGasOfOneSpeciesDoesNotDiffuse) {
  const Mechanism mechanism = test::readText(
      "species: [N2], transport: mixture-averaged",
      "\n- {name: N2, composition: {N: 2}, thermo: *t, transport: {model: gas, geometry: linear, diameter: 3.621, "
      "well-depth: 97.53}}",
      "[]");
  Transport transport(mechanism);
  const std::vector<double> X{1.0};
  std::vector<double> D{-1.0};
  EXPECT_NEAR(transport.mixture(300.0, 101325.0, X, D).viscosity / transport.speciesViscosity(300.0, 0), 1.0, 1e-12);
  EXPECT_EQ(D[0], 0.0);
  D[0] = -1.0;
  transport.molarDiffusion(300.0, 101325.0, X, D);
  EXPECT_EQ(D[0], 0.0);
  transport.massDiffusion(300.0, 101325.0, X, D);
  EXPECT_EQ(D[0], 0.0);
}

TEST(Transport, APureGasIsTheLimitOfAMixture) {
  const auto& mechanism = ethylene();
  Transport transport(mechanism);
  const std::size_t n = mechanism.numSpecies(), N2 = mechanism.speciesIndex("N2");
  std::vector<double> X(n, 0.0), D(n);
  X[N2] = 1;
  const auto mixture = transport.mixture(700, 2e5, X, D);
  EXPECT_NEAR(mixture.viscosity / transport.speciesViscosity(700, N2), 1, 1e-9);
  EXPECT_NEAR(mixture.conductivity / transport.speciesConductivity(700, N2), 1, 1e-9);
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_TRUE(std::isfinite(D[k]) && D[k] > 0);
    if (k == N2) continue;
    EXPECT_NEAR(D[k] / transport.binaryDiffusion(700, 2e5, k, N2), 1, 1e-9);
  }
}

// Two gases: (1 - Y_1)/(X_2/D_12), eq. 6-21; D falls as 1/p; viscosity does not depend on pressure.
TEST(Transport, TwoGasesFollowTheFormula) {
  const auto& mechanism = hydrogen();
  Transport transport(mechanism);
  const auto X = parseComposition(mechanism, "H2: 0.3, N2: 0.7");
  const std::size_t H2 = mechanism.speciesIndex("H2"), N2 = mechanism.speciesIndex("N2");
  std::vector<double> D(X.size()), half(X.size());
  const auto mixture = transport.mixture(500, 1e5, X, D);
  const auto W = mechanism.molecularWeights();
  const double Y = 0.3 * W[H2] / (0.3 * W[H2] + 0.7 * W[N2]);
  EXPECT_NEAR(D[H2] / ((1 - Y) / (0.7 / transport.binaryDiffusion(500, 1e5, H2, N2))), 1, 1e-9);
  EXPECT_EQ(transport.binaryDiffusion(500, 1e5, H2, N2), transport.binaryDiffusion(500, 1e5, N2, H2));
  EXPECT_NEAR(transport.mixture(500, 2e5, X, half).viscosity, mixture.viscosity, 1e-14 * mixture.viscosity);
  EXPECT_NEAR(half[N2] / D[N2], 0.5, 1e-13);
}

// Viscosity of nitrogen and argon, conductivity of nitrogen at 300 K (Lemmon, Jacobsen, Int. J. Thermophys. 25 (2004)
// 21-69: 17.89 and 22.72 uPa s, 25.97 mW/m/K at 0.1 MPa); the potentials are fits of some percent.
TEST(Transport, RoomTemperatureValuesAreThoseMeasured) {
  Transport transport(hydrogen());
  const auto N2 = hydrogen().speciesIndex("N2"), AR = hydrogen().speciesIndex("AR");
  EXPECT_NEAR(transport.speciesViscosity(300, N2) / 17.89e-6, 1, 0.02);
  EXPECT_NEAR(transport.speciesViscosity(300, AR) / 22.72e-6, 1, 0.02);
  EXPECT_NEAR(transport.speciesConductivity(300, N2) / 25.97e-3, 1, 0.03);
}

// J_k = -c D_k grad X_k of two gases has one coefficient, the binary one, in the molar frame and, as D_12 again, for
// mass fluxes from gradients of mass fractions.
TEST(Transport, TwoGasesHaveTheBinaryCoefficientInTheirOwnFrames) {
  const auto& mechanism = hydrogen();
  Transport transport(mechanism);
  const auto X = parseComposition(mechanism, "H2: 0.3, N2: 0.7");
  const std::size_t H2 = mechanism.speciesIndex("H2"), N2 = mechanism.speciesIndex("N2");
  std::vector<double> molar(X.size()), mass(X.size());
  transport.molarDiffusion(500, 1e5, X, molar);
  transport.massDiffusion(500, 1e5, X, mass);
  const double binary = transport.binaryDiffusion(500, 1e5, H2, N2);
  for (const std::size_t k : {H2, N2}) {
    EXPECT_NEAR(molar[k] / binary, 1, 1e-9);
    EXPECT_NEAR(mass[k] / binary, 1, 1e-9);
  }
}

// Light gases wander to the hot side, and no mass goes anywhere on the whole.
TEST(Transport, ThermalDiffusionSortsByWeight) {
  const auto& mechanism = ethylene();
  Transport transport(mechanism);
  const auto X = parseComposition(mechanism, "H2: 0.1, N2: 0.7, CO2: 0.2");
  std::vector<double> DT(X.size());
  transport.thermalDiffusion(1000, 1e5, X, DT);
  EXPECT_LT(DT[mechanism.speciesIndex("H2")], 0);
  EXPECT_GT(DT[mechanism.speciesIndex("CO2")], 0);
  double sum = 0, magnitude = 0;
  for (const double d : DT) {
    sum += d;
    magnitude += std::abs(d);
  }
  EXPECT_LT(std::abs(sum), 1e-14 * magnitude);
  // A gas alone does not demix; what is left are the traces of 1e-12.
  std::fill(DT.begin(), DT.end(), 1.0);
  transport.thermalDiffusion(1000, 1e5, parseComposition(mechanism, "N2: 1"), DT);
  for (const double d : DT) EXPECT_LT(std::abs(d), 1e-9 * magnitude);
}

// lambda/(rho cp) for all, and divided by each species' Lewis number; viscosity and conductivity are the mixture's.
TEST(Transport, LewisNumbersGiveTheDiffusivityOfHeat) {
  const auto& mechanism = hydrogen();
  const std::size_t n = mechanism.numSpecies();
  const auto X = parseComposition(mechanism, "H2: 0.3, O2: 0.1, N2: 0.6");
  TransportOptions options;
  options.diffusion = DiffusionModel::UnityLewis;
  Transport unity(mechanism, options), averaged(mechanism);
  options.diffusion = DiffusionModel::ConstantLewis;
  for (std::size_t k = 0; k < n; ++k) options.lewisNumbers.push_back(0.3 + 0.2 * static_cast<double>(k));
  Transport constant(mechanism, options);
  std::vector<double> D(n), byLewis(n), of(n), Y(n);
  const auto mixture = unity.mixture(900, 2e5, X, D);
  constant.mixture(900, 2e5, X, byLewis);
  const auto reference = averaged.mixture(900, 2e5, X, of);
  EXPECT_EQ(mixture.viscosity, reference.viscosity);
  EXPECT_EQ(mixture.conductivity, reference.conductivity);
  const Thermo thermo(mechanism);
  thermo.moleToMass(X, Y);
  const double heat = mixture.conductivity / (thermo.density(900, 2e5, Y) * thermo.cpMass(900, Y));
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_NEAR(D[k] / heat, 1, 1e-9);
    EXPECT_NEAR(byLewis[k] * options.lewisNumbers[k] / heat, 1, 1e-9);
  }
  options.lewisNumbers[3] = 0;
  EXPECT_THROW(Transport(mechanism, options), InputError);
  options.lewisNumbers.pop_back();
  EXPECT_THROW(Transport(mechanism, options), InputError);
}

// Air: 1.8462e-5 Pa s at 300 K with Sutherland's constants of Le Quere and others (2005).
TEST(Transport, SutherlandsLawStandsForTheWholeMixture) {
  const auto& mechanism = hydrogen();
  const auto X = parseComposition(mechanism, "O2: 0.21, N2: 0.79");
  TransportOptions options;
  options.diffusion = DiffusionModel::ConstantLewis;
  options.lewisNumbers.assign(mechanism.numSpecies(), 1.25);
  options.sutherland = SutherlandLaw{1.68e-5, 273, 110.5, 0.71};
  Transport transport(mechanism, options);
  std::vector<double> D(X.size()), Y(X.size());
  const auto mixture = transport.mixture(300, 1e5, X, D);
  EXPECT_NEAR(mixture.viscosity, 1.68e-5 * std::pow(300.0 / 273, 1.5) * 383.5 / 410.5, 1e-18);
  const Thermo thermo(mechanism);
  thermo.moleToMass(X, Y);
  const double cp = thermo.cpMass(300, Y);
  EXPECT_NEAR(mixture.conductivity / (mixture.viscosity * cp / 0.71), 1, 1e-9);
  for (const double d : D) EXPECT_NEAR(d * 1.25 * thermo.density(300, 1e5, Y) * cp / mixture.conductivity, 1, 1e-9);
  options.sutherland->constant = 0;
  EXPECT_THROW(Transport(mechanism, options), InputError);
  options.sutherland->constant = 110.5;
  options.diffusion = DiffusionModel::MixtureAveraged;
  EXPECT_THROW(Transport(mechanism, options), InputError);
}

// From 200 to 4000 K, from a millionth to a hundred bar, with gases alone: finite and positive everywhere.
TEST(Transport, IsFiniteAtTheEdges) {
  const auto& mechanism = ethylene();
  Transport transport(mechanism);
  const std::size_t n = mechanism.numSpecies();
  std::vector<double> D(n), DT(n);
  for (const double T : {Transport::minTemperature, 1000.0, Transport::maxTemperature})
    for (const double p : {0.1, 1e5, 1e7})
      for (std::size_t k = 0; k < n; ++k) {
        std::vector<double> X(n, 0.0);
        X[k] = 1;
        const auto mixture = transport.mixture(T, p, X, D);
        EXPECT_TRUE(std::isfinite(mixture.viscosity) && mixture.viscosity > 0);
        EXPECT_TRUE(std::isfinite(mixture.conductivity) && mixture.conductivity > 0);
        transport.thermalDiffusion(T, p, X, DT);
        for (std::size_t j = 0; j < n; ++j) {
          EXPECT_TRUE(std::isfinite(D[j]) && D[j] > 0);
          EXPECT_TRUE(std::isfinite(DT[j]));
        }
      }
}

TEST(Transport, SaysWhenItCannotAnswer) {
  Transport transport(hydrogen());
  std::vector<double> X(hydrogen().numSpecies(), 0.1), D(X.size());
  EXPECT_THROW(transport.mixture(100, 1e5, X, D), NumericsError);
  EXPECT_THROW(transport.mixture(4201, 1e5, X, D), NumericsError);
  EXPECT_THROW(transport.mixture(std::nan(""), 1e5, X, D), NumericsError);
  const auto bare = lampblack::test::readText("species: [N2]", "\n- {name: N2, composition: {N: 2}, thermo: *t}", "[]");
  try {
    Transport none(bare);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("'N2' has no transport data"));
  }
}

}  // namespace
