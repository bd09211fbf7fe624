// Products and LU factors of dense blocks of tens to a few hundred rows, with as many right-hand sides: the work of
// block elimination. At these sizes a library's routines spend much of their time on copying and on triangular solves
// (and OpenBLAS of Debian 12 takes a processor that it does not know for one without AVX); here everything runs through
// one kernel of products of tiles, for AVX-512, AVX2 or any processor, chosen when the program runs.
//
// Matrices are column-major. An object holds scratch memory: one a thread.
#pragma once

#include <cstddef>
#include <vector>

#include "core/modules.hpp"
#include "numerics/aligned_vector.hpp"
#include "numerics/block_tile_targets.hpp"

namespace lampblack::numerics {

class DenseBlocks {
 public:
  DenseBlocks();                                  // with the fastest tiles of this processor
  explicit DenseBlocks(const BlockTiles& tiles);  // for tests

  // C (m x n) -= A (m x k) B (k x n).
  void subtractProduct(std::size_t m, std::size_t n, std::size_t k, const double* A, std::size_t lda, const double* B,
                       std::size_t ldb, double* C, std::size_t ldc);
  // Factors of the n x n matrix A in its place, by recursive elimination with partial pivoting (Toledo 1997, SIAM J.
  // Matrix Anal. Appl. 18, 1065); row i was exchanged with pivots[i] >= i. False where a pivot is zero or not finite.
  [[nodiscard]] bool factorise(std::size_t n, double* A, int* pivots);
  // B (n x columns) becomes the solution.
  void solve(std::size_t n, const double* A, const int* pivots, std::size_t columns, double* B);
  // B (n x n) becomes the inverse times diag(d). As L^-1 is a triangle, two thirds of the work of `solve`.
  void invert(std::size_t n, const double* A, const int* pivots, const double* d, double* B);

 private:
  [[nodiscard]] bool factorise(std::size_t m, std::size_t n, double* A, std::size_t ld, int* pivots);
  void solveUnitLower(std::size_t n, const double* L, std::size_t ld, std::size_t columns, double* B, std::size_t ldb);
  void solveUpper(std::size_t n, const double* U, std::size_t ld, std::size_t columns, double* B, std::size_t ldb);
  double* scratch(std::size_t size);

  BlockTiles tiles_;
  AlignedVector scratch_;
  std::vector<int> order_;
};

// Sign of the determinant of a matrix from its factors by DenseBlocks::factorise: 1 or -1.
[[nodiscard]] int determinantSign(std::size_t n, const double* factors, const int* pivots);

// y += alpha A x, A being m x n without gaps between columns.
void addProduct(std::size_t m, std::size_t n, double alpha, const double* A, const double* x, double* y);
// y += A x, A in single precision.
void addProduct(std::size_t m, std::size_t n, const float* A, const double* x, double* y);

}  // namespace lampblack::numerics
