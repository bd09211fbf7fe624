// Bordered block-tridiagonal matrices of tests, dense or with thin blocks, and their solutions by LAPACK's dense
// elimination.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "core/modules.hpp"
#include "numerics/block_tridiagonal.hpp"

extern "C" void dgesv_(const int* n, const int* columns, double* A, const int* lda, int* pivots, double* B,
                       const int* ldb, int* info);

namespace lampblack::numerics::test_blocks {

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

inline std::vector<double> randomVector(std::size_t size, unsigned seed = 7) {
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

inline double largestDifference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

// Solutions are of size one or less (rows outweighed by their diagonal, b of size one). Rounding of a row's sum is at
// most size * epsilon, and the inverse of such a matrix is bounded by 1.2/0.2 = 6 in the same units.
inline double rounding(const Pattern& A) {
  return 6.0 * static_cast<double>(A.size) * std::numeric_limits<double>::epsilon();
}

struct Shape {
  std::size_t points, width, border;
};
inline std::vector<Shape> shapes() {
  std::vector<Shape> all;
  for (const std::size_t points : {1, 2, 3, 4, 17})
    for (const std::size_t width : {1, 5, 12})
      for (const std::size_t border : {0, 1, 3}) all.push_back({points, width, border});
  return all;
}

}  // namespace lampblack::numerics::test_blocks
