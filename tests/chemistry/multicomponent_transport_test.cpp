#include "chemistry/transport/multicomponent_transport.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/constants.hpp"
#include "numerics/dense_blocks.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/mechanism_text.hpp"
#include "tests/chemistry/multicomponent_support.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::ethylene;
using lampblack::test::hydrogen;
using lampblack::test::measured;
using lampblack::test::Pairs;
using lampblack::test::raise;
using lampblack::test::Table;

struct MulticomponentTables {
  const char* tables;
  const char* mechanism;
};

class MulticomponentReference : public ::testing::TestWithParam<MulticomponentTables> {
 protected:
  Table table(const std::string& kind) const {
    return Table(std::string("transport_") + GetParam().tables + "_" + kind + ".csv");
  }
};

// Cantera adds the conduction of the atoms' electronic heat capacity, rho D/mu (cp/R - 5/2) with rho D/mu of about 4/3
// beside 15/4, which atoms do not have here: by at most so much of the mixture's it is larger.
double electronicConduction(const Mechanism& mechanism, double T, const std::vector<double>& X) {
  double share = 0;
  for (std::size_t k = 0; k < X.size(); ++k)
    if (mechanism.species(k).transport->shape == MoleculeShape::Atom)
      share += X[k] * 4.0 / 3.0 / 3.75 * std::max(cpOverR(mechanism.species(k), T) - 2.5, 0.0);
  return share;
}

// Cantera solves the same equations with polynomials in ln T for the properties of pairs. Thermal diffusion
// coefficients, which change sign, are compared relative to themselves or to a hundredth of the mixture's largest.
TEST_P(MulticomponentReference, AgreesWithCantera) {
  const auto mechanism =
      Mechanism::fromFile(lampblack::test::sourcePath(std::string("cases/mechanisms/") + GetParam().mechanism));
  MulticomponentTransport transport(mechanism);
  const auto states = table("states"), mixture = table("mixture"), species = table("species");
  const std::size_t n = mechanism.numSpecies();
  std::vector<double> DT(n);
  double viscosity = 0, conductivity = 0, thermal = 0, sums = 0;
  for (std::size_t s = 0; s < states.size(); ++s) {
    const auto X = states.moleFractions(s, mechanism);
    const double T = states.number(s, "T");
    const auto result = transport.mixture(T, states.number(s, "p"), X, DT);
    raise(viscosity, result.viscosity / mixture.number(s, "mu_mixavg") - 1);
    const double deviation = result.conductivity / mixture.number(s, "lambda_multi") - 1;
    raise(conductivity, deviation);
    EXPECT_LT(deviation, 0.001);
    EXPECT_GT(deviation, -0.001 - electronicConduction(mechanism, T, X)) << T;
    double largest = 0;
    for (std::size_t k = 0; k < n; ++k) largest = std::max(largest, std::abs(species.number(s * n + k, "DT_multi")));
    for (std::size_t k = 0; k < n; ++k) {
      const double expected = species.number(s * n + k, "DT_multi");
      raise(thermal, (DT[k] - expected) / std::max(std::abs(expected), 0.01 * largest));
    }
    raise(sums, std::accumulate(DT.begin(), DT.end(), 0.0) / largest);
  }
  measured("viscosity", viscosity);
  measured("conductivity", conductivity);
  measured("thermal diffusion", thermal);
  measured("sum of thermal diffusion", sums);
  EXPECT_LT(viscosity, 0.001);
  EXPECT_LT(thermal, 0.01);
  EXPECT_LT(sums, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Cantera, MulticomponentReference,
                         ::testing::Values(MulticomponentTables{"h2o2", "hydrogen_h2o2_10.yaml"},
                                           MulticomponentTables{"gri30", "methane_gri30_53.yaml"}),
                         [](const auto& reference) { return std::string(reference.param.tables); });

// Two gases, eight others absent: D_12 = D_21 is the binary coefficient.
TEST(MulticomponentTransport, TwoGasesHaveTheBinaryCoefficient) {
  const auto& mechanism = hydrogen();
  MulticomponentTransport transport(mechanism);
  const std::size_t n = mechanism.numSpecies(), H2 = mechanism.speciesIndex("H2"), N2 = mechanism.speciesIndex("N2");
  std::vector<double> D(n * n);
  transport.diffusion(600, 3e5, parseComposition(mechanism, "H2: 0.2, N2: 0.8"), D);
  const double binary = 1 / (3e5 * Pairs(mechanism, 600).conductance(H2, N2));
  EXPECT_NEAR(D[H2 * n + N2] / binary, 1, 1e-12);
  EXPECT_NEAR(D[N2 * n + H2] / binary, 1, 1e-12);
  EXPECT_EQ(D[H2 * n + H2], 0);
}

// The fluxes of the coefficients satisfy the Stefan-Maxwell equations, grad X_i = sum_j X_i X_j/D_ij (V_j - V_i), with
// the binary coefficients, and carry no mass on the whole.
TEST(MulticomponentTransport, FluxesSolveTheStefanMaxwellEquations) {
  const auto& mechanism = ethylene();
  MulticomponentTransport transport(mechanism);
  const std::size_t n = mechanism.numSpecies();
  const double T = 1400, p = 1e5;
  const Pairs pairs(mechanism, T);
  const auto W = mechanism.molecularWeights();
  std::vector<double> X(n), gradient(n), D(n * n), velocity(n);
  double total = 0, mean = 0, slope = 0;
  for (std::size_t k = 0; k < n; ++k) total += X[k] = 1.0 + std::sin(static_cast<double>(3 * k));
  for (std::size_t k = 0; k < n; ++k) {
    X[k] /= total;
    mean += X[k] * W[k];
    slope += gradient[k] = std::cos(static_cast<double>(5 * k));
  }
  for (double& g : gradient) g -= slope / static_cast<double>(n);
  transport.diffusion(T, p, X, D);
  const double density = p * mean / (constants::gasConstant * T);
  double net = 0, size = 0;
  for (std::size_t k = 0; k < n; ++k) {
    double flux = 0;
    for (std::size_t j = 0; j < n; ++j) flux += density * W[k] / (mean * mean) * W[j] * D[k * n + j] * gradient[j];
    velocity[k] = flux / (density * X[k] * W[k] / mean);
    net += flux;
    size += std::abs(flux);
  }
  EXPECT_LT(std::abs(net), 1e-12 * size);
  double worst = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += X[i] * X[j] * p * pairs.conductance(i, j) * (velocity[j] - velocity[i]);
    raise(worst, sum - gradient[i]);  // gradients are of order one
  }
  measured("Stefan-Maxwell", worst);
  EXPECT_LT(worst, 1e-9);
}

// The fluxes of both forms are the same, and that of a trace in proportion to what there is of it, whatever the
// gradients of the others: to the rounding of the flux itself. As a difference of the D_kj it would have errors of
// 1e-16 of the gradients of all others, here a tenth of it.
TEST(MulticomponentTransport, TheFluxOfATraceIsExactToRoundingOfItself) {
  const auto& mechanism = ethylene();
  MulticomponentTransport transport(mechanism);
  const std::size_t n = mechanism.numSpecies(), trace = mechanism.speciesIndex("A2");
  const double T = 1400, p = 1e5;
  const auto W = mechanism.molecularWeights();
  std::vector<double> D(n * n), M(n * n);
  const auto fluxes = [&](double amount, bool byMatrix) {
    std::vector<double> X(n), gradient(n), flux(n, 0.0);
    double total = 0, slope = 0, mean = 0;
    for (std::size_t k = 0; k < n; ++k) total += X[k] = k == trace ? 0 : 1.0 + std::sin(static_cast<double>(3 * k));
    for (std::size_t k = 0; k < n; ++k) slope += gradient[k] = X[k] * std::cos(static_cast<double>(5 * k));
    for (std::size_t k = 0; k < n; ++k) gradient[k] -= X[k] * slope / total;
    for (double& x : X) x *= (1 - amount) / total;
    X[trace] = amount;
    gradient[trace] = -3 * amount;
    gradient[0] += 3 * amount;
    for (std::size_t k = 0; k < n; ++k) mean += X[k] * W[k];
    if (byMatrix)
      transport.fluxMatrix(T, p, X, M);
    else
      transport.diffusion(T, p, X, D);
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t j = 0; j < n; ++j)
        flux[k] += gradient[j] * W[k] / (constants::gasConstant * T) *
                   (byMatrix ? M[k * n + j] : p / mean * W[j] * D[k * n + j]);
    return flux;
  };
  const auto first = fluxes(0.01, true), second = fluxes(0.01, false);
  const double size = std::abs(*std::ranges::max_element(first, {}, [](double j) { return std::abs(j); }));
  for (std::size_t k = 0; k < n; ++k) EXPECT_NEAR(first[k], second[k], 1e-11 * size) << mechanism.speciesName(k);
  // What a billionth does to the others is below the tolerance.
  const double some = fluxes(1e-9, true)[trace] / 1e-9;
  EXPECT_NEAR(fluxes(1e-15, true)[trace] / 1e-15 / some, 1, 1e-7);
  EXPECT_GT(std::abs(fluxes(1e-15, false)[trace] / 1e-15 / some - 1), 1e-4);
}

// A monatomic gas alone conducts as 15/4 R/W mu in first approximation; absent species change nothing.
TEST(MulticomponentTransport, ArgonAloneConductsAsKineticTheorySays) {
  const auto& mechanism = hydrogen();
  MulticomponentTransport transport(mechanism);
  const std::size_t AR = mechanism.speciesIndex("AR");
  std::vector<double> DT(mechanism.numSpecies());
  const auto result = transport.mixture(500, 1e5, parseComposition(mechanism, "AR: 1"), DT);
  const double viscosity = PureGas(mechanism).viscosity(AR, 500);
  // The error of the polynomials of pairs.
  EXPECT_NEAR(result.conductivity / (3.75 * constants::gasConstant / mechanism.molecularWeights()[AR] * viscosity), 1,
              5e-4);
  for (std::size_t k = 0; k < DT.size(); ++k) EXPECT_NEAR(DT[k], 0, 1e-14 * viscosity) << mechanism.speciesName(k);
}

// Atoms of oxygen have electronic heat capacity, which no model takes for internal energy that collisions exchange.
TEST(MulticomponentTransport, AtomsConductByTranslationAlone) {
  const auto mechanism = lampblack::test::readText("species: [O]", R"(
- name: O
  composition: {O: 1}
  thermo: {model: constant-cp, cp0: 21.9e3, h0: 2.5e8, s0: 1.6e5}
  transport: {model: gas, geometry: atom, well-depth: 80, diameter: 2.75}
- {name: O2, composition: {O: 2}, thermo: *t})",
                                                   "[]");
  const PureGas gas(mechanism);
  Transport averaged(mechanism);
  MulticomponentTransport multicomponent(mechanism);
  std::vector<double> D(1), DT(1);
  const std::vector<double> X{1.0};
  const double W = mechanism.molecularWeights()[0];
  for (const double T : {300.0, 2000.0}) {
    // 15/4 R mu/W (Hirschfelder, Curtiss, Bird 1954, eq. 8.2-33).
    const double expected = 3.75 * constants::gasConstant / W * gas.viscosity(0, T);
    EXPECT_NEAR(gas.conductivity(0, T, 2.634), expected, 1e-12 * expected);
    EXPECT_NEAR(averaged.mixture(T, 1e5, X, D).conductivity, expected, 1e-3 * expected);         // its fits' error
    EXPECT_NEAR(multicomponent.mixture(T, 1e5, X, DT).conductivity, expected, 5e-4 * expected);  // the same
  }
}

// Of every pair the polynomials follow kinetic theory.
TEST(MulticomponentTransport, PairsFollowKineticTheory) {
  const auto& mechanism = ethylene();
  const PureGas gas(mechanism);
  const auto W = mechanism.molecularWeights();
  double conductance = 0, thermal = 0, exchange = 0, energy = 0;
  for (const double T : {200.0, 290.0, 430.0, 800.0, 1300.0, 2100.0, 4000.0}) {
    const Pairs pairs(mechanism, T);
    for (std::size_t i = 0; i < W.size(); ++i)
      for (std::size_t j = 0; j < W.size(); ++j) {
        const double c = 1 / gas.diffusionTimesPressure(i, j, T), m = W[i] + W[j];
        raise(exchange, pairs.at(pairs.of.exchange, i, j) / (gas.ratioA(i, j, T) * c / m) - 1);
        raise(energy, pairs.at(pairs.of.energy, i, j) / ((13.75 - 3 * gas.ratioB(i, j, T)) * c / (m * m)) - 1);
        if (i == j) {
          raise(conductance, pairs.of.own[i] / c - 1);
          EXPECT_EQ(pairs.conductance(i, i), 0);
          EXPECT_EQ(pairs.at(pairs.of.thermal, i, i), 0);
          continue;
        }
        raise(conductance, pairs.conductance(i, j) / c - 1);
        // 6/5 C* - 1, about 0.1, goes through zero in the cold.
        raise(thermal, (pairs.at(pairs.of.thermal, i, j) * m / c) - (1.2 * gas.ratioC(i, j, T) - 1));
      }
  }
  measured("conductance", conductance);
  measured("thermal", thermal);
  measured("exchange", exchange);
  measured("energy", energy);
  EXPECT_LT(conductance, 5e-4);
  EXPECT_LT(thermal, 5e-4);
  EXPECT_LT(exchange, 1e-3);
  EXPECT_LT(energy, 1e-3);
}

}  // namespace
