#include "flow/discretisation/row_gradient.hpp"

#include <algorithm>

namespace lampblack::flow {

void RowGradient::prepare(std::span<const double> values, std::span<const double> boundary,
                          std::span<const BoundaryData> known) {
  const Mesh& m = context_.mesh;
  values_ = values;
  boundary_ = boundary;
  known_ = known;
  const auto n = static_cast<std::size_t>(fields_);
  const std::size_t all = n * static_cast<std::size_t>(m.dimension);
  halo_.resize(static_cast<std::size_t>(m.cells - m.owned) * all);
  context_.halo.exchange(
      static_cast<int>(all),
      [&](int cell, double* out) {
        for (std::size_t axis = 0; axis < static_cast<std::size_t>(m.dimension); ++axis) {
          Vector3 direction{};
          direction[axis] = 1.0;
          gradient_.along(direction, cell, values_, boundary_, fields_, {out + axis * n, n}, known_);
        }
      },
      [&](int cell, const double* in) {
        std::copy_n(in, all, &halo_[static_cast<std::size_t>(cell - m.owned) * all]);
      });
}

void RowGradient::along(const Vector3& direction, int cell, std::span<double> slope) const {
  const Mesh& m = context_.mesh;
  if (cell < m.owned) {
    gradient_.along(direction, cell, values_, boundary_, fields_, slope, known_);
    return;
  }
  const auto n = static_cast<std::size_t>(fields_);
  std::fill_n(slope.begin(), n, 0.0);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(m.dimension); ++axis) {
    if (direction[axis] == 0.0) continue;
    const double* along = &halo_[(static_cast<std::size_t>(cell - m.owned) * m.dimension + axis) * n];
    for (std::size_t k = 0; k < n; ++k) slope[k] += direction[axis] * along[k];
  }
}

}  // namespace lampblack::flow
