// Enthalpies of what particles are made of, against tables.
#include "particles/models/element_enthalpies.hpp"

#include <gtest/gtest.h>

#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

const std::vector<std::string> silicaElements{"O", "Si", "H"};

// kJ/mol above 298.15 K (Chase 1998).
TEST(ElementEnthalpies, OfSilicaAreThoseOfQuartzAndWaterVapour) {
  const auto all = elementEnthalpies(silicaElements);
  ASSERT_TRUE(all);
  const auto quartz = [&](double T) { return (*all)[1](T).first * 28.085e-6; };
  for (const auto& [T, above] : {std::pair{600.0, 16.89}, {1000.0, 45.36}, {1800.0, 103.7}})
    EXPECT_NEAR(quartz(T) - quartz(298.15), above, 0.06);
  EXPECT_NEAR(quartz(298.15), -910.857, 0.02);
  EXPECT_NEAR(quartz(847 - 1e-9), quartz(847 + 1e-9), 1.5) << "two phases, a small step between them";
  const auto vapour = [&](double T) { return (*all)[2](T).first * 2 * 1.008e-6; };
  for (const auto& [T, above] : {std::pair{1000.0, 26.00}, {2000.0, 72.79}})
    EXPECT_NEAR(vapour(T) - vapour(298.15), above, 0.15);
  EXPECT_NEAR(vapour(298.15), -241.83, 0.15);
  EXPECT_EQ((*all)[0](1500).first, 0);
}

TEST(ElementEnthalpies, HaveTheirSlopes) {
  for (const std::vector<std::string>& elements : {silicaElements, {"C", "H"}}) {
    const auto all = elementEnthalpies(elements);
    ASSERT_TRUE(all);
    for (const ElementEnthalpy of : *all)
      for (const double T : {500.0, 1300.0, 2100.0})
        EXPECT_NEAR((of(T + 0.1).first - of(T - 0.1).first) / 0.2, of(T).second, 1e-5 * std::abs(of(T).second));
  }
}

TEST(ElementEnthalpies, OfWhatIsNotKnownAreNothing) {
  for (const std::vector<std::string>& elements :
       std::vector<std::vector<std::string>>{{"Si", "C"}, {"Ti", "O"}, {"C", "H", "O"}, {"O", "H"}, {}})
    EXPECT_FALSE(elementEnthalpies(elements));
}

}  // namespace
}  // namespace lampblack::test
