#include "numerics/elimination.hpp"

#include <cstdint>

namespace lampblack::numerics {

Elimination::Elimination(std::size_t n, std::span<const MatrixEntry> entries, std::size_t border)
    : inner(n - border), place(n, 0), matrix(n, std::vector<char>(n, 0)) {
  for (std::size_t i = 0; i < n; ++i) matrix[i][i] = 1;
  for (const auto& entry : entries) matrix[entry.row][entry.column] = 1;
  factors = matrix;
  std::vector<char> done(n, 0);
  for (std::size_t step = 0; step < n; ++step) {
    std::size_t pivot = step, least = SIZE_MAX;  // the border in its own order
    for (std::size_t k = 0; step < inner && k < inner; ++k) {
      if (done[k] != 0) continue;
      std::size_t inRow = 0, inColumn = 0;
      for (std::size_t i = 0; i < n; ++i) {
        if (done[i] != 0 || i == k) continue;
        inRow += factors[k][i] != 0;
        inColumn += factors[i][k] != 0;
      }
      if (inRow * inColumn < least) {
        least = inRow * inColumn;
        pivot = k;
      }
    }
    done[pivot] = 1;
    place[pivot] = step;
    unknown.push_back(pivot);
    for (std::size_t i = 0; i < n; ++i) {
      if (done[i] != 0 || factors[i][pivot] == 0) continue;
      for (std::size_t j = 0; j < n; ++j)
        if (done[j] == 0 && factors[pivot][j] != 0) factors[i][j] = 1;
    }
  }
}

}  // namespace lampblack::numerics
