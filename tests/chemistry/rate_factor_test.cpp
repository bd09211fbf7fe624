// Reactions that go at a share of their rates: the same as at all of them in as much less time, in which all else is as
// much faster.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "chemistry/reactor/growth_rate.hpp"
#include "chemistry/reactor/newton_matrix.hpp"
#include "chemistry/reactor/reactor.hpp"
#include "chemistry/reactor/reactor_system.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::ethylene;
using lampblack::test::hydrogen;

constexpr double share = 0.15;

// Air that burns with hydrogen, and what a stream of cold hydrogen brings.
struct Slowed {
  const Mechanism& mechanism = hydrogen();
  std::size_t n = mechanism.numSpecies();
  std::vector<double> Y = std::vector<double>(n), source = Y;
  double temperature = 1400.0, heating = 2e9;
  Slowed() {
    Thermo(mechanism).moleToMass(parseComposition(mechanism, "H2: 0.3, O2: 0.2, N2: 0.5, H: 0.01, OH: 0.02"), Y);
    for (std::size_t k = 0; k < n; ++k) source[k] = -300.0 * Y[k];
    source[mechanism.speciesIndex("H2")] += 300.0;
  }
  [[nodiscard]] std::vector<double> times(double factor) const {
    std::vector<double> all = source;
    for (double& value : all) value *= factor;
    return all;
  }
};

TEST(RateFactor, ScalesRatesAndBothJacobians) {
  const Slowed gas;
  const std::size_t size = gas.n + 1;
  std::vector<double> y = gas.Y, f(size), fOfLess(size), J(size * size), JOfLess(size * size);
  y.push_back(gas.temperature);
  ReactorSystem system(gas.mechanism);
  NewtonMatrix matrix(system), ofLess(system);
  system.setConditions(constants::oneAtmosphere, gas.times(1.0 / share), gas.heating / share);
  ASSERT_TRUE(system.jacobian(y.data(), f.data(), J.data(), size));
  ASSERT_TRUE(matrix.evaluate(system, y.data(), f.data()));
  const auto& source = gas.source;
  system.setConditions(constants::oneAtmosphere, source, gas.heating, share);
  ASSERT_TRUE(system.rates(y.data(), fOfLess.data()));
  for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(fOfLess[i], share * f[i], 1e-12 * std::abs(f[i])) << i;
  ASSERT_TRUE(system.jacobian(y.data(), fOfLess.data(), JOfLess.data(), size));
  for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(fOfLess[i], share * f[i], 1e-12 * std::abs(f[i])) << i;
  for (std::size_t i = 0; i < size * size; ++i) EXPECT_NEAR(JOfLess[i], share * J[i], 1e-9 * std::abs(J[i])) << i;
  ASSERT_TRUE(ofLess.evaluate(system, y.data(), fOfLess.data()));
  // (1 - h J) x = b is (1 - h share J') x = b.
  const double h = 1e-5;
  std::vector<double> b(size, 1.0), x = b;
  ASSERT_TRUE(matrix.factorise(share * h));
  ASSERT_TRUE(ofLess.factorise(h));
  matrix.solve(b.data());
  ofLess.solve(x.data());
  for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(x[i], b[i], 1e-8 * std::abs(b[i])) << i;
  std::vector<double> chemical(size), all(size);
  ASSERT_TRUE(system.chemicalRates(y.data(), chemical.data()));
  system.setConditions(constants::oneAtmosphere, {});
  ASSERT_TRUE(system.chemicalRates(y.data(), all.data()));
  for (std::size_t k = 0; k < gas.n; ++k) EXPECT_NEAR(chemical[k], share * all[k], 1e-13 * std::abs(all[k])) << k;
}

// By the Rosenbrock method, alone and in lanes, by CVODE, and by the explicit step of gas that hardly reacts.
TEST(RateFactor, IsAsMuchLessTime) {
  const Slowed gas;
  const double dt = 1e-4;
  for (const int steps : {1000, 0}) {
    ConstantPressureReactor::Options options;
    options.relativeTolerance = steps > 0 ? 1e-5 : 1e-9;
    options.rosenbrockSteps = steps;
    ConstantPressureReactor reactor(gas.mechanism, options);
    std::vector<double> expected = gas.Y, one = gas.Y, lane = gas.Y, mixed = gas.times(1.0 / share);
    ConstantPressureReactor::Cell whole{gas.temperature,    constants::oneAtmosphere, expected, mixed, 0,
                                        gas.heating / share};
    const auto ofWhole = reactor.advance(whole, share * dt);
    const ConstantPressureReactor::Cell slowed{
        gas.temperature, constants::oneAtmosphere, one, gas.source, 0, gas.heating, share};
    ConstantPressureReactor::Cell alone = slowed;
    const auto ofAlone = reactor.advance(alone, dt);
    std::vector<ConstantPressureReactor::Cell> together{slowed};
    together[0].Y = lane;
    std::vector<ConstantPressureReactor::Result> results(1);
    reactor.advance(together, dt, results);
    EXPECT_GT(std::abs(whole.temperature - gas.temperature), 100.0);
    // A wrong Jacobian costs steps.
    if (steps > 0) {
      EXPECT_FALSE(ofAlone.handedOver || results[0].handedOver);
      EXPECT_EQ(ofAlone.steps, ofWhole.steps);
      EXPECT_EQ(results[0].steps, ofWhole.steps);
    }
    EXPECT_NEAR(alone.temperature, whole.temperature, 1e-3);
    EXPECT_NEAR(together[0].temperature, whole.temperature, 1e-3);
    for (std::size_t k = 0; k < gas.n; ++k) {
      EXPECT_NEAR(one[k], expected[k], 1e-7) << k;
      EXPECT_NEAR(lane[k], expected[k], 1e-7) << k;
    }
  }
}

TEST(RateFactor, OfNothingLeavesTheSource) {
  const Slowed gas;
  const double dt = 1e-4;
  ConstantPressureReactor reactor(gas.mechanism);
  std::vector<double> Y = gas.Y;
  std::vector<ConstantPressureReactor::Cell> cells{
      {gas.temperature, constants::oneAtmosphere, Y, gas.source, 0, gas.heating, 0.0}};
  std::vector<ConstantPressureReactor::Result> results(1);
  reactor.advance(cells, dt, results);
  EXPECT_TRUE(results[0].skipped);
  for (std::size_t k = 0; k < gas.n; ++k) EXPECT_NEAR(Y[k], gas.Y[k] + dt * gas.source[k], 1e-14) << k;
}

TEST(RateFactor, SlowsWhatGrows) {
  const Slowed gas;
  GrowthRate growth(gas.mechanism, -1e-10);
  const double dt = 1e-5, all = growth.of(gas.temperature, constants::oneAtmosphere, gas.Y, dt);
  EXPECT_GT(all, 1e5);
  EXPECT_NEAR(growth.of(gas.temperature, constants::oneAtmosphere, gas.Y, dt / share, share), share * all, 1e-6 * all);
}

}  // namespace
