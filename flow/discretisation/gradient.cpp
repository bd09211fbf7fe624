#include "flow/discretisation/gradient.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/least_squares.hpp"
#include "core/paired_slopes.hpp"

namespace lampblack::flow {

Gradient::Gradient(const Mesh& mesh) : mesh_(mesh) {}

const Vector3* Gradient::weights(int cell, std::span<const BoundaryData> known, int components, int first,
                                 Weights& room) const {
  const Mesh& m = mesh_;
  if (m.gradientRow[cell] >= 0) return &m.gradientWeight[static_cast<std::size_t>(m.gradientRow[cell])];
  const bool isEachComponent = components > 1 && known.size() > static_cast<std::size_t>(m.boundaryFaces());
  const auto dataOf = [&](int face) {
    const int b = face - m.interiorFaces;
    return known.empty() ? BoundaryData::Value : known[isEachComponent ? b * components + first : b];
  };
  const auto facesOfCell =
      std::span(m.faceOfCell).subspan(m.faceStart[cell], m.faceStart[cell + 1] - m.faceStart[cell]);
  const auto isKnown = [&](int face) { return m.high[face] >= 0 || dataOf(face) == BoundaryData::Value; };
  if (std::ranges::all_of(facesOfCell, isKnown) && pairedSlopes(m, cell, room)) return room.data();
  LeastSquares squares;
  for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i) {
    const int face = m.faceOfCell[i];
    const BoundaryData data = m.high[face] >= 0 ? BoundaryData::Value : dataOf(face);
    if (data == BoundaryData::Value) squares.add(m.step[face]);
    if (data == BoundaryData::ZeroSlope) squares.add(scaled(m.normal[face], reach(m.distance[face], data)));
  }
  squares.finish(m.dimension);
  for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i) {
    const int face = m.faceOfCell[i];
    const double sign = m.low[face] == cell ? 1.0 : -1.0;
    room[i - m.faceStart[cell]] = isKnown(face) ? squares.weight(scaled(m.step[face], sign)) : Vector3{};
  }
  return room.data();
}

void Gradient::compute(std::span<const double> values, std::span<const double> boundary, int components,
                       std::span<double> gradient, std::span<const BoundaryData> known) const {
  const Mesh& m = mesh_;
  const int d = m.dimension;
  // Components of the same flags at once.
  const bool isEachComponent = components > 1 && known.size() > static_cast<std::size_t>(m.boundaryFaces());
  const int width = isEachComponent ? 1 : components;
  Weights room;
  for (int cell = 0; cell < m.owned; ++cell) {
    double* out = gradient.data() + static_cast<std::ptrdiff_t>(cell) * components * d;
    std::fill(out, out + d * components, 0.0);
    const double* own = values.data() + static_cast<std::ptrdiff_t>(cell) * components;
    for (int first = 0; first < components; first += width) {
      const Vector3* weight = weights(cell, known, components, first, room);
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
  Weights room;
  const Vector3* weight = weights(cell, known, 1, 0, room);
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
  Weights room;
  for (int cell = 0; cell < m.owned; ++cell) {
    const auto c = static_cast<std::size_t>(cell);
    const Vector3* weight = weights(cell, known, 1, 0, room);
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
