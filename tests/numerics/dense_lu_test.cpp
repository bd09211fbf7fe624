#include "numerics/dense_lu.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using lampblack::numerics::DenseLu;

// Backward stable: the residual of the solution is of the order of round-off times the size of the numbers.
TEST(DenseLu, SolvesRandomSystemsOfEverySize) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (std::size_t n = 1; n <= 50; ++n) {
    DenseLu lu(n);
    std::vector<double> A(n * n), b(n);
    for (double& a : A) a = uniform(random);
    for (double& v : b) v = uniform(random);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i) lu.column(j)[i] = A[j * n + i];
    ASSERT_TRUE(lu.factorise());
    auto x = b;
    lu.solve(x.data());
    for (std::size_t i = 0; i < n; ++i) {
      double residual = -b[i], size = std::abs(b[i]);
      for (std::size_t j = 0; j < n; ++j) {
        residual += A[j * n + i] * x[j];
        size += std::abs(A[j * n + i] * x[j]);
      }
      EXPECT_LT(std::abs(residual), 1e-12 * size) << "size " << n;
    }
  }
}

TEST(DenseLu, PivotsAndReportsSingularMatrices) {
  DenseLu lu(2);
  const auto set = [&](double a, double b, double c, double d) {
    lu.column(0)[0] = a, lu.column(1)[0] = b, lu.column(0)[1] = c, lu.column(1)[1] = d;
  };
  set(0, 2, 3, 0);
  ASSERT_TRUE(lu.factorise());
  double x[] = {4, 9};
  lu.solve(x);
  EXPECT_DOUBLE_EQ(x[0], 3);
  EXPECT_DOUBLE_EQ(x[1], 2);
  set(1, 2, 2, 4);
  EXPECT_FALSE(lu.factorise());
  set(NAN, 0, 0, 1);
  EXPECT_FALSE(lu.factorise());
}

}  // namespace
