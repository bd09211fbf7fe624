#include "numerics/dense_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

namespace lampblack::numerics {

namespace {

constexpr std::size_t pack = 8;  // rows that a tile has at least; also the size of the triangles inverted

BlockTiles bestTiles() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return blockTilesAvx512();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return blockTilesAvx2();
#endif
  return blockTilesGeneric();
}

// Rows of A, at most `packs` times eight, as a tile wants them. Returns what follows them.
double* packRows(std::size_t packs, std::size_t rows, std::size_t k, const double* A, std::size_t lda, double* to) {
  const std::size_t height = packs * pack;
  for (std::size_t j = 0; j < k; ++j, A += lda, to += height) {
    if (rows == height) {
      for (std::size_t i = 0; i < height; i += pack) std::memcpy(to + i, A + i, pack * sizeof(double));
    } else {
      std::copy_n(A, rows, to);
      std::fill_n(to + rows, height - rows, 0.0);
    }
  }
  return to;
}

// C -= A B or C = A B for rows that have been packed.
void multiplyPacked(const BlockTiles& tiles, bool subtract, std::size_t packs, std::size_t rows, std::size_t n,
                    std::size_t k, const double* A, const double* B, std::size_t ldb, double* C, std::size_t ldc) {
  const std::size_t most = tiles.columns[packs - 1];
  for (std::size_t j = 0; j < n; j += most) {
    const std::size_t columns = std::min(most, n - j);
    tiles.tile[packs - 1][columns - 1](subtract, rows, k, A, B + j * ldb, ldb, C + j * ldc, ldc);
  }
}

// Inverse of the unit lower triangle of an m x m block (m <= 8), packed.
void invertUnitLower(std::size_t m, const double* L, std::size_t ld, double* to) {
  std::fill_n(to, m * pack, 0.0);
  for (std::size_t j = 0; j < m; ++j) {
    double* x = to + j * pack;
    x[j] = 1;
    for (std::size_t p = j; p < m; ++p)
      for (std::size_t i = p + 1; i < m; ++i) x[i] -= L[p * ld + i] * x[p];
  }
}

// Inverse of the upper triangle, diagonal included, packed.
void invertUpper(std::size_t m, const double* U, std::size_t ld, double* to) {
  std::fill_n(to, m * pack, 0.0);
  for (std::size_t j = 0; j < m; ++j) {
    double* x = to + j * pack;
    x[j] = 1;
    for (std::size_t p = j + 1; p-- > 0;) {
      x[p] /= U[p * ld + p];
      for (std::size_t i = 0; i < p; ++i) x[i] -= U[p * ld + i] * x[p];
    }
  }
}

void exchangeRows(std::size_t from, std::size_t to, const int* pivots, std::size_t columns, double* B, std::size_t ld) {
  for (std::size_t j = 0; j < columns; ++j, B += ld)
    for (std::size_t i = from; i < to; ++i) std::swap(B[i], B[pivots[i]]);
}

// The same for all rows of many columns: row i takes what was in row order[i].
void reorderRows(std::size_t n, const int* pivots, std::size_t columns, double* B, int* order, double* column) {
  std::iota(order, order + n, 0);
  for (std::size_t i = 0; i < n; ++i) std::swap(order[i], order[pivots[i]]);
  for (std::size_t j = 0; j < columns; ++j, B += n) {
    std::copy_n(B, n, column);
    for (std::size_t i = 0; i < n; ++i) B[i] = column[order[i]];
  }
}

std::size_t largestOf(std::size_t n, const double* x) {
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::abs(x[i]));
  for (std::size_t i = 0; i < n; ++i)
    if (std::abs(x[i]) == largest) return i;
  return 0;
}

// At most eight columns, by plain elimination.
bool factoriseThin(std::size_t m, std::size_t n, double* A, std::size_t ld, int* pivots) {
  for (std::size_t j = 0; j < n; ++j) {
    double* column = A + j * ld;
    const std::size_t p = j + largestOf(m - j, column + j);
    pivots[j] = static_cast<int>(p);
    // What is not finite reaches the pivot of its column, or spreads from there.
    if (column[p] == 0 || !std::isfinite(column[p])) return false;
    if (p != j)
      for (std::size_t c = 0; c < n; ++c) std::swap(A[c * ld + j], A[c * ld + p]);
    const double pivot = column[j];
    for (std::size_t i = j + 1; i < m; ++i) column[i] /= pivot;
    for (std::size_t c = j + 1; c < n; ++c) {
      double* other = A + c * ld;
      const double factor = other[j];
      for (std::size_t i = j + 1; i < m; ++i) other[i] -= factor * column[i];
    }
  }
  return true;
}

// y += alpha A x, the columns of A being ld apart: eight of them for each pass over y.
template <typename Value>
void addColumns(std::size_t m, std::size_t n, double alpha, const Value* A, std::size_t ld, const double* x,
                double* y) {
  std::size_t j = 0;
  for (; j + pack <= n; j += pack, A += pack * ld) {
    double f[pack];
    for (std::size_t c = 0; c < pack; ++c) f[c] = alpha * x[j + c];
    for (std::size_t i = 0; i < m; ++i) {
      const auto a = [&](std::size_t c) { return static_cast<double>(A[c * ld + i]); };
      y[i] += ((f[0] * a(0) + f[1] * a(1)) + (f[2] * a(2) + f[3] * a(3))) +
              ((f[4] * a(4) + f[5] * a(5)) + (f[6] * a(6) + f[7] * a(7)));
    }
  }
  for (; j < n; ++j, A += ld) {
    const double f = alpha * x[j];
    for (std::size_t i = 0; i < m; ++i) y[i] += f * static_cast<double>(A[i]);
  }
}

void solveOne(std::size_t n, const double* A, double* b) {
  for (std::size_t first = 0; first < n; first += pack) {
    const std::size_t end = std::min(first + pack, n);
    for (std::size_t j = first; j < end; ++j)
      for (std::size_t i = j + 1; i < end; ++i) b[i] -= A[j * n + i] * b[j];
    addColumns(n - end, end - first, -1, A + first * n + end, n, b + first, b + end);
  }
  for (std::size_t end = n; end > 0;) {
    const std::size_t first = (end - 1) / pack * pack;
    for (std::size_t j = end; j-- > first;) {
      b[j] /= A[j * n + j];
      for (std::size_t i = first; i < j; ++i) b[i] -= A[j * n + i] * b[j];
    }
    addColumns(first, end - first, -1, A + first * n, n, b + first, b);
    end = first;
  }
}

}  // namespace

DenseBlocks::DenseBlocks() : DenseBlocks(bestTiles()) {}
DenseBlocks::DenseBlocks(const BlockTiles& tiles) : tiles_(tiles) {}

double* DenseBlocks::scratch(std::size_t size) {
  if (scratch_.size() < size) scratch_.resize(size);
  return scratch_.data();
}

void DenseBlocks::subtractProduct(std::size_t m, std::size_t n, std::size_t k, const double* A, std::size_t lda,
                                  const double* B, std::size_t ldb, double* C, std::size_t ldc) {
  if (n == 0 || k == 0) return;
  double* packed = scratch(tiles_.packs * pack * k);
  for (std::size_t i = 0; i < m;) {
    const std::size_t left = (m - i + pack - 1) / pack;
    // Four packs are better divided into two and two than into three and one.
    const std::size_t packs = left == tiles_.packs + 1 && left % 2 == 0 ? left / 2 : std::min(left, tiles_.packs);
    const std::size_t rows = std::min(packs * pack, m - i);
    packRows(packs, rows, k, A + i, lda, packed);
    multiplyPacked(tiles_, true, packs, rows, n, k, packed, B, ldb, C + i, ldc);
    i += rows;
  }
}

void DenseBlocks::solveUnitLower(std::size_t n, const double* L, std::size_t ld, std::size_t columns, double* B,
                                 std::size_t ldb) {
  double* packed = scratch(pack * std::max(n, pack));
  for (std::size_t i = 0; i < n; i += pack) {
    const std::size_t rows = std::min(pack, n - i);
    if (i > 0) {
      packRows(1, rows, i, L + i, ld, packed);
      multiplyPacked(tiles_, true, 1, rows, columns, i, packed, B, ldb, B + i, ldb);
    }
    invertUnitLower(rows, L + i * ld + i, ld, packed);
    multiplyPacked(tiles_, false, 1, rows, columns, rows, packed, B + i, ldb, B + i, ldb);
  }
}

void DenseBlocks::solveUpper(std::size_t n, const double* U, std::size_t ld, std::size_t columns, double* B,
                             std::size_t ldb) {
  double* packed = scratch(pack * std::max(n, pack));
  for (std::size_t i = (n + pack - 1) / pack * pack; i > 0;) {
    i -= pack;
    const std::size_t end = std::min(i + pack, n);
    if (end < n) {
      packRows(1, end - i, n - end, U + end * ld + i, ld, packed);
      multiplyPacked(tiles_, true, 1, end - i, columns, n - end, packed, B + end, ldb, B + i, ldb);
    }
    invertUpper(end - i, U + i * ld + i, ld, packed);
    multiplyPacked(tiles_, false, 1, end - i, columns, end - i, packed, B + i, ldb, B + i, ldb);
  }
}

bool DenseBlocks::factorise(std::size_t m, std::size_t n, double* A, std::size_t ld, int* pivots) {
  if (n <= pack) return factoriseThin(m, n, A, ld, pivots);
  const std::size_t half = (n / 2 + pack - 1) / pack * pack;
  double* right = A + half * ld;
  if (!factorise(m, half, A, ld, pivots)) return false;
  exchangeRows(0, half, pivots, n - half, right, ld);
  solveUnitLower(half, A, ld, n - half, right, ld);
  subtractProduct(m - half, n - half, half, A + half, ld, right, ld, right + half, ld);
  if (!factorise(m - half, n - half, right + half, ld, pivots + half)) return false;
  exchangeRows(0, n - half, pivots + half, half, A + half, ld);
  for (std::size_t i = half; i < n; ++i) pivots[i] += static_cast<int>(half);
  return true;
}

bool DenseBlocks::factorise(std::size_t n, double* A, int* pivots) {
  return factorise(n, n, A, n, pivots);
}

void DenseBlocks::solve(std::size_t n, const double* A, const int* pivots, std::size_t columns, double* B) {
  if (columns < 3) {
    exchangeRows(0, n, pivots, columns, B, n);
    for (std::size_t j = 0; j < columns; ++j) solveOne(n, A, B + j * n);
    return;
  }
  // All packs of rows of L and U with the inverses of their triangles, then few columns of B at a time.
  const std::size_t packs = (n + pack - 1) / pack;
  double* const packed = scratch(packs * pack * (n + 3 * pack));
  order_.resize(n);
  reorderRows(n, pivots, columns, B, order_.data(), packed);
  double* next = packed;
  for (std::size_t i = 0; i < n; i += pack) {
    const std::size_t rows = std::min(pack, n - i);
    next = packRows(1, rows, i, A + i, n, next);
    invertUnitLower(rows, A + i * n + i, n, next);
    next += pack * pack;
  }
  for (std::size_t i = packs * pack; i > 0;) {
    i -= pack;
    const std::size_t end = std::min(i + pack, n);
    next = packRows(1, end - i, n - end, A + end * n + i, n, next);
    invertUpper(end - i, A + i * n + i, n, next);
    next += pack * pack;
  }
  const std::size_t most = tiles_.columns[0];
  for (std::size_t j = 0; j < columns; j += most) {
    const std::size_t width = std::min(most, columns - j);
    const auto tile = tiles_.tile[0][width - 1];
    double* b = B + j * n;
    const double* at = packed;
    for (std::size_t i = 0; i < n; i += pack) {
      const std::size_t rows = std::min(pack, n - i);
      if (i > 0) tile(true, rows, i, at, b, n, b + i, n);
      at += i * pack;
      tile(false, rows, rows, at, b + i, n, b + i, n);
      at += pack * pack;
    }
    for (std::size_t i = packs * pack; i > 0;) {
      i -= pack;
      const std::size_t end = std::min(i + pack, n);
      if (end < n) tile(true, end - i, n - end, at, b + end, n, b + i, n);
      at += (n - end) * pack;
      tile(false, end - i, end - i, at, b + i, n, b + i, n);
      at += pack * pack;
    }
  }
}

void DenseBlocks::invert(std::size_t n, const double* A, const int* pivots, const double* d, double* B) {
  // Columns of L^-1, which are zero above the diagonal, then of U^-1 L^-1, some at a time; blocks of rows so that
  // products of large blocks are most of the work.
  constexpr std::size_t height = 6 * pack, width = 12 * pack;
  order_.resize(n);
  std::iota(order_.begin(), order_.end(), 0);
  for (std::size_t i = 0; i < n; ++i) std::swap(order_[i], order_[pivots[i]]);
  AlignedVector columns(n * std::min(n, width));
  double* const b = columns.data();
  for (std::size_t first = 0; first < n; first += width) {
    const std::size_t count = std::min(width, n - first);
    std::fill_n(b, n * count, 0.0);
    for (std::size_t c = 0; c < count; ++c) b[c * n + first + c] = 1;
    for (std::size_t i = first; i < n; i += height) {
      const std::size_t rows = std::min(height, n - i);
      subtractProduct(rows, count, i - first, A + first * n + i, n, b + first, n, b + i, n);
      solveUnitLower(rows, A + i * n + i, n, count, b + i, n);
    }
    for (std::size_t i = (n + height - 1) / height * height; i > 0;) {
      i -= height;
      const std::size_t end = std::min(i + height, n);
      subtractProduct(end - i, count, n - end, A + end * n + i, n, b + end, n, b + i, n);
      solveUpper(end - i, A + i * n + i, n, count, b + i, n);
    }
    // Row i of L U is row order[i] of A.
    for (std::size_t c = 0; c < count; ++c) {
      const auto column = static_cast<std::size_t>(order_[first + c]);
      for (std::size_t i = 0; i < n; ++i) B[column * n + i] = b[c * n + i] * d[column];
    }
  }
}

int determinantSign(std::size_t n, const double* factors, const int* pivots) {
  bool negative = false;
  for (std::size_t i = 0; i < n; ++i)
    negative ^= (factors[i * n + i] < 0) != (static_cast<std::size_t>(pivots[i]) != i);
  return negative ? -1 : 1;
}

void addProduct(std::size_t m, std::size_t n, double alpha, const double* A, const double* x, double* y) {
  addColumns(m, n, alpha, A, m, x, y);
}

void addProduct(std::size_t m, std::size_t n, const float* A, const double* x, double* y) {
  addColumns(m, n, 1.0, A, m, x, y);
}

}  // namespace lampblack::numerics
