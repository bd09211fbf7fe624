// Anderson's acceleration: of a linear iteration in as many steps as there are unknowns, whatever its own pace; values
// of no weight follow.
#include "numerics/anderson_mixing.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

TEST(AndersonMixing, EndsALinearIterationAfterAsManyStepsAsUnknowns) {
  // x -> x + (b - A x): slow along one direction, and growing along another.
  const std::array<std::array<double, 3>, 3> A{{{0.01, 0.002, 0.0}, {0.0, 2.5, 0.1}, {0.3, 0.0, 0.7}}};
  const std::array<double, 3> b{1.0, -2.0, 0.5};
  AndersonMixing mixing(MPI_COMM_SELF, 5);
  const std::vector<double> weights{1.0, 2.0, 0.5, 0.0};
  std::vector<double> x{3.0, 1.0, -1.0, -2.0};  // the last is twice the third
  const auto left = [&](int i) { return b[i] - A[i][0] * x[0] - A[i][1] * x[1] - A[i][2] * x[2]; };
  for (int step = 0; step < 5; ++step) {
    std::vector<double> found = x;
    for (int i = 0; i < 3; ++i) found[static_cast<std::size_t>(i)] += left(i);
    found[3] = 2.0 * found[2];
    mixing.mix(x, found, weights);
    x = found;
    if (step == 0) {
      EXPECT_GT(std::abs(left(1)), 1e-3);
    }
  }
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(left(i), 0.0, 1e-8) << i;
  EXPECT_NEAR(x[3], 2.0 * x[2], 1e-8);
}

}  // namespace
}  // namespace lampblack::test
