#include "particles/population/monte_carlo/fraction_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/modules.hpp"

namespace lampblack::particles {
namespace {

// Wang (2025), eqs. 4-11 to 4-14 by hand, the other pair of arguments being of no influence.
TEST(FractionLaw, HasTheValuesOfWang2025) {
  for (const auto of : {FractionOf::volumes, FractionOf::weights}) {
    const auto alpha = [of](FractionFunction f, double a, double b) {
      const FractionLaw law(f, of, 0.3);
      return of == FractionOf::volumes ? law(a, b, 7, 11) : law(7, 11, a, b);
    };
    EXPECT_DOUBLE_EQ(alpha(FractionFunction::one, 2, 8), 1);
    EXPECT_DOUBLE_EQ(alpha(FractionFunction::constant, 2, 8), 0.3);
    EXPECT_DOUBLE_EQ(alpha(FractionFunction::hyperbolic, 2, 8), 1 / 1.25);
    EXPECT_DOUBLE_EQ(alpha(FractionFunction::hyperbolic, 8, 2), 1 / 1.25);
    EXPECT_DOUBLE_EQ(alpha(FractionFunction::hyperbolic, 5, 5), 0.5);
    EXPECT_DOUBLE_EQ(alpha(FractionFunction::exponential, 8, 2), 1 - 1.0 / 16);
    EXPECT_DOUBLE_EQ(alpha(FractionFunction::exponential, 5, 5), 0.5);
    EXPECT_DOUBLE_EQ(alpha(FractionFunction::stepwise, 4, 2), 0.5);
    EXPECT_DOUBLE_EQ(alpha(FractionFunction::stepwise, 4.01, 2), 1);
  }
}

TEST(FractionLaw, TheBoundHoldsAndIsReached) {
  for (const auto of : {FractionOf::volumes, FractionOf::weights}) {
    for (const auto f : {FractionFunction::one, FractionFunction::hyperbolic, FractionFunction::exponential,
                         FractionFunction::stepwise, FractionFunction::constant}) {
      const FractionLaw law(f, of, 0.4);
      double largest = 0;
      for (double v = 1; v < 200; v *= 1.07) {
        for (double w = 1; w < 1e9; w *= 1.21) {
          const double rate = law.rate(v, 1, w, 1);
          EXPECT_DOUBLE_EQ(rate, w / law(v, 1, w, 1));
          largest = std::max(largest, rate / (w + 1));
        }
      }
      largest = std::max(largest, law.rate(2, 1, 2, 1) / 3);
      EXPECT_LE(largest, law.bound() * (1 + 1e-14));
      EXPECT_GE(largest, law.bound() * (1 - 1e-8));
    }
  }
}

TEST(FractionLaw, AConstantOutsideItsRangeIsAnError) {
  for (const double c : {0.0, -0.5, 1.5, std::nan("")}) {
    EXPECT_THROW(FractionLaw(FractionFunction::constant, FractionOf::volumes, c), InputError);
  }
  EXPECT_NO_THROW(FractionLaw(FractionFunction::constant, FractionOf::volumes, 1));
}

}  // namespace
}  // namespace lampblack::particles
