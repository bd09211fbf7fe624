// Multicomponent fluxes and conductivities by iteration, and at the edges of what there is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "chemistry/transport/multicomponent_transport.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
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

// States of a flame, and such as iterations and divisions by mole fractions would trip over.
std::vector<std::vector<double>> difficultStates(const Mechanism& mechanism) {
  const std::size_t n = mechanism.numSpecies();
  std::vector<std::vector<double>> states;
  for (const char* composition : {"N2: 1", "H2: 1", "H2: 0.5, N2: 0.5", "C2H4: 1, O2: 1e-15, H: 1e-20",
                                  "C2H4: 0.3, O2: 0.2, N2: 0.5, H: 1e-8", "A2: 0.5, H2: 0.5, OH: 1e-300"})
    states.push_back(parseComposition(mechanism, composition));
  std::vector<double> all(n);
  for (std::size_t k = 0; k < n; ++k) all[k] = std::pow(10.0, -8.0 * std::abs(std::sin(static_cast<double>(3 * k))));
  const double total = std::accumulate(all.begin(), all.end(), 0.0);
  for (double& x : all) x /= total;
  states.push_back(all);
  return states;
}

// Fluxes by iteration are those of the factorised matrix, each species' on the scale of the terms of its sum, and solve
// the Stefan-Maxwell equations, each on the scale of its terms.
TEST(MulticomponentTransport, FluxesByIterationAreThoseOfTheMatrix) {
  for (const Mechanism* mechanism : {&ethylene(), &hydrogen()}) {
    const std::size_t n = mechanism->numSpecies();
    const auto W = mechanism->molecularWeights();
    MulticomponentTransport transport(*mechanism);
    std::vector<double> M(n * n), j(n), expected(n), gradient(n), scale(n);
    double ofEquations = 0, ofOwn = 0;
    const auto states = mechanism == &ethylene()
                            ? difficultStates(*mechanism)
                            : std::vector{parseComposition(*mechanism, "H2: 0.9, O2: 0.1"), std::vector(n, 1.0 / 10)};
    for (const auto& X : states)
      for (const double T : {300.0, 1500.0}) {
        double sum = 0;
        for (std::size_t k = 0; k < n; ++k) sum += gradient[k] = (X[k] + 1e-6) * std::cos(static_cast<double>(5 * k));
        for (double& g : gradient) g -= sum / static_cast<double>(n);
        transport.fluxMatrix(T, 1e5, X, M);
        transport.diffusionFluxes(T, 1e5, X, gradient, j);
        double net = 0, gross = 0;
        for (std::size_t k = 0; k < n; ++k) {
          expected[k] = scale[k] = 0;
          for (std::size_t l = 0; l < n; ++l) {
            const double part = W[k] / (constants::gasConstant * T) * M[k * n + l] * gradient[l];
            expected[k] += part;
            scale[k] += std::abs(part);
          }
          net += j[k];
          gross += std::abs(j[k]);
        }
        const Pairs pairs(*mechanism, T);
        for (std::size_t k = 0; k < n; ++k) {
          double rest = -gradient[k], size = std::abs(gradient[k]);
          for (std::size_t l = 0; l < n; ++l) {
            const double c = constants::gasConstant * T * pairs.conductance(k, l);
            rest += c * (X[k] * j[l] / W[l] - X[l] * j[k] / W[k]);
            size += c * (X[k] * std::abs(j[l]) / W[l] + X[l] * std::abs(j[k]) / W[k]);
          }
          raise(ofEquations, rest / size);
        }
        EXPECT_LT(std::abs(net), 1e-14 * gross);
        for (std::size_t k = 0; k < n; ++k) raise(ofOwn, (j[k] - expected[k]) / scale[k]);
      }
    measured("fluxes by iteration in the equations", ofEquations);
    measured("fluxes by iteration, of their own scale", ofOwn);
    EXPECT_LT(ofEquations, 1e-8);
    EXPECT_LT(ofOwn, 1e-8);
  }
}

// Conductivity and thermal diffusion against elimination of the whole system of Kee et al. eqs 12.117 to 12.127 in its
// own, unsymmetric form.
TEST(MulticomponentTransport, HeatByIterationIsThatOfElimination) {
  const auto& mechanism = ethylene();
  const std::size_t n = mechanism.numSpecies(), rows = 3 * n;
  const auto W = mechanism.molecularWeights();
  const PureGas gas(mechanism);
  MulticomponentTransport transport(mechanism);
  const double pi = constants::pi;
  double conductivity = 0, thermal = 0;
  for (const auto& fractions : difficultStates(mechanism))
    for (const double T : {300.0, 1500.0}) {
      const Pairs pairs(mechanism, T);
      std::vector<double> X = fractions, L(rows * rows, 0.0), a(rows, 0.0), DT(n);
      for (double& x : X) x = std::max(x, 1e-12);  // the elimination needs some of everything
      const double raised = std::accumulate(X.begin(), X.end(), 0.0);
      for (double& x : X) x /= raised;
      std::vector<double> internal(n), rotation(n);
      for (std::size_t i = 0; i < n; ++i) {
        internal[i] = gas.rotationalHeatCapacity(i) > 0 ? cpOverR(mechanism.species(i), T) - 2.5 : 0.0;
        rotation[i] = gas.rotationalHeatCapacity(i) / gas.rotationalRelaxation(i, T, 1.0);
      }
      const auto at = [&](std::size_t row, std::size_t column) -> double& { return L[column * rows + row]; };
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
          const double m = W[i] + W[j], c = i == j ? pairs.of.own[i] : pairs.conductance(i, j);
          const double A = pairs.at(pairs.of.exchange, i, j) * m / c;
          const double B = (13.75 - pairs.at(pairs.of.energy, i, j) * m * m / c) / 3;
          const double C = i == j ? 0 : pairs.at(pairs.of.thermal, i, j) * m / c;  // 6/5 C* - 1
          const double inelastic = 4 * A * (1 + 5 / (3 * pi) * (rotation[i] + rotation[j]));
          for (std::size_t k = 0; k < n; ++k)
            if (k != i) {
              const double ck = pairs.conductance(i, k);
              at(i, j) += 16 * T / 25 * X[k] * ck / W[i] *
                          (W[j] * X[j] - W[i] * X[i] * ((i == j ? 1.0 : 0.0) - (j == k ? 1.0 : 0.0)));
            }
          if (i != j) {
            at(i, n + j) -= 1.6 * T * X[i] * X[j] * W[i] * C * c / m;
            at(i, n + i) += 1.6 * T * X[i] * X[j] * W[j] * C * c / m;
            at(n + j, i) -= 1.6 * T * X[i] * X[j] * W[i] * C * c / m;
            at(n + i, i) += 1.6 * T * X[i] * X[j] * W[j] * C * c / m;
          }
          const double scale = 16 * T / 25 * X[i] * X[j] * c / (m * m);
          at(n + i, n + j) += scale * W[i] * W[j] * (13.75 - 3 * B - inelastic);
          at(n + i, n + i) -= scale * (7.5 * W[i] * W[i] + W[j] * W[j] * (6.25 - 3 * B) + W[i] * W[j] * inelastic);
          if (internal[i] <= 1e-3) continue;
          const double part = 32 * T / (5 * pi) * W[i] * rotation[i] / internal[i] * A * c / m * X[i] * X[j];
          at(n + j, 2 * n + i) += part;
          at(n + i, 2 * n + i) += part;
          at(2 * n + i, n + j) += part;
          at(2 * n + i, n + i) += part;
          at(2 * n + i, 2 * n + i) -= 4 * T * X[i] * X[j] * c / internal[i];
          if (i != j)
            at(2 * n + i, 2 * n + i) -=
                4 * T / (internal[i] * internal[i]) * X[i] * X[j] * c * 12 / (5 * pi) * W[i] / W[j] * A * rotation[i];
        }
        if (internal[i] > 1e-3)
          at(2 * n + i, 2 * n + i) -= 8 / pi * W[i] * X[i] * X[i] / (internal[i] * internal[i]) * rotation[i] /
                                      (constants::gasConstant * gas.viscosity(i, T));
        else
          at(2 * n + i, 2 * n + i) = 1;
        a[n + i] = X[i];
        a[2 * n + i] = internal[i] > 1e-3 ? X[i] : 0.0;
      }
      // Rows and columns over the root of their mole fraction, for pivots to compare.
      std::vector<int> pivots(rows);
      for (std::size_t i = 0; i < rows; ++i) {
        for (std::size_t j = 0; j < rows; ++j) at(i, j) /= std::sqrt(X[i % n] * X[j % n]);
        a[i] /= std::sqrt(X[i % n]);
      }
      DenseBlocks dense;
      ASSERT_TRUE(dense.factorise(rows, L.data(), pivots.data()));
      dense.solve(rows, L.data(), pivots.data(), 1, a.data());
      double sum = 0, largest = 1e-6 * gas.viscosity(0, T);  // below that of a gas alone is round-off
      for (std::size_t i = 0; i < n; ++i) {
        sum -= 4 * std::sqrt(X[i]) * (a[n + i] + (internal[i] > 1e-3 ? a[2 * n + i] : 0.0));
        largest = std::max(largest, std::abs(1.6 / constants::gasConstant * W[i] * std::sqrt(X[i]) * a[i]));
      }
      raise(conductivity, transport.mixture(T, 1e5, X, DT).conductivity / sum - 1);
      for (std::size_t i = 0; i < n; ++i)
        raise(thermal, (DT[i] - 1.6 / constants::gasConstant * W[i] * std::sqrt(X[i]) * a[i]) / largest);
    }
  measured("conductivity by iteration", conductivity);
  measured("thermal diffusion by iteration, of the largest", thermal);
  EXPECT_LT(conductivity, 1e-7);
  EXPECT_LT(thermal, 1e-6);
}

TEST(MulticomponentTransport, IsFiniteAtTheEdges) {
  const auto& mechanism = ethylene();
  MulticomponentTransport transport(mechanism);
  const std::size_t n = mechanism.numSpecies();
  std::vector<double> DT(n), D(n * n);
  for (const double T : {Transport::minTemperature, Transport::maxTemperature})
    for (const double p : {0.1, 1e7})
      for (const char* composition : {"N2: 1", "H: 1", "C2H4: 1, O2: 1e-15"}) {
        const auto X = parseComposition(mechanism, composition);
        const auto result = transport.mixture(T, p, X, DT);
        transport.diffusion(T, p, X, D);
        EXPECT_TRUE(std::isfinite(result.viscosity) && result.viscosity > 0);
        EXPECT_TRUE(std::isfinite(result.conductivity) && result.conductivity > 0);
        EXPECT_TRUE(std::ranges::all_of(DT, [](double v) { return std::isfinite(v); }));
        EXPECT_TRUE(std::ranges::all_of(D, [](double v) { return std::isfinite(v); }));
      }
  const std::vector<double> X(n, 1.0 / static_cast<double>(n));
  EXPECT_THROW(transport.mixture(189, 1e5, X, DT), NumericsError);
  EXPECT_THROW(transport.diffusion(4201, 1e5, X, D), NumericsError);
}

// What is kept of one call does not show in the next.
TEST(MulticomponentTransport, DoesNotRememberOtherStates) {
  const auto mechanism = hydrogen();
  const std::size_t n = mechanism.numSpecies();
  std::vector<double> X(n, 1.0 / static_cast<double>(n)), DT(n), expectedDT(n), D(n * n), expected(n * n);
  MulticomponentTransport used(mechanism);
  used.mixture(500, 1e5, X, DT);
  used.diffusion(1500, 1e5, X, D);
  X[0] = 0.5;
  for (const double T : {1500.0, 500.0, 500.0, 900.0}) {
    MulticomponentTransport fresh(mechanism);
    fresh.diffusion(T, 2e5, X, expected);
    const auto mixture = MulticomponentTransport(mechanism).mixture(T, 2e5, X, expectedDT);
    EXPECT_EQ(used.mixture(T, 2e5, X, DT).conductivity, mixture.conductivity);
    used.diffusion(T, 2e5, X, D);
    EXPECT_EQ(D, expected);
    EXPECT_EQ(DT, expectedDT);
  }
}

}  // namespace
