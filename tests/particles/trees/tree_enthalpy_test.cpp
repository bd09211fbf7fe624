// Enthalpies of what trees are made of, against tables.
#include "particles/trees/tree_enthalpy.hpp"

#include <gtest/gtest.h>

namespace lampblack::particles {
namespace {

// kJ/mol above 298.15 K (Chase 1998).
TEST(TreeEnthalpy, OfSilicaIsThatOfQuartzAndWaterVapour) {
  const auto quartz = [](double T) { return *treeEnthalpy("silica", "Si", T) * 28.085e-6; };
  for (const auto& [T, above] : {std::pair{600.0, 16.89}, {1000.0, 45.36}, {1800.0, 103.7}})
    EXPECT_NEAR(quartz(T) - quartz(298.15), above, 0.06);
  EXPECT_NEAR(quartz(298.15), -910.857, 0.02);
  EXPECT_NEAR(quartz(847 - 1e-9), quartz(847 + 1e-9), 1.5) << "two phases, a small step between them";
  const auto vapour = [](double T) { return *treeEnthalpy("silica", "H", T) * 2 * 1.008e-6; };
  for (const auto& [T, above] : {std::pair{1000.0, 26.00}, {2000.0, 72.79}})
    EXPECT_NEAR(vapour(T) - vapour(298.15), above, 0.15);
  EXPECT_NEAR(vapour(298.15), -241.83, 0.15);
  EXPECT_EQ(treeEnthalpy("silica", "O", 1500), 0);
}

TEST(TreeEnthalpy, OfWhatIsNotKnownIsNothing) {
  EXPECT_FALSE(treeEnthalpy("silica", "C", 1000));
  EXPECT_FALSE(treeEnthalpy("titania", "Ti", 1000));
}

}  // namespace
}  // namespace lampblack::particles
