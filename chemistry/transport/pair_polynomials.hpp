// A symmetric matrix over pairs of species whose entries are polynomials, M_jk(s) = sum_m a_jkm s^m, and its products
// with vectors. The coefficients fill more than the innermost cache: one pass through those of the lower triangle forms
// every entry in a register and uses it twice.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/modules.hpp"
#include "numerics/lanes.hpp"

namespace lampblack::chemistry {

template <std::size_t Terms>
class PairPolynomials {
 public:
  explicit PairPolynomials(std::size_t n) : ld_(paddedToLanes(n)), a_(start(ld_ / laneCount)) {}

  // The coefficients of M_jk = M_kj.
  void set(std::size_t j, std::size_t k, const std::array<double, Terms>& a) {
    const std::size_t row = std::max(j, k), column = std::min(j, k);
    for (std::size_t m = 0; m < Terms; ++m) {
      a_[index(row, column) + m][row % laneCount] = a[m];
      if (row / laneCount == column / laneCount) a_[index(column, row) + m][column % laneCount] = a[m];
    }
  }

  // M_jk, with s^0..s^(Terms-1) in `powers`.
  double value(std::size_t j, std::size_t k, const double* powers) const {
    const std::size_t row = std::max(j, k), column = std::min(j, k);
    double sum = 0;
    for (std::size_t m = 0; m < Terms; ++m) sum += powers[m] * a_[index(row, column) + m][row % laneCount];
    return sum;
  }

  // products[r] = M x[r]. Vectors and products hold n values and more, finite ones, to whole lanes.
  template <std::size_t Vectors>
  void multiply(const double* powers, const std::array<const double*, Vectors>& x,
                const std::array<double*, Vectors>& products) {
    std::array<Lanes, Terms> s;  // a copy: no store below can change it
    for (std::size_t m = 0; m < Terms; ++m) s[m] = Lanes{} + powers[m];
    transposed_.assign(Vectors * ld_, Lanes{});
    const Lanes* a = a_.data();
    for (std::size_t begin = 0; begin < ld_; begin += laneCount) {
      std::array<Lanes, Vectors> own, sums{};
      for (std::size_t r = 0; r < Vectors; ++r) own[r] = loadLanes(x[r] + begin);
      for (std::size_t k = 0; k < begin; ++k, a += Terms) {
        const Lanes entries = evaluate(a, s);
        for (std::size_t r = 0; r < Vectors; ++r) {
          sums[r] += entries * x[r][k];
          transposed_[r * ld_ + k] += entries * own[r];
        }
      }
      for (std::size_t k = begin; k < begin + laneCount; ++k, a += Terms) {
        const Lanes entries = evaluate(a, s);
        for (std::size_t r = 0; r < Vectors; ++r) sums[r] += entries * x[r][k];
      }
      for (std::size_t r = 0; r < Vectors; ++r) storeLanes(products[r] + begin, sums[r]);
    }
    for (std::size_t r = 0; r < Vectors; ++r)
      for (std::size_t k = 0; k < ld_; k += laneCount)
        storeLanes(products[r] + k, loadLanes(products[r] + k) + sumsOfLanes(&transposed_[r * ld_ + k]));
  }

  // All of M, symmetric, a column a species with its rows rounded up to whole lanes, zero behind the last: `M` is
  // sized.
  void values(const double* powers, std::vector<double>& M) const {
    std::array<Lanes, Terms> s;
    for (std::size_t m = 0; m < Terms; ++m) s[m] = Lanes{} + powers[m];
    M.resize(ld_ * ld_);
    const Lanes* a = a_.data();
    for (std::size_t begin = 0; begin < ld_; begin += laneCount)
      for (std::size_t k = 0; k < begin + laneCount; ++k, a += Terms) {
        const Lanes entries = evaluate(a, s);
        storeLanes(&M[k * ld_ + begin], entries);
        if (k < begin)
          for (std::size_t row = 0; row < laneCount; ++row) M[(begin + row) * ld_ + k] = entries[row];
      }
  }

 private:
  // Where a block of rows starts; it has a column for every species up to its last.
  static std::size_t start(std::size_t block) { return Terms * laneCount * block * (block + 1) / 2; }
  static std::size_t index(std::size_t row, std::size_t column) { return start(row / laneCount) + column * Terms; }

  static Lanes evaluate(const Lanes* a, const std::array<Lanes, Terms>& powers) {
    Lanes sum = a[0] * powers[0];
    for (std::size_t m = 1; m < Terms; ++m) sum += a[m] * powers[m];
    return sum;
  }

  std::size_t ld_;        // species, rounded up
  std::vector<Lanes> a_;  // [block of rows][column][term]
  std::vector<Lanes> transposed_;
};

}  // namespace lampblack::chemistry
