#include "flow/row_gradient.hpp"

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
  if (!m.isSkewed()) return;
  haloBounds_.resize(static_cast<std::size_t>(m.cells - m.owned) * 2 * n);
  context_.halo.exchange(
      static_cast<int>(2 * n),
      [&](int cell, double* out) {
        ownBounds(cell, {out, n}, {out + n, n});
      },
      [&](int cell, const double* in) {
        std::copy_n(in, 2 * n, &haloBounds_[static_cast<std::size_t>(cell - m.owned) * 2 * n]);
      });
}

void RowGradient::ownBounds(int cell, std::span<double> smallest, std::span<double> largest) const {
  const Mesh& m = context_.mesh;
  const auto n = static_cast<std::size_t>(fields_);
  const auto valuesAt = [&](std::span<const double> of, int place) { return &of[static_cast<std::size_t>(place) * n]; };
  std::copy_n(valuesAt(values_, cell), n, smallest.begin());
  std::copy_n(valuesAt(values_, cell), n, largest.begin());
  for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i) {
    const int face = m.faceOfCell[i], b = face - m.interiorFaces;
    if (m.high[face] < 0 && !known_.empty() && known_[b] != BoundaryData::Value) continue;
    const double* other =
        m.high[face] < 0 ? valuesAt(boundary_, b) : valuesAt(values_, m.low[face] == cell ? m.high[face] : m.low[face]);
    for (std::size_t k = 0; k < n; ++k) {
      smallest[k] = std::min(smallest[k], other[k]);
      largest[k] = std::max(largest[k], other[k]);
    }
  }
}

void RowGradient::bounds(int cell, std::span<double> smallest, std::span<double> largest) const {
  if (cell < context_.mesh.owned) {
    ownBounds(cell, smallest, largest);
    return;
  }
  const auto n = static_cast<std::size_t>(fields_);
  const double* of = &haloBounds_[static_cast<std::size_t>(cell - context_.mesh.owned) * 2 * n];
  std::copy_n(of, n, smallest.begin());
  std::copy_n(of + n, n, largest.begin());
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
