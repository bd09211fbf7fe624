#include "flow/flame/block_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace lampblack::flow {

namespace {

std::size_t wholeLines(std::size_t values) {
  return (values + 7) / 8 * 8;
}

// Tens of megabytes are passed over for every solution: fewer, larger pages. Only a hint.
void preferLargePages([[maybe_unused]] double* begin, [[maybe_unused]] std::size_t bytes) {
#if defined(MADV_HUGEPAGE)
  constexpr std::uintptr_t page = 1U << 21U;
  const auto at = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (at + page - 1) / page * page, end = (at + bytes) / page * page;
  if (first < end) madvise(reinterpret_cast<char*>(begin) + (first - at), end - first, MADV_HUGEPAGE);
#endif
}

bool allFinite(std::size_t size, const double* values) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < size; ++i) wrong += !(std::abs(values[i]) <= std::numeric_limits<double>::max());
  return wrong == 0;
}

}  // namespace

bool rowScales(std::size_t m, std::size_t n, const double* A, double* scale) {
  std::fill_n(scale, m, 0.0);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < m; ++i) scale[i] += std::abs(A[j * m + i]);
  for (std::size_t i = 0; i < m; ++i) {
    if (!(scale[i] > 0) || !std::isfinite(scale[i])) return false;
    scale[i] = std::ldexp(1.0, -std::clamp(std::ilogb(scale[i]), -1000, 1000));
  }
  return true;
}

void multiplyRows(std::size_t m, std::size_t n, const double* scale, double* A) {
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < m; ++i) A[j * m + i] *= scale[i];
}

BlockSweep::BlockSweep(std::size_t rows, std::size_t width, std::size_t border)
    : count_(rows),
      n_(width),
      border_(border),
      stride_(wholeLines(width * width)),
      thinStride_(wholeLines(width * border)),
      rowStride_(3 * stride_ + 2 * thinStride_),
      scale_(rows * width),
      pivots_(rows * width) {
  storage_.reserve(rows * rowStride_);
  preferLargePages(storage_.data(), storage_.capacity() * sizeof(double));
  storage_.resize(rows * rowStride_);
}

void BlockSweep::clear() {
  std::fill(storage_.begin(), storage_.end(), 0.0);
}

bool BlockSweep::scaleRows(std::size_t k) {
  double* scale = scale_.data() + k * n_;
  if (!rowScales(n_, n_, diagonal(k), scale)) return false;
  multiplyRows(n_, n_, scale, diagonal(k));
  multiplyRows(n_, n_, scale, inward(k));
  multiplyRows(n_, border_, scale, columns(k));
  return true;
}

bool BlockSweep::eliminate(std::size_t k, double* corner) {
  if (k > 0) {
    dense_.subtractProduct(n_, n_, n_, outward(k), n_, inward(k - 1), n_, diagonal(k), n_);
    dense_.subtractProduct(n_, border_, n_, outward(k), n_, columns(k - 1), n_, columns(k), n_);
    dense_.subtractProduct(border_, n_, n_, rows(k - 1), border_, inward(k - 1), n_, rows(k), border_);
  }
  int* pivots = pivots_.data() + k * n_;
  if (!scaleRows(k) || !dense_.factorise(n_, diagonal(k), pivots)) return false;
  dense_.solve(n_, diagonal(k), pivots, n_, inward(k));
  dense_.solve(n_, diagonal(k), pivots, border_, columns(k));
  for (std::size_t j = 0; j < border_; ++j)
    addProduct(border_, n_, 1, rows(k), columns(k) + j * n_, corner + j * border_);
  return allFinite(n_ * n_, inward(k)) && allFinite(n_ * border_, columns(k));
}

std::size_t BlockSweep::factorise(double* corner) {
  std::fill_n(corner, border_ * border_, 0.0);
  for (std::size_t k = 0; k < count_; ++k)
    if (!eliminate(k, corner)) return k;
  return count_;
}

int BlockSweep::determinantSign() const {
  int sign = 1;
  for (std::size_t k = 0; k < count_; ++k)
    sign *= chemistry::determinantSign(n_, storage_.data() + k * rowStride_ + stride_, pivots_.data() + k * n_);
  return sign;
}

void BlockSweep::forward(double* b, std::ptrdiff_t step, double* rowSum) {
  std::fill_n(rowSum, border_, 0.0);
  for (std::size_t k = 0; k < count_; ++k, b += step) {
    if (k > 0) addProduct(n_, n_, -1, outward(k), b - step, b);
    multiplyRows(n_, 1, scale_.data() + k * n_, b);
    dense_.solve(n_, diagonal(k), pivots_.data() + k * n_, 1, b);
    addProduct(border_, n_, 1, rows(k), b, rowSum);
  }
}

void BlockSweep::backward(double* y, std::ptrdiff_t step, const double* next, const double* z) {
  if (count_ == 0) return;
  y += static_cast<std::ptrdiff_t>(count_ - 1) * step;
  for (std::size_t k = count_; k-- > 0; next = y, y -= step) {
    addProduct(n_, border_, -1, columns(k), z, y);
    addProduct(n_, n_, -1, inward(k), next, y);
  }
}

}  // namespace lampblack::flow
