#include "numerics/neighbour_block.hpp"

#include <algorithm>
#include <stdexcept>

namespace lampblack::numerics {

double* NeighbourBlock::entries() const {
  if (terms_) throw std::logic_error("NeighbourBlock: the entries of a thin block are not there");
  return values_;
}

void NeighbourBlock::addTimes(double factor, const double* x, double* y) const {
  if (!terms_) {
    addProduct(width_, width_, factor, values_, x, y);
    return;
  }
  for (std::size_t i = 0; i < width_; ++i) y[i] += factor * values_[i] * x[i];
  std::vector<double> parts(*terms_);
  addProduct(*terms_, width_, factor, rows(), x, parts.data());
  addProduct(width_, *terms_, 1, column(0), parts.data(), y);
}

void NeighbourBlock::subtractProduct(DenseBlocks& dense, std::size_t columns, const double* X, double* C,
                                     std::size_t ldc) const {
  if (!terms_) {
    dense.subtractProduct(width_, columns, width_, values_, width_, X, width_, C, ldc);
    return;
  }
  for (std::size_t j = 0; j < columns; ++j)
    for (std::size_t i = 0; i < width_; ++i) C[j * ldc + i] -= values_[i] * X[j * width_ + i];
  std::vector<double> parts(*terms_ * columns);  // -B X, then B X
  dense.subtractProduct(*terms_, columns, width_, rows(), *terms_, X, width_, parts.data(), *terms_);
  for (double& part : parts) part = -part;
  dense.subtractProduct(width_, columns, *terms_, column(0), width_, parts.data(), *terms_, C, ldc);
}

void NeighbourBlock::multiply(DenseBlocks& dense, const double* W, double* X) const {
  const std::size_t n = width_;
  if (!terms_) {
    std::fill_n(X, n * n, 0.0);
    dense.subtractProduct(n, n, n, W, n, values_, n, X, n);
    for (std::size_t e = 0; e < n * n; ++e) X[e] = -X[e];
    return;
  }
  std::vector<double> product(n * *terms_);  // -W A
  dense.subtractProduct(n, *terms_, n, W, n, column(0), n, product.data(), n);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) X[j * n + i] = W[j * n + i] * values_[j];
  dense.subtractProduct(n, n, *terms_, product.data(), n, rows(), *terms_, X, n);
}

void NeighbourBlock::clearRow(std::size_t row) const {
  if (!terms_) {
    for (std::size_t j = 0; j < width_; ++j) values_[j * width_ + row] = 0;
    return;
  }
  values_[row] = 0;
  for (std::size_t term = 0; term < *terms_; ++term) column(term)[row] = 0;
}

}  // namespace lampblack::numerics
