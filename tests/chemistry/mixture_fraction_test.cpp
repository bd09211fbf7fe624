#include "chemistry/thermo/mixture_fraction.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "chemistry/thermo/thermo.hpp"
#include "core/errors.hpp"
#include "tests/chemistry/table.hpp"
#include "tests/every_module.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::chemistry;

std::vector<double> massFractions(const std::string& composition) {
  const Mechanism& mechanism = lampblack::test::ethylene();
  const std::vector<double> X = parseComposition(mechanism, composition);
  std::vector<double> Y(X.size());
  Thermo(mechanism).moleToMass(X, Y);
  return Y;
}

TEST(MixtureFraction, GoesByTheElementsAlone) {
  const auto fuel = massFractions("C2H4: 4, N2: 1"), air = massFractions("O2: 0.21, N2: 0.79");
  const MixtureFraction mixture(lampblack::test::ethylene(), fuel, air);
  EXPECT_NEAR(mixture.of(fuel), 1.0, 1e-14);
  EXPECT_NEAR(mixture.of(air), 0.0, 1e-14);
  std::vector<double> mixed(fuel.size());
  for (std::size_t k = 0; k < mixed.size(); ++k) mixed[k] = 0.3 * fuel[k] + 0.7 * air[k];
  EXPECT_NEAR(mixture.of(mixed), 0.3, 1e-14);
  // Burnt or not, wholly or to CO, the stoichiometric mixture has one: of masses, 4 C2H4 + N2 to 12 O2 and its N2.
  const double fuelMass = 4.0 * 28.054 + 28.014, airMass = 12.0 * (31.998 + 79.0 / 21.0 * 28.014);
  const double stoichiometric = fuelMass / (fuelMass + airMass), nitrogen = 1.0 + 12.0 * 79.0 / 21.0;
  const auto of = [&](const std::string& gas) {
    return mixture.of(massFractions(gas + ", N2: " + std::to_string(nitrogen)));
  };
  EXPECT_NEAR(of("C2H4: 4, O2: 12"), stoichiometric, 1e-5);
  EXPECT_NEAR(of("CO2: 8, H2O: 8"), stoichiometric, 1e-5);
  EXPECT_NEAR(of("CO: 8, H2: 8, O2: 8"), stoichiometric, 1e-5);
  // What neither burns nor lets burn counts as stoichiometric.
  for (const char* gas : {"CO2: 1", "H2O: 1", "N2: 1"})
    EXPECT_NEAR(mixture.of(massFractions(gas)), stoichiometric, 1e-5) << gas;
}

TEST(MixtureFraction, NeedsTwoStreamsThatDiffer) {
  const auto air = massFractions("O2: 0.21, N2: 0.79");
  EXPECT_THROW(MixtureFraction(lampblack::test::ethylene(), air, air), InputError);
  EXPECT_THROW(MixtureFraction(lampblack::test::ethylene(), massFractions("N2: 1"), massFractions("AR: 1")),
               InputError);
}

}  // namespace
