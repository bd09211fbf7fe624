#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "chemistry/kinetics.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/table.hpp"

namespace {

using namespace lampblack;
using lampblack::testing::ethylene;
using lampblack::testing::hydrogen;
using lampblack::testing::measured;
using lampblack::testing::raise;

// Central differences of fourth order with a relative step h have an error of about h^4 + eps/h: 1e-11 at h = 1e-3
// where the rates are polynomials of low degree, and a little more through the fall-off curves.
template <class Rates>
std::vector<double> difference(std::size_t n, double value, double step, Rates&& rates) {
  std::vector<double> a(n), b(n), c(n), d(n), slope(n);
  rates(value - 2 * step, a);
  rates(value - step, b);
  rates(value + step, c);
  rates(value + 2 * step, d);
  for (std::size_t k = 0; k < n; ++k) slope[k] = (a[k] - 8 * b[k] + 8 * c[k] - d[k]) / (12 * step);
  return slope;
}

TEST(KineticsJacobian, AgreesWithDifferencesOfTheRates) {
  double worst = 0, worstByT = 0;
  for (const auto* mechanism : {&hydrogen(), &ethylene()}) {
    Kinetics kinetics(*mechanism);
    const std::size_t n = mechanism->numSpecies();
    std::vector<double> c(n), wdot(n), J(n * n), byT(n), gross(n);
    for (const double T : {700.0, 1400.0, 2300.0}) {
      for (std::size_t k = 0; k < n; ++k) c[k] = 0.01 + 0.3 * static_cast<double>((k * 5) % 13);
      kinetics.netProductionRatesAndJacobian(T, c, wdot, J, byT);
      for (std::size_t j = 0; j < n; ++j) {
        const auto slope = difference(n, c[j], 1e-3 * c[j], [&](double value, std::vector<double>& out) {
          auto changed = c;
          changed[j] = value;
          kinetics.netProductionRates(T, changed, out);
        });
        double largest = 0;
        for (const double s : slope) largest = std::max(largest, std::abs(s));
        // Each entry against the round-off of the rate it is a difference of, and its column's size.
        for (std::size_t k = 0; k < n; ++k) {
          if (largest > 0) raise(worst, (J[j * n + k] - slope[k]) / largest);
          EXPECT_NEAR(J[j * n + k], slope[k], 1e-8 * largest + 1e-11 * std::abs(wdot[k] / c[j]))
              << mechanism->speciesName(k) << " by " << mechanism->speciesName(j) << " at " << T;
        }
      }
      const auto slope = difference(
          n, T, 0.2, [&](double value, std::vector<double>& out) { kinetics.netProductionRates(value, c, out); });
      double largest = 0;
      for (const double s : slope) largest = std::max(largest, std::abs(s));
      for (std::size_t k = 0; k < n; ++k) {
        raise(worstByT, (byT[k] - slope[k]) / largest);
        EXPECT_NEAR(byT[k], slope[k], 1e-8 * largest) << mechanism->speciesName(k) << " by T at " << T;
      }
    }
  }
  measured("by concentration, of the column's largest", worst);
  measured("by temperature, of the largest", worstByT);
}

}  // namespace
