#include "numerics/dense_lu.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

namespace lampblack::numerics {

namespace {

constexpr std::size_t kWidth = 8;  // doubles in a cache line

// y -= a x on whole cache lines
inline void subtractScaled(double* __restrict y, const double* __restrict x, double a, std::size_t begin,
                           std::size_t end) {
  for (std::size_t block = begin; block < end; block += kWidth)
    for (std::size_t i = 0; i < kWidth; ++i) y[block + i] -= a * x[block + i];
}

}  // namespace

DenseLu::DenseLu(std::size_t n)
    : n_(n),
      ld_((n + kWidth - 1) / kWidth * kWidth),
      storage_((n + 2) * ld_ + kWidth, 0.0),
      pivots_(n),
      inverseDiagonal_(n) {
  const auto address = reinterpret_cast<std::uintptr_t>(storage_.data());
  const auto skip = (64 - address % 64) % 64 / sizeof(double);
  data_ = storage_.data() + skip;
  multipliers_ = data_ + n_ * ld_;
  rightHandSide_ = multipliers_ + ld_;
}

bool DenseLu::factorise() {
  for (std::size_t k = 0; k < n_; ++k) {
    double* pivotColumn = column(k);
    double largest = 0;
    std::size_t row = k;
    for (std::size_t i = k; i < n_; ++i) {
      const double size = std::abs(pivotColumn[i]);
      if (!(size <= largest)) {
        largest = size;
        row = i;
      }
    }
    if (!(largest > 0) || !std::isfinite(largest)) return false;
    if (std::abs(pivotColumn[k]) >= 0.1 * largest) row = k;
    pivots_[k] = row;
    if (row != k)
      for (std::size_t j = 0; j < n_; ++j) std::swap(data_[j * ld_ + k], data_[j * ld_ + row]);
    const double inverse = 1.0 / pivotColumn[k];
    inverseDiagonal_[k] = inverse;
    // Multipliers padded with zeros to whole cache lines, so that the update below needs no special ends.
    const std::size_t begin = (k + 1) / kWidth * kWidth;
    for (std::size_t i = begin; i <= k && i < ld_; ++i) multipliers_[i] = 0;
    for (std::size_t i = k + 1; i < n_; ++i) multipliers_[i] = pivotColumn[i] *= inverse;
    for (std::size_t j = k + 1; j < n_; ++j) {
      double* other = column(j);
      if (other[k] != 0) subtractScaled(other, multipliers_, other[k], begin, ld_);
    }
  }
  return true;
}

void DenseLu::solve(double* b) {
  double* x = rightHandSide_;
  for (std::size_t i = 0; i < n_; ++i) x[i] = b[i];
  for (std::size_t k = 0; k < n_; ++k)
    if (pivots_[k] != k) std::swap(x[k], x[pivots_[k]]);
  for (std::size_t k = 0; k < n_; ++k) {
    const double* l = column(k);
    const double value = x[k];
    const std::size_t line = (k / kWidth + 1) * kWidth;
    for (std::size_t i = k + 1; i < line && i < n_; ++i) x[i] -= value * l[i];
    subtractScaled(x, l, value, line, ld_);
  }
  for (std::size_t k = n_; k-- > 0;) {
    const double* u = column(k);
    const double value = x[k] * inverseDiagonal_[k];
    x[k] = value;
    const std::size_t line = k / kWidth * kWidth;
    subtractScaled(x, u, value, 0, line);
    for (std::size_t i = line; i < k; ++i) x[i] -= value * u[i];
  }
  for (std::size_t i = 0; i < n_; ++i) b[i] = x[i];
}

}  // namespace lampblack::numerics
