// Conjugate gradients with the diagonal as preconditioner (Hestenes, Stiefel 1952) for systems whose rows and columns
// carry weights that may vanish: w_i (d_i y_i + sum_j S_ij w_j y_j) = w_i b_i with S symmetric, the whole positive
// definite where weights are positive. All is written with the row's own weight divided out, so that a row without
// weight, which no other row feels, has a solution as well: to rounding, where d_i y_i does not hang on others; else to
// the error of the others.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "numerics/dot.hpp"

namespace lampblack::numerics {

class WeightedConjugateGradients {
 public:
  explicit WeightedConjugateGradients(std::size_t rows) : z_(rows), weighted_(rows), direction_(rows), product_(rows) {}

  // `product(y, out)`: the left-hand side over w_i. `y`: a guess, then the solution; `residual`: b_i minus that of the
  // guess, in and out. Stops where the residual has fallen by `reduction` (in the norm of w/d), or after
  // `mostIterations`, false then.
  template <class Product>
  bool solve(std::span<const double> weight, std::span<const double> inverseDiagonal, Product&& product,
             std::span<double> residual, std::span<double> y, double reduction, int mostIterations) {
    double size = precondition(weight, inverseDiagonal, residual);
    const double enough = reduction * reduction * size;
    direction_ = z_;
    for (int i = 0; size > enough; ++i) {
      if (i == mostIterations || !std::isfinite(size)) return false;
      product(direction_.data(), product_.data());
      for (std::size_t k = 0; k < y.size(); ++k) weighted_[k] = weight[k] * direction_[k];
      const double step = size / dot(weighted_.data(), product_.data(), y.size());
      for (std::size_t k = 0; k < y.size(); ++k) {
        y[k] += step * direction_[k];
        residual[k] -= step * product_[k];
      }
      const double before = size;
      size = precondition(weight, inverseDiagonal, residual);
      const double share = size / before;
      for (std::size_t k = 0; k < y.size(); ++k) direction_[k] = z_[k] + share * direction_[k];
    }
    return true;
  }

 private:
  double precondition(std::span<const double> weight, std::span<const double> inverseDiagonal,
                      std::span<const double> residual) {
    for (std::size_t k = 0; k < z_.size(); ++k) {
      z_[k] = residual[k] * inverseDiagonal[k];
      weighted_[k] = weight[k] * residual[k];
    }
    return dot(weighted_.data(), z_.data(), z_.size());
  }

  std::vector<double> z_, weighted_, direction_, product_;
};

}  // namespace lampblack::numerics
