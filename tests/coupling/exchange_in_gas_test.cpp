// The exchange that is expected while a gas reacts: rates by hand, and derivatives against differences, which are exact
// as all is linear in each of its arguments.
#include "coupling/exchange_in_gas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/coupling/toy_particles.hpp"

namespace lampblack::coupling {
namespace {

class ExpectedExchange : public ::testing::Test {
 protected:
  ExpectedExchange() {
    exchange.expect(std::array{ExchangeInGas::Rate{3e4, 0}, ExchangeInGas::Rate{0, 0.7}}, 2e-5);
    for (std::size_t k = 0; k < c.size(); ++k) c[k] = 0.1 + 0.01 * static_cast<double>(k);
    for (std::size_t s = 0; s < densities.size(); ++s) densities[s] = 0.3 + 0.1 * static_cast<double>(s);
  }
  // Rates of the amounts, then of the species.
  std::vector<double> all() {
    std::vector<double> rates(exchange.size()), species(2);
    exchange.sources(1500, 101325, c, densities, rates, species);
    rates.insert(rates.end(), species.begin(), species.end());
    return rates;
  }
  const Mechanism& mechanism = test::ethylene();
  std::size_t acetylene = mechanism.speciesIndex("C2H2"), hydrogen = mechanism.speciesIndex("H2");
  ExchangeInGas exchange{mechanism, {"C", "H"}, {acetylene, hydrogen}};
  std::vector<double> c = std::vector<double>(mechanism.numSpecies());
  std::vector<double> densities = std::vector<double>(exchange.size());
};

TEST_F(ExpectedExchange, TakesByConcentrationAndGivesConstantly) {
  const std::vector<double> rates = all();
  const double taken = 3e4 * c[acetylene], H = mechanism.atomicWeight(mechanism.elementIndex("H"));
  EXPECT_DOUBLE_EQ(rates[exchange.size()], -taken);
  EXPECT_DOUBLE_EQ(rates[exchange.size() + 1], 0.7);
  EXPECT_NEAR(rates[0] / (2 * taken * mechanism.atomicWeight(mechanism.elementIndex("C"))), 1, 1e-12);
  EXPECT_NEAR(rates[1] / (2 * H * (taken - 0.7)), 1, 1e-12);
}

TEST_F(ExpectedExchange, AmountsTellTheMeanAndWhatWasExchanged) {
  // A gas that does not change, over 2e-5 s with a density of 0.4 kg/m3.
  densities.assign(densities.size(), 0);
  densities[exchange.mark()] = 0.4;
  std::vector<double> amounts = all();
  for (double& rate : amounts) rate *= 2e-5 / 0.4;
  EXPECT_NEAR(exchange.meanConcentration(amounts, 0) / c[acetylene], 1, 1e-12);
  EXPECT_NEAR(exchange.meanConcentration(amounts, 1) / c[hydrogen], 1, 1e-12);
  EXPECT_NEAR(exchange.added(amounts, 0) / (-3e4 * c[acetylene] * 2e-5 / 0.4), 1, 1e-12);
  EXPECT_NEAR(exchange.added(amounts, 1) / (0.7 * 2e-5 / 0.4), 1, 1e-12);
}

TEST_F(ExpectedExchange, DerivativesAreThoseOfTheRates) {
  const std::size_t rows = exchange.size() + 2, columns = exchange.size() + 3;
  std::vector<double> values(rows * columns);
  exchange.jacobian(1500, 101325, c, densities, values);
  const std::vector<double> before = all();
  double largest = 0;
  for (std::size_t column = 0; column + 1 < columns; ++column) {
    double& argument =
        column < exchange.size() ? densities[column] : c[column == exchange.size() ? acetylene : hydrogen];
    const double kept = argument, step = 0.125;
    argument += step;
    const std::vector<double> after = all();
    argument = kept;
    for (std::size_t row = 0; row < rows; ++row) {
      const double slope = values[row * columns + column];
      largest = std::max(largest, std::abs(slope));
      EXPECT_NEAR((after[row] - before[row]) / step, slope, 1e-9 * (std::abs(before[row]) + std::abs(slope)) + 1e-12)
          << row << ", " << column;
    }
  }
  EXPECT_GT(largest, 1e4);
}

}  // namespace
}  // namespace lampblack::coupling
