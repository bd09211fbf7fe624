// The routines of BLAS and LAPACK that the flame's linear algebra calls, by their Fortran names: column-major matrices,
// everything by address, the lengths of character arguments last.
#pragma once

#include <cstddef>

namespace lampblack::lapack {

extern "C" {
void dgemm_(const char* transA, const char* transB, const int* m, const int* n, const int* k, const double* alpha,
            const double* A, const int* lda, const double* B, const int* ldb, const double* beta, double* C,
            const int* ldc, std::size_t, std::size_t);
void dgemv_(const char* trans, const int* m, const int* n, const double* alpha, const double* A, const int* lda,
            const double* x, const int* incx, const double* beta, double* y, const int* incy, std::size_t);
void dgetrf_(const int* m, const int* n, double* A, const int* lda, int* pivots, int* info);
void dgetrs_(const char* trans, const int* n, const int* nrhs, const double* A, const int* lda, const int* pivots,
             double* B, const int* ldb, int* info, std::size_t);
}

// C -= A B, A being m x k, B k x n, all without gaps between columns.
inline void subtractProduct(std::size_t m, std::size_t n, std::size_t k, const double* A, const double* B, double* C,
                            std::size_t ldc) {
  if (m == 0 || n == 0 || k == 0) return;
  const int im = static_cast<int>(m), in = static_cast<int>(n), ik = static_cast<int>(k), ic = static_cast<int>(ldc);
  const double minus = -1, one = 1;
  dgemm_("N", "N", &im, &in, &ik, &minus, A, &im, B, &ik, &one, C, &ic, 1, 1);
}

// y += alpha A x, A being m x n without gaps between columns.
inline void addProduct(std::size_t m, std::size_t n, double alpha, const double* A, const double* x, double* y) {
  if (m == 0 || n == 0) return;
  const int im = static_cast<int>(m), in = static_cast<int>(n), step = 1;
  const double one = 1;
  dgemv_("N", &im, &in, &alpha, A, &im, x, &step, &one, y, &step, 1);
}

// Factors of the n x n matrix A in its place; false where a pivot is zero or not finite.
[[nodiscard]] bool factorise(std::size_t n, double* A, int* pivots);
// B (n x columns) becomes the solution.
void solve(std::size_t n, const double* A, const int* pivots, std::size_t columns, double* B);

}  // namespace lampblack::lapack
