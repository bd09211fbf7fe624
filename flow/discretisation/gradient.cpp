#include "flow/discretisation/gradient.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/least_squares.hpp"
#include "core/paired_slopes.hpp"

namespace lampblack::flow {

Gradient::Gradient(const Mesh& mesh) : mesh_(mesh) {
  int rows = 0;
  row_.reserve(mesh.gradientRow.size());
  for (const int row : mesh.gradientRow) row_.push_back(row >= 0 ? -1 : rows++);
  kept_.resize(static_cast<std::size_t>(rows));
}

const Vector3* Gradient::weights(int cell, std::span<const BoundaryData> known, int components, int first) const {
  const Mesh& m = mesh_;
  if (m.gradientRow[cell] >= 0) return &m.gradientWeight[static_cast<std::size_t>(m.gradientRow[cell])];
  const bool isEachComponent = components > 1 && known.size() > static_cast<std::size_t>(m.boundaryFaces());
  std::array<BoundaryData, Mesh::mostSides> ofFaces{};  // Value of those inside and where there is no face
  for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i) {
    const int b = m.faceOfCell[i] - m.interiorFaces;
    if (b >= 0 && !known.empty()) ofFaces[i - m.faceStart[cell]] = known[isEachComponent ? b * components + first : b];
  }
  std::vector<Kept>& kept = kept_[static_cast<std::size_t>(row_[cell])];
  auto found = std::ranges::find(kept, ofFaces, &Kept::known);
  if (found == kept.end()) {
    found = kept.insert(kept.end(), {ofFaces, {}});
    find(cell, ofFaces, found->weights);
  }
  return found->weights.data();
}

void Gradient::find(int cell, std::span<const BoundaryData> ofFaces, Weights& weights) const {
  const Mesh& m = mesh_;
  const auto isKnown = [](BoundaryData data) { return data == BoundaryData::Value; };
  if (std::ranges::all_of(ofFaces, isKnown) && pairedSlopes(m, cell, weights)) return;
  const auto faces = std::span(m.faceOfCell).subspan(m.faceStart[cell], m.faceStart[cell + 1] - m.faceStart[cell]);
  LeastSquares squares;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const int face = faces[i];
    if (isKnown(ofFaces[i])) squares.add(m.step[face]);
    if (ofFaces[i] == BoundaryData::ZeroSlope) squares.add(scaled(m.normal[face], reach(m.distance[face], ofFaces[i])));
  }
  squares.finish(m.dimension);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const double sign = m.low[faces[i]] == cell ? 1.0 : -1.0;
    weights[i] = isKnown(ofFaces[i]) ? squares.weight(scaled(m.step[faces[i]], sign)) : Vector3{};
  }
}

void Gradient::compute(std::span<const double> values, std::span<const double> boundary, int components,
                       std::span<double> gradient, std::span<const BoundaryData> known) const {
  const Mesh& m = mesh_;
  const int d = m.dimension;
  // Components of the same flags at once.
  const bool isEachComponent = components > 1 && known.size() > static_cast<std::size_t>(m.boundaryFaces());
  const int width = isEachComponent ? 1 : components;
  for (int cell = 0; cell < m.owned; ++cell) {
    double* out = gradient.data() + static_cast<std::ptrdiff_t>(cell) * components * d;
    std::fill(out, out + d * components, 0.0);
    const double* own = values.data() + static_cast<std::ptrdiff_t>(cell) * components;
    for (int first = 0; first < components; first += width) {
      const Vector3* weight = weights(cell, known, components, first);
      for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i, ++weight) {
        if (*weight == Vector3{}) continue;
        const int face = m.faceOfCell[i];
        const double* other = valuesBeyond(m, cell, face, values, boundary, components);
        for (int k = first; k < first + width; ++k) {
          const double difference = other[k] - own[k];
          double* slope = out + k * d;
          slope[0] += (*weight)[0] * difference;
          slope[1] += (*weight)[1] * difference;
          if (d == 3) slope[2] += (*weight)[2] * difference;
        }
      }
    }
  }
}

void Gradient::along(const Vector3& direction, int cell, std::span<const double> values,
                     std::span<const double> boundary, int components, std::span<double> slope,
                     std::span<const BoundaryData> known) const {
  const Mesh& m = mesh_;
  std::fill_n(slope.begin(), components, 0.0);
  const Vector3* weight = weights(cell, known, 1, 0);
  const double* own = values.data() + static_cast<std::ptrdiff_t>(cell) * components;
  for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i, ++weight) {
    const double share = dot(*weight, direction);
    if (share == 0.0) continue;  // of a box the faces of the other axes
    const int face = m.faceOfCell[i];
    const double* other = valuesBeyond(m, cell, face, values, boundary, components);
    for (int k = 0; k < components; ++k) slope[k] += share * (other[k] - own[k]);
  }
}

void Gradient::beyond(std::span<const double> values, std::span<const double> boundary,
                      std::span<const double> gradient, std::span<const BoundaryData> known, double mostRise,
                      std::span<Beyond> out) const {
  const Mesh& m = mesh_;
  const auto d = static_cast<std::size_t>(m.dimension);
  for (int cell = 0; cell < m.owned; ++cell) {
    const auto c = static_cast<std::size_t>(cell);
    const Vector3* weight = weights(cell, known, 1, 0);
    out[c] = {};
    for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i, ++weight) {
      if (*weight == Vector3{}) continue;
      const int face = m.faceOfCell[i];
      const Vector3 step = scaled(m.step[face], m.low[face] == cell ? 1.0 : -1.0);
      const double* other = valuesBeyond(m, cell, face, values, boundary, 2);
      std::array<double, 2> rise{}, along{};  // to the neighbour; by the gradient
      for (std::size_t k = 0; k < 2; ++k) {
        rise[k] = other[k] - values[2 * c + k];
        for (std::size_t axis = 0; axis < d; ++axis) along[k] += gradient[(2 * c + k) * d + axis] * step[axis];
      }
      const double share = dot(*weight, step) / dot(step, step);
      const double limited = std::min(rise[1], mostRise * std::max(values[2 * c + 1], 0.0));
      out[c].product += share * (rise[0] * rise[1] - along[0] * along[1]);
      out[c].square += share * (limited * limited - along[1] * along[1]);
    }
  }
}

}  // namespace lampblack::flow
