#include "numerics/block_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace lampblack::numerics {

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

BlockSweep::BlockSweep(std::size_t rows, std::size_t width, std::size_t border, NeighbourTerms terms)
    : count_(rows),
      n_(width),
      border_(border),
      terms_(terms),
      stride_(wholeLines(width * width)),
      thinStride_(wholeLines(width * border)),
      neighbourStride_(wholeLines(NeighbourBlock::size(width, terms))),
      rowStride_(stride_ + 2 * thinStride_ + 2 * neighbourStride_),
      X_(rows > 0 ? width * width : 0),
      scale_(width),
      pivots_(width) {
  storage_.reserve(rows * rowStride_);
  preferLargePages(storage_.data(), storage_.capacity() * sizeof(double));
  storage_.resize(rows * rowStride_);
}

void BlockSweep::clear() {
  std::fill(storage_.begin(), storage_.end(), 0.0);
}

bool BlockSweep::invert(std::size_t k) {
  double *D = diagonal(k), *factors = X_.data();
  if (!rowScales(n_, n_, D, scale_.data())) return false;
  for (std::size_t j = 0; j < n_; ++j)
    for (std::size_t i = 0; i < n_; ++i) factors[j * n_ + i] = scale_[i] * D[j * n_ + i];
  if (!dense_.factorise(n_, factors, pivots_.data())) return false;
  sign_ *= numerics::determinantSign(n_, factors, pivots_.data());
  dense_.invert(n_, factors, pivots_.data(), scale_.data(), D);
  return true;
}

bool BlockSweep::eliminate(std::size_t k, double* corner) {
  if (k > 0) {
    outward(k).subtractProduct(dense_, n_, X_.data(), diagonal(k), n_);
    outward(k).subtractProduct(dense_, border_, columns(k - 1), columns(k), n_);
    dense_.subtractProduct(border_, n_, n_, rows(k - 1), border_, X_.data(), n_, rows(k), border_);
  }
  if (!invert(k)) return false;
  inward(k).multiply(dense_, diagonal(k), X_.data());
  std::vector<double> Y(n_ * border_);
  for (std::size_t j = 0; j < border_; ++j) addProduct(n_, n_, 1, diagonal(k), columns(k) + j * n_, Y.data() + j * n_);
  std::copy(Y.begin(), Y.end(), columns(k));
  for (std::size_t j = 0; j < border_; ++j)
    addProduct(border_, n_, 1, rows(k), columns(k) + j * n_, corner + j * border_);
  return allFinite(n_ * n_, X_.data()) && allFinite(n_ * border_, columns(k));
}

std::size_t BlockSweep::factorise(double* corner) {
  std::fill_n(corner, border_ * border_, 0.0);
  sign_ = 1;
  for (std::size_t k = 0; k < count_; ++k)
    if (!eliminate(k, corner)) return k;
  return count_;
}

void BlockSweep::forward(double* b, std::ptrdiff_t step, double* rowSum, double* last) {
  std::fill_n(rowSum, border_, 0.0);
  for (std::size_t k = 0; k < count_; ++k, b += step) {
    if (k > 0) outward(k).addTimes(-1, last, b);
    std::fill_n(last, n_, 0.0);
    addProduct(n_, n_, 1, diagonal(k), b, last);
    addProduct(border_, n_, 1, rows(k), last, rowSum);
  }
}

void BlockSweep::backward(double* b, std::ptrdiff_t step, const double* next, const double* z) {
  if (count_ == 0) return;
  std::vector<double> x(n_);
  b += static_cast<std::ptrdiff_t>(count_ - 1) * step;
  for (std::size_t k = count_; k-- > 0; next = b, b -= step) {
    inward(k).addTimes(-1, next, b);
    std::fill(x.begin(), x.end(), 0.0);
    addProduct(n_, n_, 1, diagonal(k), b, x.data());
    addProduct(n_, border_, -1, columns(k), z, x.data());
    std::copy(x.begin(), x.end(), b);
  }
}

}  // namespace lampblack::numerics
