#include "flow/discretisation/neighbour_bounds.hpp"

#include <algorithm>

namespace lampblack::flow {

void NeighbourBounds::prepare(std::span<const double> values, std::span<const double> boundary,
                              std::span<const BoundaryData> known) {
  if (fields_ == 0) return;
  const Mesh& m = context_.mesh;
  bounds_.resize(at(m.cells));
  for (int cell = 0; cell < m.owned; ++cell) {
    double* smallest = &bounds_[at(cell)];
    double* largest = smallest + fields_;
    std::copy_n(&values[static_cast<std::size_t>(cell) * fields_], fields_, smallest);
    std::copy_n(smallest, fields_, largest);
    for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i) {
      const int face = m.faceOfCell[i];
      if (m.high[face] < 0 && known[face - m.interiorFaces] != BoundaryData::Value) continue;
      const double* other = valuesBeyond(m, cell, face, values, boundary, fields_);
      for (int k = 0; k < fields_; ++k) {
        smallest[k] = std::min(smallest[k], other[k]);
        largest[k] = std::max(largest[k], other[k]);
      }
    }
  }
  context_.halo.update(bounds_, 2 * fields_);
}

}  // namespace lampblack::flow
