// States at the edge of what a gas can be: the reactor gives finite numbers that conserve, or says clearly why not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "chemistry/reactor/reactor.hpp"
#include "chemistry/reactor/reactor_failure.hpp"
#include "chemistry/reactor/reactor_system.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/constants.hpp"
#include "tests/chemistry/measured.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;
using lampblack::test::measured;
using lampblack::test::raise;
using ::testing::HasSubstr;

const Mechanism& methane() {
  static const auto mechanism =
      Mechanism::fromFile(lampblack::test::sourcePath("cases/mechanisms/methane_gri30_53.yaml"));
  return mechanism;
}

std::vector<double> massFractions(const char* moles) {
  std::vector<double> Y(methane().numSpecies());
  Thermo(methane()).moleToMass(parseComposition(methane(), moles), Y);
  return Y;
}

// Fresh, burnt, pure and radical-rich gas.
constexpr const char* kMixtures[] = {"CH4: 1, O2: 2, N2: 7.52", "H2O: 2, CO2: 1, N2: 7.52", "N2: 1", "CH4: 1",
                                     "H: 1, OH: 1, O: 1, N2: 3"};
constexpr double kTemperatures[] = {200, 300, 1000, 2500, 4000};  // K
constexpr double kPressures[] = {0.1, 1e2, 1e5, 1e7};             // Pa; 1e-6 to 100 bar

TEST(ReactorEdge, EveryStateIsAdvancedAndConserves) {
  ConstantPressureReactor reactor(methane());
  const Thermo thermo(methane());
  double worstH = 0, worstElement = 0;
  int advanced = 0;
  for (const char* mixture : kMixtures)
    for (const double T : kTemperatures)
      for (const double p : kPressures) {
        auto Y = massFractions(mixture);
        const auto start = Y;
        ConstantPressureReactor::Cell cell{T, p, Y, {}, 0.0};
        ASSERT_NO_THROW(reactor.advance(cell, 1e-5)) << mixture << " at " << T << " K, " << p << " Pa";
        ++advanced;
        ASSERT_TRUE(std::isfinite(cell.temperature));
        const double cp = thermo.cpMass(cell.temperature, Y);
        const double heat = (thermo.enthalpyMass(cell.temperature, Y) - thermo.enthalpyMass(T, start)) / (cp * T);
        raise(worstH, heat);
        EXPECT_NEAR(heat, 0, 1e-9) << mixture << " at " << T << " K, " << p << " Pa";
        for (std::size_t i = 0; i < methane().numElements(); ++i) {
          double change = 0;
          for (std::size_t k = 0; k < Y.size(); ++k)
            change +=
                (Y[k] - start[k]) / methane().molecularWeights()[k] * methane().atoms(k, i) * methane().atomicWeight(i);
          raise(worstElement, change);
          EXPECT_NEAR(change, 0, 1e-10) << methane().elementName(i) << " in " << mixture << " at " << T << " K";
        }
        for (std::size_t k = 0; k < Y.size(); ++k)
          EXPECT_GT(Y[k], -1e-8) << methane().speciesName(k) << " in " << mixture << " at " << T << " K, " << p
                                 << " Pa";
      }
  EXPECT_EQ(advanced, 100);
  measured("enthalpy, of cp T", worstH);
  measured("element mass fractions", worstElement);
}

// A burnt gas left alone for long ends at equilibrium: nothing moves any more, at any pressure.
TEST(ReactorEdge, EquilibriumIsReachedFromTheHottestToTheThinnest) {
  ConstantPressureReactor reactor(methane());
  for (const double p : {1e4, 1e5, 1e7}) {
    auto Y = massFractions("CH4: 1, O2: 2, N2: 7.52");
    ConstantPressureReactor::Cell cell{2000.0, p, Y, {}, 0.0};
    reactor.advance(cell, 100.0);
    const auto before = Y;
    const double T = cell.temperature;
    reactor.advance(cell, 100.0);
    EXPECT_NEAR(cell.temperature, T, 1e-3) << p;
    for (std::size_t k = 0; k < Y.size(); ++k) EXPECT_NEAR(Y[k], before[k], 1e-7) << methane().speciesName(k);
  }
}

TEST(ReactorEdge, JacobianAndRatesAreFiniteWithoutASpecies) {
  ReactorSystem system(methane());
  const std::size_t n = methane().numSpecies();
  for (const char* mixture : kMixtures)
    for (const double T : kTemperatures)
      for (const double p : kPressures) {
        auto y = massFractions(mixture);
        y.push_back(T);
        std::vector<double> f(n + 1);
        system.setConditions(p, {});
        ReactorSystem::SparseJacobian J;
        ASSERT_TRUE(system.sparseJacobian(y.data(), f.data(), J));
        for (const auto* part : {&J.species, &J.temperatureRow, &J.temperatureColumn, &J.product, &f})
          for (const double value : *part) ASSERT_TRUE(std::isfinite(value)) << mixture << " " << T << " " << p;
      }
}

// Beyond the data there is no answer: the message says what was met.
TEST(ReactorEdge, AReactionOutOfTheRangeOfTheDataIsAnErrorWithTheTemperature) {
  ConstantPressureReactor reactor(methane(), {1e-6, 1e-12, 2000, 0.0});
  auto Y = massFractions("O: 1");
  ConstantPressureReactor::Cell cell{5900.0, 1e7, Y, {}, 0.0};
  try {
    reactor.advance(cell, 1e-3);
    FAIL() << "advanced to " << cell.temperature;
  } catch (const ReactorFailure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("T = 5900 K"));
    EXPECT_THAT(failure.what(), HasSubstr("O: 1"));
    EXPECT_THAT(failure.what(), HasSubstr("outside 100 to 6000 K"));
    EXPECT_EQ(failure.cell().Y, massFractions("O: 1"));
  }
}

}  // namespace
