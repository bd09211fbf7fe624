#include "flow/equations/pressure_force.hpp"

#include <algorithm>

#include "flow/discretisation/upwind.hpp"

namespace lampblack::flow {

PressureForce::PressureForce(const FlowContext& context, const std::vector<BoundaryData>& known)
    : context_(context), known_(known), gradient_(context.mesh) {
  const Mesh& m = context.mesh;
  if (m.isOblique() || m.isSkewed()) slope_.resize(static_cast<std::size_t>(m.cells) * m.dimension);
}

void PressureForce::compute(std::span<const double> pressure, std::span<const double> boundary,
                            std::span<double> gradient) {
  const Mesh& m = context_.mesh;
  const int d = m.dimension;
  if (slope_.empty()) {
    gradient_.compute(pressure, boundary, 1, gradient, known_);
    return;
  }
  gradient_.compute(pressure, boundary, 1, slope_, known_);
  context_.halo.update(slope_, d);
  std::fill_n(gradient.begin(), static_cast<std::size_t>(m.owned) * d, 0.0);
  for (int face = 0; face < m.faces; ++face) {
    const int low = m.low[face], high = m.high[face];
    const double* own = &slope_[static_cast<std::size_t>(low) * d];
    double value = 0.0;
    if (high >= 0) {
      value = m.lowWeight[face] * pressure[low] + (1.0 - m.lowWeight[face]) * pressure[high];
      if (m.isSkewed() && isCentreInReach(m, face)) value += faceSlope(m, face, m.offset[face], slope_);
    } else if (known_[face - m.interiorFaces] == BoundaryData::Value) {
      value = boundary[face - m.interiorFaces];
    } else {
      value = pressure[low] + slopeAlong(reachOf(face), own, d);
    }
    const double size = m.size(face);
    for (int i = 0; i < d; ++i) {
      const double force = size * m.normal[face][i] * value;
      if (low < m.owned) gradient[low * d + i] += force;
      if (high >= 0 && high < m.owned) gradient[high * d + i] -= force;
    }
  }
  for (int c = 0; c < m.owned; ++c) {
    const double size = d == 2 ? m.planarArea[c] : m.volume[c];
    for (int i = 0; i < d; ++i) gradient[c * d + i] /= size;
  }
}

// Where the pressure has no slope along the normal, only what the face's centre is beside the cell's counts.
Vector3 PressureForce::reachOf(int face) const {
  const Mesh& m = context_.mesh;
  return known_[face - m.interiorFaces] == BoundaryData::ZeroSlope
             ? difference(m.step[face], scaled(m.normal[face], m.distance[face]))
             : m.step[face];
}

void PressureForce::atBoundary(std::span<const double> pressure, std::span<const double> boundary,
                               std::span<double> values) const {
  const Mesh& m = context_.mesh;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const int b = face - m.interiorFaces, cell = m.low[face];
    values[b] = boundary[b];
    if (known_[b] == BoundaryData::Value) continue;
    double slope = 0.0;
    gradient_.along(reachOf(face), cell, pressure, boundary, 1, {&slope, 1}, known_);
    values[b] = pressure[cell] + slope;
  }
}

}  // namespace lampblack::flow
