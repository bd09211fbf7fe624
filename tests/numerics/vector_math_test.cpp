#include "numerics/vector_math.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/modules.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::numerics;

// A few units in the last place; the argument's own rounding times |x| is part of the exponential's condition.
TEST(VectorMath, ExponentialAgreesWithTheLibrary) {
  std::vector<double> x, y;
  for (double v = -700; v <= 700; v += 0.0371) x.push_back(v);
  y.resize(x.size());
  vectormath::exp(x.data(), y.data(), x.size());
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) worst = std::max(worst, std::abs(y[i] / std::exp(x[i]) - 1));
  EXPECT_LT(worst, 1e-15);
}

TEST(VectorMath, ExponentialSaturatesInsteadOfOverflowing) {
  for (const double v : {-1e4, -710.0}) EXPECT_LT(vectormath::expOne(v), 1e-300);
  for (const double v : {710.0, 1e4}) {
    EXPECT_GT(vectormath::expOne(v), 1e300);
    EXPECT_TRUE(std::isfinite(vectormath::expOne(v)));
  }
  EXPECT_EQ(vectormath::expOne(0.0), 1.0);
}

TEST(VectorMath, LogarithmAgreesWithTheLibrary) {
  double worst = 0;
  for (double v = 1e-300; v < 1e300; v *= 1.0371) {
    const double exact = std::log(v);
    worst = std::max(worst, std::abs(vectormath::logOne(v) - exact) / std::max(1e-3, std::abs(exact)));
  }
  for (double v = 0.5; v < 2; v += 1e-4)
    worst = std::max(worst, std::abs(vectormath::logOne(v) - std::log(v)) / std::max(1e-3, std::abs(std::log(v))));
  EXPECT_LT(worst, 1e-15);
  EXPECT_EQ(vectormath::logOne(1.0), 0.0);
}

}  // namespace
