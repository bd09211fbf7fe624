// LU factors of a small dense matrix (tens to a few hundred unknowns), for the Newton steps of the stiff integrator. At
// these sizes a plain right-looking elimination over padded, aligned columns beats calls to a general library.
#pragma once

#include <cstddef>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::numerics {

class DenseLu {
 public:
  explicit DenseLu(std::size_t n);

  std::size_t size() const { return n_; }
  // Columns are stored leadingDimension() apart; the rows beyond size() are padding and stay zero.
  std::size_t leadingDimension() const { return ld_; }
  double* column(std::size_t j) { return data_ + j * ld_; }

  // Factorises what the columns hold, with threshold pivoting (a diagonal entry of at least a tenth of its column's
  // largest is kept). Returns false if the matrix is singular or not finite.
  bool factorise();
  // Overwrites b (size() values) with the solution.
  void solve(double* b);

 private:
  std::size_t n_ = 0;
  std::size_t ld_ = 0;
  std::vector<double> storage_;
  double* data_ = nullptr;  // 64-byte aligned, inside storage_
  double* multipliers_ = nullptr;
  double* rightHandSide_ = nullptr;
  std::vector<std::size_t> pivots_;
  std::vector<double> inverseDiagonal_;
};

}  // namespace lampblack::numerics
