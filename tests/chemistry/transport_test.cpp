#include "chemistry/transport.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "chemistry/pure_gas.hpp"
#include "core/errors.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/chemistry/table.hpp"

namespace {

using namespace lampblack;
using lampblack::testing::ethylene;
using lampblack::testing::hydrogen;
using lampblack::testing::measured;
using lampblack::testing::Table;

struct Deviation {
  double viscosity = 0, conductivity = 0, diffusion = 0, pureViscosity = 0, binary = 0;
  double nonpolarViscosity = 0, nonpolarBinary = 0;
};

// Largest relative differences from Cantera's tables (Monchick-Mason integrals) over eight random states.
Deviation fromCantera(CollisionIntegrals integrals) {
  const auto& mechanism = hydrogen();
  Transport transport(mechanism, integrals);
  const Table states("transport_h2o2_states.csv"), mixture("transport_h2o2_mixture.csv"),
      species("transport_h2o2_species.csv"), binary("transport_h2o2_binary.csv");
  const std::size_t n = mechanism.numSpecies();
  std::vector<double> D(n);
  Deviation worst;
  const auto raise = [](double& value, double a, double b) { value = std::max(value, std::abs(a / b - 1)); };
  for (std::size_t s = 0; s < states.size(); ++s) {
    const double T = states.number(s, "T"), p = states.number(s, "p");
    const auto properties = transport.mixture(T, p, states.moleFractions(s, mechanism), D);
    raise(worst.viscosity, properties.viscosity, mixture.number(s, "mu"));
    raise(worst.conductivity, properties.conductivity, mixture.number(s, "lambda"));
    for (std::size_t k = 0; k < n; ++k) {
      raise(worst.diffusion, D[k], species.number(s * n + k, "D"));
      raise(worst.pureViscosity, transport.speciesViscosity(T, k), species.number(s * n + k, "mu"));
      if (mechanism.speciesName(k) != "H2O")
        raise(worst.nonpolarViscosity, transport.speciesViscosity(T, k), species.number(s * n + k, "mu"));
    }
  }
  for (std::size_t row = 0; row < binary.size(); ++row) {
    const auto s = static_cast<std::size_t>(binary.number(row, "state"));
    const auto j = mechanism.speciesIndex(binary.text(row, "i")), k = mechanism.speciesIndex(binary.text(row, "j"));
    const double D_jk = transport.binaryDiffusion(states.number(s, "T"), states.number(s, "p"), j, k);
    raise(worst.binary, D_jk, binary.number(row, "D"));
    if (binary.text(row, "i") != "H2O" || binary.text(row, "j") != "H2O")
      raise(worst.nonpolarBinary, D_jk, binary.number(row, "D"));
  }
  return worst;
}

void recordDeviation(const Deviation& worst) {
  measured("mixture viscosity", worst.viscosity);
  measured("mixture conductivity", worst.conductivity);
  measured("mixture diffusion", worst.diffusion);
  measured("pure viscosity", worst.pureViscosity);
  measured("pure viscosity without H2O", worst.nonpolarViscosity);
  measured("binary diffusion", worst.binary);
  measured("binary diffusion without H2O-H2O", worst.nonpolarBinary);
}

// Cantera's polynomials and Neufeld's integrals are good to 0.1 % each, Brokaw's dipole term to a few percent.
TEST(Transport, DefaultIntegralsAgreeWithCantera) {
  const auto worst = fromCantera(CollisionIntegrals::NeufeldBrokaw);
  recordDeviation(worst);
  EXPECT_LT(worst.viscosity, 0.013);
  EXPECT_LT(worst.conductivity, 0.010);
  EXPECT_LT(worst.diffusion, 0.002);
  EXPECT_LT(worst.nonpolarViscosity, 0.005);
  EXPECT_LT(worst.nonpolarBinary, 0.005);
  EXPECT_LT(worst.pureViscosity, 0.05);  // H2O
  EXPECT_LT(worst.binary, 0.03);         // H2O-H2O
}

TEST(Transport, ThesisFitsAgreeWithCantera) {
  const auto worst = fromCantera(CollisionIntegrals::ThesisFits);
  recordDeviation(worst);
  EXPECT_LT(worst.viscosity, 0.03);
  EXPECT_LT(worst.conductivity, 0.03);
  EXPECT_LT(worst.diffusion, 0.01);
  EXPECT_LT(worst.nonpolarViscosity, 0.03);
  EXPECT_LT(worst.binary, 0.03);
}

TEST(Transport, PolynomialsFollowKineticTheory) {
  for (const auto* mechanism : {&hydrogen(), &ethylene()}) {
    const double error = Transport(*mechanism).largestFitError();
    measured(std::to_string(mechanism->numSpecies()) + " species", error);
    EXPECT_LT(error, 1e-3);
  }
}

// A gas alone has its own viscosity and conductivity, and every other gas diffuses into it with the binary coefficient.
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

TEST(Transport, SaysWhenItCannotAnswer) {
  Transport transport(hydrogen());
  std::vector<double> X(hydrogen().numSpecies(), 0.1), D(X.size());
  EXPECT_THROW(transport.mixture(100, 1e5, X, D), NumericsError);
  EXPECT_THROW(transport.mixture(std::nan(""), 1e5, X, D), NumericsError);
  const auto bare =
      lampblack::testing::readText("species: [N2]", "\n- {name: N2, composition: {N: 2}, thermo: *t}", "[]");
  try {
    Transport none(bare);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("'N2' has no transport data"));
  }
}

}  // namespace
