#include "flow/gradient.hpp"

#include <algorithm>

namespace lampblack::flow {

Gradient::Gradient(const Mesh& mesh) : mesh_(mesh) {}

void Gradient::compute(std::span<const double> values, std::span<const double> boundary, int components,
                       std::span<double> gradient, std::span<const BoundaryData> known) const {
  const Mesh& m = mesh_;
  const auto boundaryFaces = static_cast<std::size_t>(m.boundaryFaces());
  const bool isEachComponent = components > 1 && known.size() > boundaryFaces;
  const auto reach = [&](int face, int component) {
    if (m.high[face] >= 0 || known.empty()) return m.distance[face];
    const int b = face - m.interiorFaces;
    return Gradient::reach(m.distance[face], known[isEachComponent ? b * components + component : b]);
  };
  // Components of the same flags at once.
  const int width = isEachComponent ? 1 : components;
  for (int cell = 0; cell < m.owned; ++cell) {
    double* out = gradient.data() + static_cast<std::ptrdiff_t>(cell) * components * 2;
    std::fill(out, out + 2 * components, 0.0);
    const double* own = values.data() + static_cast<std::ptrdiff_t>(cell) * components;
    for (int first = 0; first < components; first += width) {
      // The slope at the centre is the mean of the two one-sided slopes, weighted by the inverse distances.
      double weightSum[2] = {0.0, 0.0};
      for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i) {
        const int face = m.faceOfCell[i];
        const double distance = reach(face, first);
        if (distance > 0.0) weightSum[m.normalAxis[face]] += 1.0 / distance;
      }
      for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i) {
        const int face = m.faceOfCell[i];
        const bool interior = m.high[face] >= 0;
        if (!interior && reach(face, first) != m.distance[face]) continue;  // no slope to add
        const int axis = m.normalAxis[face];
        const bool isLow = m.low[face] == cell;
        const double outward = isLow ? m.normalSign[face] : -1.0;
        const double weight = outward / (m.distance[face] * m.distance[face] * weightSum[axis]);
        const double* other =
            interior ? values.data() + static_cast<std::ptrdiff_t>(isLow ? m.high[face] : m.low[face]) * components
                     : boundary.data() + static_cast<std::ptrdiff_t>(face - m.interiorFaces) * components;
        for (int k = first; k < first + width; ++k) out[2 * k + axis] += weight * (other[k] - own[k]);
      }
    }
  }
}

}  // namespace lampblack::flow
