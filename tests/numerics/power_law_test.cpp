// Power laws through points.
#include "numerics/power_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lampblack::numerics {
namespace {

TEST(PowerLaw, ThePowerOfAnExactLawIsFound) {
  const std::vector<double> x{16, 32, 64, 256}, y{3.0 / 16, 3.0 / 32, 3.0 / 64, 3.0 / 256};
  const FittedLine line = fitPowerLaw(x, y);
  EXPECT_NEAR(line.slope, -1.0, 1e-12);  // round-off of four logarithms
  EXPECT_NEAR(line.slopeError, 0.0, 1e-7);
}

TEST(PowerLaw, TheErrorOfASlopeIsThatOfLeastSquares) {
  // log2(y) = 0, 1, 1 at log2(x) = 0, 1, 2: slope 1/2, residuals -1/6, 1/3, -1/6, so s^2 = (1/6) / 1 and the variance
  // of the slope is s^2 / 2 = 1/12.
  const std::vector<double> x{1, 2, 4}, y{1, 2, 2};
  const FittedLine line = fitPowerLaw(x, y);
  EXPECT_NEAR(line.slope, 0.5, 1e-14);
  EXPECT_NEAR(line.slopeError, std::sqrt(1.0 / 12.0), 1e-14);
  // Points where nothing was wrong say nothing about a power.
  const std::vector<double> none{0, 0, 1};
  EXPECT_TRUE(std::isnan(fitPowerLaw(x, none).slope));
}

}  // namespace
}  // namespace lampblack::numerics
