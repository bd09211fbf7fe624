// A gas that varies over place and time: given mole fractions, and what the other species become.
#include "flow/boundaries/gas_variation.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "core/errors.hpp"
#include "tests/every_module.hpp"
#include "tests/flow/flow_fixture.hpp"
#include "tests/messages.hpp"

namespace lampblack::test {
namespace {

class VaryingGas : public testing::Test {
 protected:
  Gas& gas = Gas::hydrogen();
  std::size_t of(const char* name) { return gas.mechanism.speciesIndex(name); }
  static FieldFunction always(double value) {
    return [value](const Vector3&, double) { return value; };
  }
  // Mole fractions of what a variation makes of mass fractions.
  std::vector<double> applied(const GasVariation& variation, std::vector<double> Y) {
    double T = 300.0;
    variation.apply({}, 0.0, gas.thermo, T, Y);
    std::vector<double> X(Y.size());
    gas.thermo.massToMole(Y, X);
    return X;
  }
  std::vector<double> nothing = std::vector<double>(gas.mechanism.numSpecies(), 0.0);
};

TEST_F(VaryingGas, OthersKeepTheirProportionsAndFillWhatIsLeft) {
  GasVariation variation;
  variation.moleFractions = {{of("H2"), always(0.4)}};
  const std::vector<double> X = applied(variation, gas.massFractions("O2: 0.21, N2: 0.79"));
  EXPECT_NEAR(X[of("H2")], 0.4, 1e-12);
  EXPECT_NEAR(X[of("O2")], 0.6 * 0.21, 1e-12);
  EXPECT_NEAR(X[of("N2")], 0.6 * 0.79, 1e-12);
}

TEST_F(VaryingGas, WhatIsGivenIsAllWhereThereIsNothingElse) {
  GasVariation variation;
  variation.moleFractions = {{of("H2"), always(0.4)}, {of("N2"), always(0.6)}};
  const std::vector<double> X = applied(variation, nothing);
  EXPECT_NEAR(X[of("H2")], 0.4, 1e-12);
  EXPECT_NEAR(X[of("N2")], 0.6, 1e-12);
  EXPECT_NEAR(std::accumulate(X.begin(), X.end(), 0.0), 1.0, 1e-12);
}

TEST_F(VaryingGas, FractionsThatDoNotSumToOneAreRefused) {
  GasVariation variation;
  variation.moleFractions = {{of("H2"), always(0.4)}, {of("N2"), always(0.5)}};
  EXPECT_NE(messageOf<InputError>([&] { applied(variation, nothing); }).find("sum to one, found 0.9"),
            std::string::npos);
  variation.moleFractions = {{of("H2"), always(0.7)}, {of("N2"), always(0.5)}};
  EXPECT_NE(
      messageOf<InputError>([&] { applied(variation, gas.massFractions("O2: 1")); }).find("sum to one, found 1.2"),
      std::string::npos);
  variation.moleFractions = {{of("H2"), always(-0.1)}};
  EXPECT_NE(messageOf<InputError>([&] { applied(variation, nothing); }).find("zero or more, found -0.1"),
            std::string::npos);
}

}  // namespace
}  // namespace lampblack::test
