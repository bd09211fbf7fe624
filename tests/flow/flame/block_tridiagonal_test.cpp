// Factors of bordered block-tridiagonal matrices against LAPACK's dense elimination, on all ranks of the
// world and on one.
#include "flow/flame/block_tridiagonal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "core/modules.hpp"

extern "C" void dgesv_(const int* n, const int* columns, double* A, const int* lda, int* pivots, double* B,
                       const int* ldb, int* info);

namespace lampblack::flow {
namespace {

// A dense matrix with the pattern of a bordered block-tridiagonal one, column-major.
struct Pattern {
  std::size_t points, width, border;
  std::size_t size = points * width + border;
  std::vector<double> entries = std::vector<double>(size * size);

  double& operator()(std::size_t i, std::size_t j) { return entries[j * size + i]; }
  [[nodiscard]] double operator()(std::size_t i, std::size_t j) const { return entries[j * size + i]; }
  [[nodiscard]] bool inPattern(std::size_t i, std::size_t j) const {
    const std::size_t a = i / width, b = j / width;
    return a >= points || b >= points || (a > b ? a - b : b - a) <= 1;
  }

  // Entries of either sign up to one; the diagonal outweighs its row, so that rounding is all that elimination adds.
  static Pattern dominant(std::size_t points, std::size_t width, std::size_t border, unsigned seed = 1) {
    Pattern A{points, width, border};
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> entry(-1, 1);
    for (std::size_t i = 0; i < A.size; ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < A.size; ++j)
        if (A.inPattern(i, j)) sum += std::abs(A(i, j) = entry(random));
      A(i, i) = 1.2 * sum;
    }
    return A;
  }

  // Reverses the equations of every point: no diagonal entry is large any more.
  void reverseRowsOfBlocks() {
    for (std::size_t p = 0; p < points; ++p)
      for (std::size_t j = 0; j < size; ++j) {
        double* block = &entries[j * size + p * width];
        std::reverse(block, block + width);
      }
  }

  [[nodiscard]] std::vector<double> times(const std::vector<double>& x) const {
    std::vector<double> y(size);
    for (std::size_t j = 0; j < size; ++j)
      for (std::size_t i = 0; i < size; ++i) y[i] += (*this)(i, j) * x[j];
    return y;
  }

  [[nodiscard]] std::vector<double> denseSolution(std::vector<double> b) const {
    auto factors = entries;
    std::vector<int> pivots(size);
    const int n = static_cast<int>(size), one = 1;
    int info = 0;
    dgesv_(&n, &one, factors.data(), &n, pivots.data(), b.data(), &n, &info);
    EXPECT_EQ(info, 0);
    return b;
  }

  // Of the determinant: exchanges of rows and signs of pivots.
  [[nodiscard]] int denseSign() const {
    auto factors = entries;
    std::vector<double> b(size);
    std::vector<int> pivots(size);
    const int n = static_cast<int>(size), one = 1;
    int info = 0;
    dgesv_(&n, &one, factors.data(), &n, pivots.data(), b.data(), &n, &info);
    EXPECT_EQ(info, 0);
    int sign = 1;
    for (std::size_t i = 0; i < size; ++i) {
      if (pivots[i] != static_cast<int>(i) + 1) sign = -sign;
      if (factors[i * size + i] < 0) sign = -sign;
    }
    return sign;
  }

  void copyBlock(std::size_t i, std::size_t j, std::size_t m, std::size_t n, double* to) const {
    for (std::size_t c = 0; c < n; ++c)
      for (std::size_t r = 0; r < m; ++r) to[c * m + r] = (*this)(i + r, j + c);
  }

  void setTo(BlockTridiagonal& A) const {
    A.clear();
    const std::size_t n = width, ofBorder = points * n;
    for (std::size_t p = A.ownedBegin(); p < A.ownedEnd(); ++p) {
      if (p > 0) copyBlock(p * n, (p - 1) * n, n, n, A.lower(p).entries());
      copyBlock(p * n, p * n, n, n, A.diagonal(p));
      if (p + 1 < points) copyBlock(p * n, (p + 1) * n, n, n, A.upper(p).entries());
      copyBlock(p * n, ofBorder, n, border, A.borderColumns(p));
      copyBlock(ofBorder, p * n, border, n, A.borderRows(p));
    }
    copyBlock(ofBorder, ofBorder, border, border, A.corner());
  }

  [[nodiscard]] BlockTridiagonal on(MPI_Comm comm) const {
    BlockTridiagonal A(comm, points, width, border);
    setTo(A);
    return A;
  }
};

// The same with thin blocks beside the diagonal ones.
struct ThinPattern : Pattern {
  std::size_t terms;
  std::vector<std::vector<double>> lower, upper;  // values of the thin blocks of each point

  ThinPattern(const Pattern& dominantOne, std::size_t numTerms, unsigned seed)
      : Pattern(dominantOne), terms(numTerms), lower(points), upper(points) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> entry(-1, 1);
    for (std::size_t p = 0; p < points; ++p)
      for (auto* side : {&lower, &upper}) {
        if (side == &lower ? p == 0 : p + 1 == points) continue;
        auto& values = (*side)[p];
        values.resize(NeighbourBlock::size(width, terms));
        for (double& value : values) value = entry(random);
        const NeighbourBlock block(width, terms, values.data());
        const std::size_t column = (side == &lower ? p - 1 : p + 1) * width;
        for (std::size_t j = 0; j < width; ++j)
          for (std::size_t i = 0; i < width; ++i) {
            double value = i == j ? block.diagonal()[i] : 0;
            for (std::size_t t = 0; t < terms; ++t) value += block.column(t)[i] * block.row(t, j);
            (*this)(p * width + i, column + j) = value;
          }
      }
    for (std::size_t i = 0; i < size; ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < size; ++j) sum += i == j ? 0 : std::abs((*this)(i, j));
      (*this)(i, i) = 1.2 * (1 + sum);
    }
  }

  [[nodiscard]] BlockTridiagonal on(MPI_Comm comm) const {
    BlockTridiagonal A(comm, points, width, border, terms);
    const std::size_t n = width, ofBorder = points * n;
    for (std::size_t p = A.ownedBegin(); p < A.ownedEnd(); ++p) {
      if (p > 0) std::copy(lower[p].begin(), lower[p].end(), A.lower(p).diagonal());
      copyBlock(p * n, p * n, n, n, A.diagonal(p));
      if (p + 1 < points) std::copy(upper[p].begin(), upper[p].end(), A.upper(p).diagonal());
      copyBlock(p * n, ofBorder, n, border, A.borderColumns(p));
      copyBlock(ofBorder, p * n, border, n, A.borderRows(p));
    }
    copyBlock(ofBorder, ofBorder, border, border, A.corner());
    return A;
  }
};

std::vector<double> randomVector(std::size_t size, unsigned seed = 7) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> entry(-1, 1);
  std::vector<double> v(size);
  for (auto& value : v) value = entry(random);
  return v;
}

template <typename AnyPattern>
std::vector<double> solution(const AnyPattern& pattern, MPI_Comm comm, std::vector<double> b) {
  auto A = pattern.on(comm);
  EXPECT_TRUE(A.factorise());
  A.solve(b);
  return b;
}

double largestDifference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

// Solutions are of size one or less (rows outweighed by their diagonal, b of size one). Rounding of a row's sum is at
// most size * epsilon, and the inverse of such a matrix is bounded by 1.2/0.2 = 6 in the same units.
double rounding(const Pattern& A) {
  return 6.0 * static_cast<double>(A.size) * std::numeric_limits<double>::epsilon();
}

struct Shape {
  std::size_t points, width, border;
};
std::vector<Shape> shapes() {
  std::vector<Shape> all;
  for (const std::size_t points : {1, 2, 3, 4, 17})
    for (const std::size_t width : {1, 5, 12})
      for (const std::size_t border : {0, 1, 3}) all.push_back({points, width, border});
  return all;
}

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
}  // namespace lampblack::flow
