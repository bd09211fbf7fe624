// Least-squares polynomials on fixed abscissae in [-1, 1], by orthogonalising the powers once.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::chemistry {

class PolynomialFit {
 public:
  PolynomialFit(std::span<const double> abscissae, std::size_t terms) : terms_(terms), points_(abscissae.size()) {
    // Gram-Schmidt, twice for orthogonality to round-off: q_m = (x^m - sum_l r_lm q_l)/r_mm
    q_.assign(terms_ * points_, 0.0);
    r_.assign(terms_ * terms_, 0.0);
    for (std::size_t m = 0; m < terms_; ++m) {
      double* q = &q_[m * points_];
      for (std::size_t i = 0; i < points_; ++i) {
        q[i] = 1.0;
        for (std::size_t l = 0; l < m; ++l) q[i] *= abscissae[i];
      }
      for (int pass = 0; pass < 2; ++pass)
        for (std::size_t l = 0; l < m; ++l) {
          const double* other = &q_[l * points_];
          const double projection = dot(q, other);
          r_[l * terms_ + m] += projection;
          for (std::size_t i = 0; i < points_; ++i) q[i] -= projection * other[i];
        }
      const double length = std::sqrt(dot(q, q));
      r_[m * terms_ + m] = length;
      for (std::size_t i = 0; i < points_; ++i) q[i] /= length;
    }
  }

  // Coefficients a_m of sum_m a_m x^m.
  void solve(std::span<const double> values, std::span<double> a) const {
    for (std::size_t m = terms_; m-- > 0;) {
      double sum = dot(values.data(), &q_[m * points_]);
      for (std::size_t l = m + 1; l < terms_; ++l) sum -= r_[m * terms_ + l] * a[l];
      a[m] = sum / r_[m * terms_ + m];
    }
  }

 private:
  double dot(const double* a, const double* b) const {
    double sum = 0;
    for (std::size_t i = 0; i < points_; ++i) sum += a[i] * b[i];
    return sum;
  }

  std::size_t terms_, points_;
  std::vector<double> q_, r_;
};

}  // namespace lampblack::chemistry
