// Factors of bordered block-tridiagonal matrices against LAPACK's dense elimination, on all ranks of the
// world and on one.
#include "numerics/block_tridiagonal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "core/modules.hpp"
#include "tests/numerics/block_patterns.hpp"

namespace lampblack::numerics {
namespace {

using test_blocks::largestDifference;
using test_blocks::Pattern;
using test_blocks::randomVector;
using test_blocks::rounding;
using test_blocks::shapes;
using test_blocks::solution;
using test_blocks::ThinPattern;

TEST(BlockTridiagonalFactors, SolveWhatDenseEliminationSolves) {
  for (const auto& [points, width, border] : shapes()) {
    SCOPED_TRACE(testing::Message() << points << " points, " << width << " wide, border " << border);
    const auto A = Pattern::dominant(points, width, border);
    const auto b = randomVector(A.size);
    EXPECT_LT(largestDifference(solution(A, MPI_COMM_WORLD, b), A.denseSolution(b)), rounding(A));
  }
}

TEST(BlockTridiagonalFactors, OfThinBlocksSolveWhatDenseEliminationSolves) {
  for (const auto& [points, width, border] : shapes())
    for (const std::size_t terms : {0, 1, 3}) {
      SCOPED_TRACE(testing::Message() << points << " points, " << width << " wide, border " << border << ", " << terms);
      const ThinPattern A(Pattern::dominant(points, width, border), terms, 4);
      const auto b = randomVector(A.size);
      const auto found = solution(A, MPI_COMM_WORLD, b);
      EXPECT_LT(largestDifference(found, A.denseSolution(b)), rounding(A));
      EXPECT_EQ(found, solution(A, MPI_COMM_SELF, b));
      std::vector<double> y(A.size);
      A.on(MPI_COMM_WORLD).multiply(b, y);
      EXPECT_LT(largestDifference(y, A.times(b)), 1.2 * static_cast<double>(A.size) * rounding(A));
      auto factors = A.on(MPI_COMM_WORLD);
      ASSERT_TRUE(factors.factorise());
      EXPECT_EQ(factors.determinantSign(), A.denseSign());
    }
}

TEST(BlockTridiagonalFactors, OfThinBlocksRefuseWhatIsNotFinite) {
  const double wrong = std::numeric_limits<double>::quiet_NaN();
  const ThinPattern good(Pattern::dominant(7, 4, 2), 2, 4);
  for (const std::size_t point : {1, 3, 5})
    for (const std::size_t value : {1, 6, 14}) {
      auto pattern = good;
      pattern.upper[point][value] = wrong;
      EXPECT_FALSE(pattern.on(MPI_COMM_WORLD).factorise()) << point << ", " << value;
    }
}

TEST(BlockTridiagonalFactors, OfThinBlocksHaveNoDenseEntries) {
  auto A = ThinPattern(Pattern::dominant(3, 4, 1), 2, 4).on(MPI_COMM_SELF);
  EXPECT_THROW((void)A.lower(1).entries(), std::logic_error);
  const std::vector<double> x = randomVector(A.size());
  std::vector<double> y(A.size());
  A.lower(1).clearRow(2);
  A.multiply(x, y);
  const std::size_t row = 4 + 2;  // the third equation of the second point
  double expected = 0;
  for (std::size_t j = 0; j < 4; ++j) expected += A.diagonal(1)[j * 4 + 2] * x[4 + j];
  std::vector<double> ofUpper(4);
  A.upper(1).addTimes(1, &x[8], ofUpper.data());
  expected += ofUpper[2] + A.borderColumns(1)[2] * x[12];
  EXPECT_NEAR(y[row], expected, 1e-13 * std::abs(expected));
}

TEST(BlockTridiagonalFactors, SolveBlocksThatNeedPivoting) {
  for (const auto& [points, width, border] : shapes()) {
    SCOPED_TRACE(testing::Message() << points << " points, " << width << " wide, border " << border);
    auto A = Pattern::dominant(points, width, border);
    A.reverseRowsOfBlocks();
    for (std::size_t i = 0; i < points * width; ++i)
      if (width > 1 && 2 * (i % width) + 1 != width) A(i, i) = 0;
    const auto b = randomVector(A.size);
    EXPECT_LT(largestDifference(solution(A, MPI_COMM_WORLD, b), A.denseSolution(b)), rounding(A));
  }
}

TEST(BlockTridiagonalFactors, KnowTheSignOfTheDeterminant) {
  int negative = 0, all = 0;
  for (const auto& [points, width, border] : shapes())
    for (const unsigned seed : {1, 2, 3}) {
      auto pattern = Pattern::dominant(points, width, border, seed);
      if (seed > 1) pattern.reverseRowsOfBlocks();
      // Of either sign: diagonals of either sign, rows exchanged or not.
      std::mt19937 random(seed);
      for (std::size_t i = 0; i < pattern.size; ++i)
        if (random() % 2 == 0)
          for (std::size_t j = 0; j < pattern.size; ++j) pattern(i, j) = -pattern(i, j);
      auto A = pattern.on(MPI_COMM_WORLD);
      EXPECT_THROW((void)A.determinantSign(), std::logic_error);
      ASSERT_TRUE(A.factorise());
      EXPECT_EQ(A.determinantSign(), pattern.denseSign()) << points << " points, " << width << " wide, " << border;
      const int sign = A.determinantSign();
      pattern.setTo(A);
      ASSERT_TRUE(A.factorise());
      EXPECT_EQ(A.determinantSign(), sign) << "a second time";
      negative += A.determinantSign() < 0;
      ++all;
    }
  EXPECT_GT(negative, all / 4);
  EXPECT_LT(negative, 3 * all / 4);
}

TEST(BlockTridiagonalFactors, HaveTheSameBitsOnOneRankAndOnAll) {
  for (const auto& [points, width, border] : shapes()) {
    SCOPED_TRACE(testing::Message() << points << " points, " << width << " wide, border " << border);
    const auto A = Pattern::dominant(points, width, border);
    const auto b = randomVector(A.size);
    EXPECT_EQ(solution(A, MPI_COMM_WORLD, b), solution(A, MPI_COMM_SELF, b));
  }
}

TEST(BlockTridiagonalFactors, HaveTheSameBitsOnAllRanksForWideBlocks) {
  for (const std::size_t width : {61, 104, 105}) {
    const auto A = Pattern::dominant(5, width, 3);
    const auto b = randomVector(A.size);
    EXPECT_EQ(solution(A, MPI_COMM_WORLD, b), solution(A, MPI_COMM_SELF, b)) << width;
  }
}

// Scaling by powers of two rounds nothing, so the solution keeps its bits however the equations are scaled.
TEST(BlockTridiagonalFactors, DoNotDependOnTheUnitsOfEquations) {
  const auto A = Pattern::dominant(9, 7, 2);
  auto scaled = A;
  const auto b = randomVector(A.size);
  auto scaledB = b;
  std::mt19937 random(3);
  std::uniform_int_distribution<int> power(-60, 60);
  for (std::size_t i = 0; i < A.size; ++i) {
    const double factor = std::ldexp(1.0, power(random));
    scaledB[i] *= factor;
    for (std::size_t j = 0; j < A.size; ++j) scaled(i, j) *= factor;
  }
  EXPECT_EQ(solution(scaled, MPI_COMM_WORLD, scaledB), solution(A, MPI_COMM_WORLD, b));
}

// Rows of very different size that no power of two was put into: small in every equation by itself. Of a computed
// solution |b - A x| <= (about size) epsilon |A| |x| may be asked row by row only where rows are scaled before
// pivoting.
TEST(BlockTridiagonalFactors, SolveEveryEquationHoweverSmall) {
  auto A = Pattern::dominant(9, 7, 2);
  A.reverseRowsOfBlocks();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> power(-12, 12);
  for (std::size_t i = 0; i < A.size; ++i) {
    const double factor = std::pow(10.0, power(random));
    for (std::size_t j = 0; j < A.size; ++j) A(i, j) *= factor;
  }
  const auto x = randomVector(A.size);
  const auto b = A.times(x);
  const auto found = solution(A, MPI_COMM_WORLD, b);
  EXPECT_LT(largestDifference(found, x), rounding(A));
}

// Second differences without boundary values in the first unknown of every point: constants are in the null space, and
// elimination, exact in whole numbers, finds a zero pivot in the middle. So it is at the turning point of a flame.
Pattern singularWithoutItsBorder(std::size_t border) {
  Pattern A{5, 3, border};
  for (std::size_t p = 0; p < 5; ++p)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = 3 * p + k;
      A(i, i) = k > 0 ? 1 : 0;
      if (p > 0) A(i, i) += 1, A(i, i - 3) = -1;
      if (p < 4) A(i, i) += 1, A(i, i + 3) = -1;
      if (border > 0) A(i, 15) = A(15, i) = 1;
    }
  return A;
}

TEST(BlockTridiagonalFactors, SolveAMatrixThatIsSingularWithoutItsBorder) {
  EXPECT_FALSE(singularWithoutItsBorder(0).on(MPI_COMM_WORLD).factorise());
  const auto A = singularWithoutItsBorder(1);
  const auto b = randomVector(A.size);
  // The smallest eigenvalue of the differences is 4 sin(pi/10)^2 = 0.38, the border's about sqrt(15): as well posed as
  // the dominant matrices.
  EXPECT_LT(largestDifference(solution(A, MPI_COMM_WORLD, b), A.denseSolution(b)), 10 * rounding(A));
}

TEST(BlockTridiagonalFactors, SayOnAllRanksWhichPointIsSingular) {
  for (const std::size_t point : {0, 2, 4, 5, 8}) {
    auto pattern = Pattern::dominant(9, 4, 2);
    // The first equation of the point vanishes: its row is zero.
    for (std::size_t j = 0; j < pattern.size; ++j) pattern(point * 4, j) = 0;
    auto A = pattern.on(MPI_COMM_WORLD);
    EXPECT_FALSE(A.factorise());
    EXPECT_EQ(A.singularPoint(), point);
    std::vector<double> b(A.size());
    EXPECT_THROW(A.solve(b), std::logic_error);
    // Usable again.
    const auto good = Pattern::dominant(9, 4, 2);
    good.setTo(A);
    EXPECT_TRUE(A.factorise());
  }
}

TEST(BlockTridiagonalFactors, RefuseWhatIsNotFinite) {
  for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const std::size_t where : {0, 4, 14, 35, 37}) {
      for (const std::size_t column : {where, where < 34 ? where + 4 : where - 4, std::size_t{36}}) {
        auto pattern = Pattern::dominant(9, 4, 2);
        pattern(where, column) = wrong;
        EXPECT_FALSE(pattern.on(MPI_COMM_WORLD).factorise()) << where << ", " << column;
      }
    }
}

TEST(BlockTridiagonalMatrix, MultipliesAsTheDenseMatrix) {
  for (const auto& [points, width, border] : shapes()) {
    const auto A = Pattern::dominant(points, width, border);
    const auto x = randomVector(A.size);
    std::vector<double> y(A.size);
    A.on(MPI_COMM_WORLD).multiply(x, y);
    // Entries of the diagonal, the largest, are below 1.2 * size.
    EXPECT_LT(largestDifference(y, A.times(x)), 1.2 * static_cast<double>(A.size) * rounding(A));
  }
}

TEST(BlockTridiagonalMatrix, IsZeroAtFirstAndOnceCleared) {
  const auto pattern = Pattern::dominant(4, 3, 2);
  BlockTridiagonal A(MPI_COMM_WORLD, 4, 3, 2);
  const auto x = randomVector(A.size());
  std::vector<double> y(A.size(), 1.0);
  const std::vector<double> zero(A.size());
  A.clear();
  A.multiply(x, y);
  EXPECT_EQ(y, zero);
  A.corner()[0] = 1;
  A.clear();
  A.multiply(x, y);
  EXPECT_EQ(y, zero);
  pattern.setTo(A);
  ASSERT_TRUE(A.factorise());
  A.clear();
  A.multiply(x, y);
  EXPECT_EQ(y, zero);
}

TEST(BlockTridiagonalMatrix, GivesEachRowToOneRank) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  for (const std::size_t points : {1, 2, 3, 8}) {
    const BlockTridiagonal A(MPI_COMM_WORLD, points, 3, 1);
    std::vector<int> owners(points);
    for (std::size_t p = A.ownedBegin(); p < A.ownedEnd(); ++p) ++owners[p];
    MPI_Allreduce(MPI_IN_PLACE, owners.data(), static_cast<int>(points), MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_EQ(owners, std::vector<int>(points, 1));
    if (rank > 1) {
      EXPECT_EQ(A.ownedBegin(), A.ownedEnd());
    }
  }
}

TEST(BlockTridiagonalMatrix, RefusesWrongUse) {
  auto A = Pattern::dominant(3, 2, 1).on(MPI_COMM_SELF);
  std::vector<double> x(A.size()), tooShort(2);
  EXPECT_THROW((void)A.lower(0), std::logic_error);
  EXPECT_THROW((void)A.upper(2), std::logic_error);
  EXPECT_THROW((void)A.diagonal(3), std::logic_error);
  EXPECT_THROW(A.solve(x), std::logic_error);
  ASSERT_TRUE(A.factorise());
  EXPECT_THROW((void)A.diagonal(0), std::logic_error);
  EXPECT_THROW((void)A.factorise(), std::logic_error);
  EXPECT_THROW(A.multiply(x, x), std::logic_error);
  EXPECT_THROW(A.solve(tooShort), std::logic_error);
}

}  // namespace
}  // namespace lampblack::numerics
