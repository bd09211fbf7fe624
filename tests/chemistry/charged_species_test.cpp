// Ions and electrons: the electron is an element, of which a cation lacks one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "chemistry/kinetics/kinetics.hpp"
#include "chemistry/transport/transport.hpp"
#include "core/errors.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::readText;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kIons = R"(
- {name: NO, composition: {N: 1, O: 1}, thermo: *t, transport: &x {model: gas, geometry: linear, well-depth: 97.5, diameter: 3.6}}
- {name: NO+, composition: {N: 1, O: 1, E: -1}, thermo: *t, transport: *x}
- {name: O2-, composition: {O: 2, E: 1}, thermo: *t, transport: *x}
- {name: O2, composition: {O: 2}, thermo: *t, transport: *x}
- {name: E, composition: {E: 1}, thermo: *u, transport: {model: gas, geometry: atom, well-depth: 850, diameter: 425}})";

Mechanism ions(const std::string& reactions) {
  return readText("species: [NO, NO+, O2-, O2, E]", kIons, reactions);
}

// CODATA 2018: 5.485 799 090 65e-4 g/mol.
TEST(ChargedSpecies, LackOrHaveTheMassOfElectrons) {
  const auto mechanism = ions("[]");
  const auto W = mechanism.molecularWeights();
  const double electron = 5.48579909065e-7;
  EXPECT_NEAR(W[mechanism.speciesIndex("E")], electron, 1e-20);
  EXPECT_NEAR(W[mechanism.speciesIndex("NO")] - W[mechanism.speciesIndex("NO+")], electron, 1e-16);
  EXPECT_NEAR(W[mechanism.speciesIndex("O2-")] - W[mechanism.speciesIndex("O2")], electron, 1e-16);
}

TEST(ChargedSpecies, ReactionsConserveCharge) {
  try {
    ions("\n- {equation: NO+ + O2 <=> NO + O2, rate-constant: [1, 0, 0]}");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(":14:"), HasSubstr("does not balance"), HasSubstr("atoms of E")));
  }
  const auto mechanism = ions(R"(
- {equation: NO+ + E <=> NO, rate-constant: [1e17, -0.5, 0]}
- {equation: NO+ + O2- <=> NO + O2, rate-constant: [1e18, 0, 0]}
- {equation: O2 + E + M <=> O2- + M, rate-constant: [1e16, 0, 100]})");
  Kinetics kinetics(mechanism);
  const std::size_t n = mechanism.numSpecies(), E = mechanism.elementIndex("E");
  std::vector<double> c{1, 1e-6, 2e-6, 3, 5e-7}, wdot(n), J(n * n), byT(n);
  kinetics.netProductionRatesAndJacobian(1500, c, wdot, J, byT);
  // Of the rates and of all their derivatives.
  for (std::size_t j = 0; j <= n + 1; ++j) {
    double charge = 0, gross = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const double rate = j < n ? J[j * n + k] : j == n ? byT[k] : wdot[k];
      charge += mechanism.atoms(k, E) * rate;
      gross += std::abs(mechanism.atoms(k, E) * rate);
    }
    EXPECT_GT(gross, 0);
    EXPECT_NEAR(charge, 0, 1e-14 * gross);
  }
}

// The plain model of neutral gases: an ion is its molecule with a little less mass.
TEST(ChargedSpecies, AreTransportedAsNeutralOnes) {
  const auto mechanism = ions("[]");
  const Transport transport(mechanism);
  const auto D = [&](const char* a, const char* b) {
    return transport.binaryDiffusion(1000, 1e5, mechanism.speciesIndex(a), mechanism.speciesIndex(b));
  };
  EXPECT_NEAR(D("NO+", "O2") / D("NO", "O2"), 1, 2e-5);  // half of m_e/m
  EXPECT_GT(D("E", "O2"), 0);
}

}  // namespace
