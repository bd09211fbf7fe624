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

void FaceVelocity::predict(const Cells& cells, std::span<const double> inverseDensity, double dt,
                           std::span<double> faceVelocity) {
  const Mesh& m = context_.mesh;
  const int d = m.dimension;
  for (int face = 0; face < m.interiorFaces; ++face) {
    const Vector3& normal = m.normal[face];
    const double density = 1.0 / inverseDensity[face];
    double slope = (cells.pressure[m.high[face]] - cells.pressure[m.low[face]]) / m.distance[face] -
                   context_.bodyForce(density, normal);
    if (m.isOblique())
      slope +=
          density * meanAlong(m.oblique[face], face, cells.acceleration) + context_.bodyForce(density, m.oblique[face]);
    const double excess = meanAlong(normal, face, cells.acceleration) - inverseDensity[face] * slope;
    // The deviation's equation with constant coefficients, exactly.
    const double decayed = dt * mean(face, cells.relaxation);
    const double lost = -std::expm1(-decayed);
    const double deviation = (1.0 - lost) * deviation_[face] + dt * excess * (decayed > 0.0 ? lost / decayed : 1.0);
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
