#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "chemistry/kinetics/kinetics.hpp"
#include "tests/chemistry/kinetics_rate_types.hpp"
#include "tests/chemistry/kinetics_reference.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::ethylene;
using lampblack::test::hydrogen;
using lampblack::test::measured;
using lampblack::test::plainRates;
using lampblack::test::raise;
using lampblack::test::RateTypes;
using Complex = std::complex<double>;

// Derivatives of the plain formulas by complex steps, exact to round-off; column n is that by temperature.
std::vector<std::vector<double>> plainDerivatives(const Mechanism& mechanism, double T, const std::vector<double>& c) {
  const std::size_t n = c.size();
  constexpr double step = 1e-40;
  std::vector<std::vector<double>> columns;
  for (std::size_t j = 0; j <= n; ++j) {
    std::vector<Complex> moved(c.begin(), c.end());
    if (j < n) moved[j] += Complex(0, step);
    const auto rates = plainRates<Complex>(mechanism, j == n ? Complex(T, step) : Complex(T), moved);
    columns.emplace_back();
    for (const auto& w : rates.wdot) columns.back().push_back(w.imag() / step);
  }
  return columns;
}

// All types of rates, fall-off and efficiencies of real mechanisms; cold, hot, low and high pressures, species absent.
// The plain formulas lose a few digits where large terms cancel, so each entry is held to its column's largest.
TEST(KineticsJacobian, AgreesWithComplexStepsThroughThePlainFormulas) {
  const auto all = RateTypes::mechanism();
  const auto methane = Mechanism::fromFile(lampblack::test::sourcePath("cases/mechanisms/methane_gri30_53.yaml"));
  double worst = 0, worstByT = 0;
  for (const auto* mechanism : {&all, &hydrogen(), &ethylene(), &methane}) {
    Kinetics kinetics(*mechanism);
    const std::size_t n = mechanism->numSpecies(), stride = n + 3;
    std::vector<double> c(n), wdot(n), plain(n), J(stride * n, -7.0), byT(n);
    for (const double T : {200.0, 760.0, 1400.0, 4000.0})
      for (const double scale : {1e-3, 0.3, 300.0}) {
        for (std::size_t k = 0; k < n; ++k)
          c[k] = (k * 5) % 4 == 3 ? 0.0 : scale * (0.01 + 0.1 * static_cast<double>((k * 5) % 13));
        kinetics.netProductionRatesAndJacobian(T, c, wdot, J, byT, stride);
        kinetics.netProductionRates(T, c, plain);
        EXPECT_EQ(wdot, plain);
        const auto expected = plainDerivatives(*mechanism, T, c);
        for (std::size_t j = 0; j <= n; ++j) {
          double largest = 0;
          for (const double e : expected[j]) largest = std::max(largest, std::abs(e));
          for (std::size_t k = 0; k < n; ++k) {
            const double value = j == n ? byT[k] : J[j * stride + k];
            if (largest > 0) raise(j == n ? worstByT : worst, (value - expected[j][k]) / largest);
            EXPECT_NEAR(value, expected[j][k], 1e-11 * largest)
                << mechanism->speciesName(k) << " by " << (j == n ? "T" : mechanism->speciesName(j)) << " at " << T;
          }
          if (j < n) {
            EXPECT_EQ(J[j * stride + n], -7.0);
          }
        }
      }
  }
  measured("by concentration, of the column's largest", worst);
  measured("by temperature, of the largest", worstByT);
}

TEST(KineticsJacobian, IsFiniteWithoutGas) {
  const auto mechanism = RateTypes::mechanism();
  Kinetics kinetics(mechanism);
  const std::size_t n = mechanism.numSpecies();
  std::vector<double> c(n, 0.0), wdot(n), J(n * n), byT(n);
  for (const double T : {200.0, 1400.0, 4000.0}) {
    kinetics.netProductionRatesAndJacobian(T, c, wdot, J, byT);
    for (const double w : wdot) EXPECT_EQ(w, 0);
    for (const auto* values : {&J, &byT})
      for (const double value : *values) EXPECT_TRUE(std::isfinite(value));
  }
}

// The rows of each column rise and contain the diagonal; the dense form is the sparse one plus the common part.
TEST(KineticsJacobian, SparseFormHasItsPattern) {
  for (const auto* mechanism : {&hydrogen(), &ethylene()}) {
    Kinetics kinetics(*mechanism);
    const auto& pattern = kinetics.jacobianPattern();
    const std::size_t n = mechanism->numSpecies();
    ASSERT_EQ(pattern.size, n);
    ASSERT_EQ(pattern.columnStart.size(), n + 1);
    ASSERT_EQ(static_cast<std::size_t>(pattern.columnStart[n]), pattern.numEntries());
    std::vector<double> c(n, 0.2), wdot(n), values(pattern.numEntries()), common(n), byT(n), J(n * n);
    kinetics.netProductionRatesAndSparseJacobian(1500, c, wdot, values, common, byT);
    kinetics.netProductionRatesAndJacobian(1500, c, wdot, J, byT);
    for (std::size_t j = 0; j < n; ++j) {
      std::vector<double> column(common);
      bool diagonal = false;
      const auto first = static_cast<std::size_t>(pattern.columnStart[j]);
      const auto last = static_cast<std::size_t>(pattern.columnStart[j + 1]);
      for (auto e = first; e < last; ++e) {
        const auto row = static_cast<std::size_t>(pattern.row[e]);
        diagonal = diagonal || row == j;
        if (e > first) {
          EXPECT_GT(pattern.row[e], pattern.row[e - 1]);
        }
        column[row] += values[e];
      }
      EXPECT_TRUE(diagonal) << j;
      for (std::size_t k = 0; k < n; ++k) EXPECT_EQ(column[k], J[j * n + k]);
    }
  }
}

// Colliders that are all named have entries of their own and leave nothing common.
TEST(KineticsJacobian, NamedCollidersAreNotCommon) {
  auto named = RateTypes::sriFalloff();
  named.thirdBody->defaultEfficiency = 0;
  const auto mechanism = RateTypes::withOnly(named);
  Kinetics kinetics(mechanism);
  const std::size_t n = mechanism.numSpecies();
  std::vector<double> c(n, 0.2), wdot(n), values(kinetics.jacobianPattern().numEntries()), common(n), byT(n);
  kinetics.netProductionRatesAndSparseJacobian(1500, c, wdot, values, common, byT);
  for (const double value : common) EXPECT_EQ(value, 0);
  // n diagonals, OH and H2O2 by each other, both by the two colliders H2O and AR
  EXPECT_EQ(values.size(), n + 2 + 4);
}

}  // namespace
