// A block beside the diagonal of a block-tridiagonal matrix: dense, or thin, which is a diagonal matrix and a product
// of few columns and rows,
//
//   diag(d) + A B,   A: width x terms, B: terms x width.
//
// Neighbours in a flame with mixture-averaged diffusion see each other so: every species itself, and all of them
// through the mean weight, the correction of the fluxes, the temperature and the mass flux.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/modules.hpp"
#include "numerics/dense_blocks.hpp"

namespace lampblack::numerics {

// How many terms a thin block has; without a number blocks are dense.
using NeighbourTerms = std::optional<std::size_t>;

// A view of values that somebody else keeps.
class NeighbourBlock {
 public:
  NeighbourBlock(std::size_t width, NeighbourTerms terms, double* values)
      : width_(width), terms_(terms), values_(values) {}
  // How many values a block has.
  [[nodiscard]] static std::size_t size(std::size_t width, NeighbourTerms terms) {
    return terms ? width * (1 + 2 * *terms) : width * width;
  }

  [[nodiscard]] bool isDense() const { return !terms_; }
  // All entries of a dense block, column-major; std::logic_error for a thin one.
  [[nodiscard]] double* entries() const;
  // Of a thin block: d, a column of A, an entry of B.
  [[nodiscard]] double* diagonal() const { return values_; }
  [[nodiscard]] double* column(std::size_t term) const { return values_ + (1 + term) * width_; }
  [[nodiscard]] double& row(std::size_t term, std::size_t j) const {
    return values_[(1 + *terms_) * width_ + j * *terms_ + term];
  }

  // y += factor block x.
  void addTimes(double factor, const double* x, double* y) const;
  // C -= block X; X (width x columns) without gaps, columns of C `ldc` apart.
  void subtractProduct(DenseBlocks& dense, std::size_t columns, const double* X, double* C, std::size_t ldc) const;
  // X = W block, both width x width.
  void multiply(DenseBlocks& dense, const double* W, double* X) const;
  // Sets a row to zero.
  void clearRow(std::size_t row) const;

 private:
  [[nodiscard]] const double* rows() const { return values_ + (1 + *terms_) * width_; }

  std::size_t width_;
  NeighbourTerms terms_;
  double* values_;
};

}  // namespace lampblack::numerics
