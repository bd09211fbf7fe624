#include "flow/gradient.hpp"

#include <algorithm>
#include <cstddef>

namespace lampblack::flow {

Gradient::Gradient(const Mesh& mesh) : mesh_(mesh) {}

// Slope of components [first, first + count), which have the same flags, to out[k * stride].
void Gradient::addAlong(int axis, int cell, const Field& field, int first, int count, double* out, int stride) const {
  const Mesh& m = mesh_;
  const int components = field.components;
  const bool isEachComponent = components > 1 && field.known.size() > static_cast<std::size_t>(m.boundaryFaces());
  const auto reach = [&](int face) {
    if (m.high[face] >= 0 || field.known.empty()) return m.distance[face];
    const int b = face - m.interiorFaces;
    return Gradient::reach(m.distance[face], field.known[isEachComponent ? b * components + first : b]);
  };
  // The slope at the centre is the mean of the two one-sided slopes, weighted by the inverse distances.
  double weightSum = 0.0;
  for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i) {
    const int face = m.faceOfCell[i];
    if (m.normalAxis[face] != axis) continue;
    const double distance = reach(face);
    if (distance > 0.0) weightSum += 1.0 / distance;
  }
  const double* own = field.values.data() + static_cast<std::ptrdiff_t>(cell) * components + first;
  for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i) {
    const int face = m.faceOfCell[i];
    if (m.normalAxis[face] != axis) continue;
    const bool interior = m.high[face] >= 0;
    if (!interior && reach(face) != m.distance[face]) continue;  // no slope to add
    const bool isLow = m.low[face] == cell;
    const double outward = isLow ? m.normalSign[face] : -1.0;
    const double weight = outward / (m.distance[face] * m.distance[face] * weightSum);
    const double* other =
        interior ? field.values.data() + static_cast<std::ptrdiff_t>(isLow ? m.high[face] : m.low[face]) * components
                 : field.boundary.data() + static_cast<std::ptrdiff_t>(face - m.interiorFaces) * components;
    other += first;
    for (int k = 0; k < count; ++k) out[k * stride] += weight * (other[k] - own[k]);
  }
}

void Gradient::compute(std::span<const double> values, std::span<const double> boundary, int components,
                       std::span<double> gradient, std::span<const BoundaryData> known) const {
  const Field field{values, boundary, components, known};
  // Components of the same flags at once.
  const bool isEachComponent = components > 1 && known.size() > static_cast<std::size_t>(mesh_.boundaryFaces());
  const int width = isEachComponent ? 1 : components;
  for (int cell = 0; cell < mesh_.owned; ++cell) {
    double* out = gradient.data() + static_cast<std::ptrdiff_t>(cell) * components * 2;
    std::fill(out, out + 2 * components, 0.0);
    for (int first = 0; first < components; first += width)
      for (int axis = 0; axis < 2; ++axis) addAlong(axis, cell, field, first, width, out + 2 * first + axis, 2);
  }
}

void Gradient::along(int axis, int cell, std::span<const double> values, std::span<const double> boundary,
                     int components, std::span<double> slope, std::span<const BoundaryData> known) const {
  std::fill_n(slope.begin(), components, 0.0);
  addAlong(axis, cell, {values, boundary, components, known}, 0, components, slope.data(), 1);
}

}  // namespace lampblack::flow
