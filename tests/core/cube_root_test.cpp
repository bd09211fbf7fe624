#include "core/cube_root.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace lampblack {
namespace {

TEST(CubeRoot, IsThatOfTheLibraryToFourUnitsInTheLastPlace) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> exponent(-289.0, 289.0), mantissa(1.0, 8.0);
  double worst = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const double x =
        (i % 2 == 0 ? 1.0 : -1.0) * mantissa(random) * (i % 3 == 0 ? 1.0 : std::pow(10.0, exponent(random)));
    worst = std::max(worst, std::abs(cubeRoot(x) / std::cbrt(x) - 1.0));
  }
  EXPECT_LE(worst, 4.0 * std::numeric_limits<double>::epsilon());
}

TEST(CubeRoot, TakesEveryNumber) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(cubeRoot(0.0), 0.0);
  EXPECT_EQ(cubeRoot(infinity), infinity);
  EXPECT_EQ(cubeRoot(-infinity), -infinity);
  EXPECT_TRUE(std::isnan(cubeRoot(std::nan(""))));
  EXPECT_DOUBLE_EQ(cubeRoot(5e-324), std::cbrt(5e-324));  // the compiler and the library may differ in the last place
  EXPECT_DOUBLE_EQ(cubeRoot(1e-30), 1e-10);
  EXPECT_DOUBLE_EQ(cubeRoot(27.0), 3.0);
}

}  // namespace
}  // namespace lampblack
