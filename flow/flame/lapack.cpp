#include "flow/flame/lapack.hpp"

#include <cmath>

namespace lampblack::lapack {

bool factorise(std::size_t n, double* A, int* pivots) {
  const int in = static_cast<int>(n);
  int info = 0;
  dgetrf_(&in, &in, A, &in, pivots, &info);
  if (info != 0) return false;
  // An entry that is not finite spreads down its column to the diagonal.
  for (std::size_t i = 0; i < n; ++i)
    if (!std::isfinite(A[i * (n + 1)])) return false;
  return true;
}

void solve(std::size_t n, const double* A, const int* pivots, std::size_t columns, double* B) {
  if (columns == 0) return;
  const int in = static_cast<int>(n), right = static_cast<int>(columns);
  int info = 0;
  dgetrs_("N", &in, &right, A, &in, pivots, B, &in, &info, 1);
}

}  // namespace lampblack::lapack
