// Eigenvalues of a large matrix that is known by its products only: those on the rim of its spectrum come first.
// Arnoldi's method (Arnoldi 1951; Saad 2011, chapter 6), each new vector orthogonalised twice.
#pragma once

#include <complex>
#include <functional>
#include <span>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::numerics {

struct RitzPair {
  std::complex<double> value;
  double residual = 0;                  // |A v - value v| of the vector of length 1
  std::vector<std::complex<double>> y;  // of the basis
};

class Arnoldi {
 public:
  // Of two vectors, linear in both; the length of one is the root of that with itself, which may be zero for some that
  // others bring with them: values of their vectors that have no part in it are right all the same.
  using Product = std::function<double(std::span<const double>, std::span<const double>)>;
  // `apply` overwrites a vector by its product with the matrix; `start` has a length above zero. `product`: by default
  // the sum of the products of the values.
  Arnoldi(std::function<void(std::vector<double>&)> apply, std::vector<double> start, Product product = {});

  // One more vector. False where the space is complete: the pairs are then exact.
  bool extend();
  [[nodiscard]] std::size_t dimension() const { return columns_.size(); }
  [[nodiscard]] std::vector<RitzPair> pairs() const;
  // Real part of the vector of a pair.
  [[nodiscard]] std::vector<double> vector(const RitzPair& pair) const;

 private:
  std::function<void(std::vector<double>&)> apply_;
  Product product_;
  std::vector<std::vector<double>> basis_;
  std::vector<std::vector<double>> columns_;  // of the Hessenberg matrix, each with the entry below its diagonal
};

}  // namespace lampblack::numerics
