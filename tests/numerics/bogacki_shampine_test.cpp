#include "numerics/bogacki_shampine.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "core/modules.hpp"

namespace lampblack::numerics {
namespace {

constexpr std::array<double, 2> unity{1, 1};
constexpr double anyError = 1e9;

// x' = -x^2, y' = x^2 - sin y.
void smooth(std::span<const double> y, std::span<double> f) {
  f[0] = -y[0] * y[0];
  f[1] = y[0] * y[0] - std::sin(y[1]);
}

double endAfterSteps(int steps) {
  BogackiShampine method;
  std::vector<double> y{1, 0};
  for (int i = 0; i < steps; ++i) EXPECT_TRUE(method.step(smooth, 1.0 / steps, y, anyError, unity));
  EXPECT_NEAR(y[0], 0.5, 0.01);
  return y[1];
}

TEST(BogackiShampine, IsOfThirdOrder) {
  const double coarse = endAfterSteps(20), middle = endAfterSteps(40), fine = endAfterSteps(80);
  EXPECT_NEAR(std::log2((coarse - middle) / (middle - fine)), 3, 0.1);
}

// The error of the embedded method of second order goes with the third power of the step.
TEST(BogackiShampine, TakesAStepAsLongAsItsErrorAllows) {
  const auto longest = [](double tolerance) {
    BogackiShampine method;
    for (double h = 1;; h *= 0.99) {
      std::vector<double> y{1, 0};
      if (method.step(smooth, h, y, tolerance, unity)) return h;
      EXPECT_EQ(y[0], 1);  // as it was
      EXPECT_EQ(y[1], 0);
    }
  };
  EXPECT_NEAR(longest(1e-5) / longest(1e-8), 10, 1);
}

// A fast mode at rest does not show in the error, but grows by each step: a long one is refused.
TEST(BogackiShampine, RefusesWhatIsStiffHoweverSmallItsError) {
  BogackiShampine method;
  const auto rates = [](std::span<const double> y, std::span<double> f) {
    f[0] = -1e4 * (y[0] - y[1]);
    f[1] = -y[1];
  };
  for (const double h : {1e-5, 1e-3}) {
    std::vector<double> y{1.0002, 1};  // 1e-4 beside its slow path
    EXPECT_EQ(method.step(rates, h, y, 1e-2, unity), h < 1e-4) << h;
  }
}

TEST(BogackiShampine, KeepsWhatTheRatesKeepAndRefusesWhatIsNotFinite) {
  BogackiShampine method;
  std::vector<double> y{0.3, 0.7};
  const auto exchange = [](std::span<const double> x, std::span<double> f) {
    f[0] = -std::exp(x[0]) * x[0];
    f[1] = -f[0];
  };
  ASSERT_TRUE(method.step(exchange, 0.5, y, anyError, unity));
  EXPECT_NEAR(y[0] + y[1], 1, 4 * std::numeric_limits<double>::epsilon());
  EXPECT_LT(y[0], 0.2);
  const auto broken = [](std::span<const double>, std::span<double> f) { f[0] = f[1] = std::nan(""); };
  EXPECT_FALSE(method.step(broken, 0.5, y, anyError, unity));
}

}  // namespace
}  // namespace lampblack::numerics
