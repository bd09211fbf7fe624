#include "numerics/dense_blocks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/modules.hpp"

namespace {

using namespace lampblack;
using namespace lampblack::numerics;

std::vector<DenseBlocks> onAllInstructionSets() {
  std::vector<DenseBlocks> all{DenseBlocks(blockTilesGeneric())};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) all.emplace_back(blockTilesAvx2());
  if (__builtin_cpu_supports("avx512f")) all.emplace_back(blockTilesAvx512());
#endif
  return all;
}

struct Random {
  std::mt19937 generator{11};
  std::vector<double> wholeNumbers(std::size_t size) {
    std::uniform_int_distribution<int> number(-9, 9);
    std::vector<double> v(size);
    for (double& x : v) x = number(generator);
    return v;
  }
  std::vector<double> numbers(std::size_t size) {
    std::uniform_real_distribution<double> number(-1, 1);
    std::vector<double> v(size);
    for (double& x : v) x = number(generator);
    return v;
  }
};

// Whole numbers are multiplied and added without rounding: any order of the sums gives the same.
TEST(DenseBlocks, MultiplyWholeNumbersExactly) {
  Random random;
  for (auto& dense : onAllInstructionSets())
    for (const std::size_t m : {1, 3, 8, 17, 31, 56})
      for (const std::size_t n : {1, 2, 7, 16, 33})
        for (const std::size_t k : {1, 9, 24}) {
          const std::size_t lda = m + 1, ldb = k + 2, ldc = m + 3;
          const auto A = random.wholeNumbers(lda * k), B = random.wholeNumbers(ldb * n);
          auto C = random.wholeNumbers(ldc * n), expected = C;
          for (std::size_t j = 0; j < n; ++j)
            for (std::size_t i = 0; i < m; ++i)
              for (std::size_t p = 0; p < k; ++p) expected[j * ldc + i] -= A[p * lda + i] * B[j * ldb + p];
          dense.subtractProduct(m, n, k, A.data(), lda, B.data(), ldb, C.data(), ldc);
          EXPECT_EQ(C, expected) << m << " x " << n << " x " << k;
        }
}

// The residual of a backward stable solution is of the order of n epsilon times the size of the terms (Higham 2002,
// Accuracy and Stability of Numerical Algorithms, theorem 9.4: 3 n epsilon |L||U||x|; growth of random matrices of this
// size is below ten).
TEST(DenseBlocks, SolveRandomSystemsWithAnyNumberOfColumns) {
  Random random;
  for (auto& dense : onAllInstructionSets())
    for (const std::size_t n : {1, 2, 7, 8, 9, 16, 23, 40, 57, 104})
      for (const std::size_t columns : {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{18}, n}) {
        const auto A = random.numbers(n * n), B = random.numbers(n * columns);
        auto factors = A, X = B;
        std::vector<int> pivots(n);
        ASSERT_TRUE(dense.factorise(n, factors.data(), pivots.data()));
        dense.solve(n, factors.data(), pivots.data(), columns, X.data());
        const double bound = 30.0 * static_cast<double>(n) * std::numeric_limits<double>::epsilon();
        for (std::size_t j = 0; j < columns; ++j) {
          double largest = 1;
          for (std::size_t p = 0; p < n; ++p) largest = std::max(largest, std::abs(X[j * n + p]));
          for (std::size_t i = 0; i < n; ++i) {
            double residual = B[j * n + i];
            for (std::size_t p = 0; p < n; ++p) residual -= A[p * n + i] * X[j * n + p];
            EXPECT_LT(std::abs(residual), bound * static_cast<double>(n) * largest) << n << ", " << columns;
          }
        }
      }
}

TEST(DenseBlocks, InvertAsTheySolveADiagonalMatrix) {
  Random random;
  for (auto& dense : onAllInstructionSets())
    for (const std::size_t n : {1, 2, 7, 8, 9, 16, 23, 40, 57}) {
      auto factors = random.numbers(n * n);
      std::vector<double> d(n), X(n * n), inverse(n * n, 1.0);
      std::vector<int> pivots(n);
      ASSERT_TRUE(dense.factorise(n, factors.data(), pivots.data()));
      for (std::size_t i = 0; i < n; ++i)
        X[i * n + i] = d[i] = i % 5 == 4 ? 0 : std::ldexp(i % 3 == 1 ? -1 : 1, static_cast<int>(i % 7));
      if (n > 2)
        dense.solve(n, factors.data(), pivots.data(), n, X.data());
      else
        for (std::size_t j = 0; j < n; ++j) dense.solve(n, factors.data(), pivots.data(), 1, &X[j * n]);
      dense.invert(n, factors.data(), pivots.data(), d.data(), inverse.data());
      for (std::size_t e = 0; e < n * n; ++e)
        EXPECT_NEAR(inverse[e], X[e], 1e-13 * (1 + std::abs(X[e]))) << n << ", " << e;
    }
}

TEST(DenseBlocks, PivotWithTheLargestEntryOfAColumn) {
  // Every pivot is below the diagonal until the last row: the factors are exact.
  for (auto& dense : onAllInstructionSets()) {
    const std::size_t n = 37;
    std::vector<double> A(n * n), b(n);
    for (std::size_t i = 0; i < n; ++i) {
      A[((i + 1) % n) * n + i] = static_cast<double>(std::size_t{1} << (i % 5));
      b[i] = static_cast<double>(i) * A[((i + 1) % n) * n + i];
    }
    std::vector<int> pivots(n);
    ASSERT_TRUE(dense.factorise(n, A.data(), pivots.data()));
    dense.solve(n, A.data(), pivots.data(), 1, b.data());
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(b[(i + 1) % n], static_cast<double>(i));
  }
}

TEST(DenseBlocks, ReportWhatIsSingularOrNotFinite) {
  Random random;
  const std::size_t n = 29;
  std::vector<int> pivots(n);
  for (auto& dense : onAllInstructionSets())
    for (const std::size_t where : {0, 11, 28}) {
      auto zeroColumn = random.numbers(n * n);
      for (std::size_t i = 0; i < n; ++i) zeroColumn[where * n + i] = 0;
      EXPECT_FALSE(dense.factorise(n, zeroColumn.data(), pivots.data()));
      for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        for (const std::size_t row : {0, 13, 28}) {
          auto A = random.numbers(n * n);
          A[where * n + row] = wrong;
          EXPECT_FALSE(dense.factorise(n, A.data(), pivots.data())) << row << ", " << where;
        }
    }
}

TEST(DenseBlocks, AddTheProductWithAVector) {
  Random random;
  for (const std::size_t m : {1, 5, 24})
    for (const std::size_t n : {1, 4, 7, 16}) {
      const auto A = random.wholeNumbers(m * n), x = random.wholeNumbers(n);
      auto y = random.wholeNumbers(m), expected = y;
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < m; ++i) expected[i] -= 2 * A[j * m + i] * x[j];
      addProduct(m, n, -2, A.data(), x.data(), y.data());
      EXPECT_EQ(y, expected);
    }
}

}  // namespace
