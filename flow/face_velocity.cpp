#include "flow/face_velocity.hpp"

#include <cmath>

#include "flow/upwind.hpp"

namespace lampblack::flow {

double FaceVelocity::mean(int face, std::span<const double> values) const {
  const Mesh& m = context_.mesh;
  const double w = m.lowWeight[face];
  return w * values[m.low[face]] + (1.0 - w) * values[m.high[face]];
}

double FaceVelocity::meanAlong(const Vector3& direction, int face, std::span<const double> vectors) const {
  const Mesh& m = context_.mesh;
  const int d = m.dimension;
  return m.lowWeight[face] * slopeAlong(direction, &vectors[d * m.low[face]], d) +
         (1.0 - m.lowWeight[face]) * slopeAlong(direction, &vectors[d * m.high[face]], d);
}

void FaceVelocity::computeExcess(const Cells& cells, std::span<const double> inverseDensity) {
  const Mesh& m = context_.mesh;
  excess_.resize(static_cast<std::size_t>(m.interiorFaces));
  for (int face = 0; face < m.interiorFaces; ++face) {
    const Vector3& normal = m.normal[face];
    const double density = 1.0 / inverseDensity[face];
    double slope = (cells.pressure[m.high[face]] - cells.pressure[m.low[face]]) / m.distance[face] -
                   context_.bodyForce(density, normal);
    if (m.isOblique())
      slope +=
          density * meanAlong(m.oblique[face], face, cells.acceleration) + context_.bodyForce(density, m.oblique[face]);
    excess_[face] = meanAlong(normal, face, cells.acceleration) - inverseDensity[face] * slope;
  }
  if (!m.isOblique() && !m.isSkewed()) removeSmoothExcess();
}

// What the faces of a cell have in common, as vectors in the cells, interpolated back to the faces: all of the excess
// in a smooth flow, nothing of that of pressures that go up and down from cell to cell.
void FaceVelocity::removeSmoothExcess() {
  const Mesh& m = context_.mesh;
  const int d = m.dimension;
  common_.assign(static_cast<std::size_t>(m.cells) * d, 0.0);
  share_.assign(common_.size(), 0.0);
  for (int face = 0; face < m.interiorFaces; ++face)
    for (const int cell : {m.low[face], m.high[face]})
      for (int i = 0; i < d; ++i) {
        common_[cell * d + i] += m.normal[face][i] * excess_[face];
        share_[cell * d + i] += m.normal[face][i] * m.normal[face][i];
      }
  for (std::size_t i = 0; i < static_cast<std::size_t>(m.owned) * d; ++i)
    if (share_[i] > 0.0) common_[i] /= share_[i];
  context_.halo.update(common_, d);
  for (int face = 0; face < m.interiorFaces; ++face) excess_[face] -= meanAlong(m.normal[face], face, common_);
}

void FaceVelocity::predict(const Cells& cells, std::span<const double> inverseDensity, double dt,
                           std::span<double> faceVelocity) {
  const Mesh& m = context_.mesh;
  const int d = m.dimension;
  computeExcess(cells, inverseDensity);
  for (int face = 0; face < m.interiorFaces; ++face) {
    const Vector3& normal = m.normal[face];
    // The deviation's equation with constant coefficients, exactly.
    const double decayed = dt * mean(face, cells.relaxation);
    const double lost = -std::expm1(-decayed);
    const double deviation =
        (1.0 - lost) * deviation_[face] + dt * excess_[face] * (decayed > 0.0 ? lost / decayed : 1.0);
    faceVelocity[face] = meanAlong(normal, face, cells.velocity) + deviation;
    if (!m.isSkewed()) continue;
    double ofOffset = 0.0;
    for (int i = 0; i < d; ++i)
      ofOffset += normal[i] * faceSlope(m, face, m.offset[face], cells.velocityGradient, d, i);
    offset_[face] = ofOffset;
    faceVelocity[face] += ofOffset;
  }
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const BoundaryCondition& boundary = context_.boundaryOf(face);
    const int low = m.low[face];
    // Extrapolated along the cell's own slope.
    double outward = slopeAlong(m.normal[face], &cells.velocity[d * low], d);
    for (int i = 0; i < d; ++i)
      outward += m.normal[face][i] * slopeAlong(m.step[face], &cells.velocityGradient[(low * d + i) * d], d);
    faceVelocity[face] = boundary.kind == BoundaryKind::Outlet  ? outward
                         : boundary.kind == BoundaryKind::Inlet ? -context_.boundarySpeed(face)
                                                                : 0.0;
  }
}

void FaceVelocity::take(std::span<const double> velocity, std::span<const double> faceVelocity) {
  const Mesh& m = context_.mesh;
  for (int face = 0; face < m.interiorFaces; ++face) {
    found_[face] = faceVelocity[face] - meanAlong(m.normal[face], face, velocity);
    if (m.isSkewed()) found_[face] -= offset_[face];
  }
}

}  // namespace lampblack::flow
