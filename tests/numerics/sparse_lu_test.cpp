#include "numerics/sparse_lu.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace {

using lampblack::numerics::AlignedVector;
using lampblack::numerics::SparseLu;

struct Matrix {
  std::size_t n;
  std::vector<SparseLu::Entry> entries;
  std::vector<double> dense;  // by rows
};

// Diagonally dominant by columns, as the Newton matrices of kinetics nearly are, apart from the full border.
Matrix randomMatrix(std::size_t n, std::size_t border, double density, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Matrix matrix{n, {}, std::vector<double>(n * n, 0.0)};
  for (std::size_t j = 0; j < n; ++j) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == j || (i < n - border && j < n - border && uniform(random) > density)) continue;
      matrix.entries.push_back({i, j});
      matrix.dense[i * n + j] = uniform(random) - 0.5;
      sum += std::abs(matrix.dense[i * n + j]);
    }
    matrix.dense[j * n + j] = sum + 0.1;
  }
  return matrix;
}

AlignedVector stored(const Matrix& matrix, const SparseLu& lu, double factor) {
  AlignedVector values(lu.storageSize(), 0.0);
  for (const auto& e : matrix.entries)
    values[lu.position(e.row, e.column)] = matrix.dense[e.row * matrix.n + e.column] * factor;
  return values;
}

// Stable for diagonal dominance: the residual is of the order of round-off times the size of the numbers.
TEST(SparseLu, SolvesRandomSystemsOfEverySizeAndDensity) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (std::size_t n = 1; n <= 60; ++n)
    for (const std::size_t border : {0UL, std::min<std::size_t>(n, 2)})
      for (const double density : {0.0, 0.05, 0.3, 1.0}) {
        const auto matrix = randomMatrix(n, border, density, random);
        SparseLu lu(n, matrix.entries, border);
        std::vector<double> diagonal(n), b(n);
        for (std::size_t i = 0; i < n; ++i) {
          diagonal[i] = matrix.dense[i * n + i];
          b[i] = uniform(random);
        }
        // Twice, as nothing of the first factorisation may be left.
        const auto values = stored(matrix, lu, -2.0);
        for (int round = 0; round < 2; ++round) ASSERT_TRUE(lu.factorise(values, 0.5, diagonal));
        auto x = b;
        lu.solve(x.data());
        for (std::size_t i = 0; i < n; ++i) {
          double residual = -b[i], size = std::abs(b[i]);
          for (std::size_t j = 0; j < n; ++j) {
            residual += matrix.dense[i * n + j] * x[j];
            size += std::abs(matrix.dense[i * n + j] * x[j]);
          }
          EXPECT_LT(std::abs(residual), 1e-13 * size) << "size " << n << " density " << density;
        }
      }
}

// An arrow needs no fill if its shaft goes first: n on the diagonal and the two full lines.
TEST(SparseLu, OrdersTheUnknownsToAvoidFill) {
  const std::size_t n = 40;
  std::vector<SparseLu::Entry> arrow;
  for (std::size_t i = 1; i < n; ++i) {
    arrow.push_back({0, i});
    arrow.push_back({i, 0});
  }
  EXPECT_EQ(SparseLu(n, arrow).numEntries(), 3 * n - 2);
}

TEST(SparseLu, KeepsTheBorderLast) {
  // The border is the sparsest row; were it eliminated first, the last diagonal entry would not stay as given.
  SparseLu lu(3, std::vector<SparseLu::Entry>{{0, 1}, {1, 0}, {0, 2}}, 1);
  EXPECT_EQ(lu.position(2, 2), 2 + 8 * 2);
}

TEST(SparseLu, RefusesWhatWantsPivoting) {
  const std::vector<SparseLu::Entry> full{{0, 1}, {1, 0}};
  const std::vector<double> none{0.0, 0.0};
  const auto factorises = [&](std::size_t border, double a, double b, double c, double d) {
    SparseLu lu(2, full, border);
    AlignedVector values(lu.storageSize(), 0.0);
    values[lu.position(0, 0)] = a, values[lu.position(0, 1)] = b;
    values[lu.position(1, 0)] = c, values[lu.position(1, 1)] = d;
    return lu.factorise(values, -1.0, none);
  };
  EXPECT_TRUE(factorises(0, 1, 2, 3, 4));
  EXPECT_FALSE(factorises(0, 0, 2, 3, 0));
  EXPECT_FALSE(factorises(0, 1, 2, 2, 4));
  EXPECT_FALSE(factorises(0, NAN, 0, 0, 1));
  EXPECT_FALSE(factorises(0, 1e-9, 1, 1, 1));
  // The border may have units, and so a size, of its own.
  EXPECT_TRUE(factorises(1, 1e-9, 1, 1, 1));
}

TEST(SparseLu, AnEntryOutsideThePatternIsABug) {
  SparseLu lu(3, std::vector<SparseLu::Entry>{{0, 1}});
  EXPECT_NO_THROW(lu.position(0, 1));
  EXPECT_THROW(lu.position(1, 0), std::logic_error);
}

}  // namespace
