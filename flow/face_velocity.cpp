#include "flow/face_velocity.hpp"

#include <cmath>

namespace lampblack::flow {

double FaceVelocity::mean(int face, std::span<const double> values, int components, int component) const {
  const Mesh& m = context_.mesh;
  const double w = m.lowWeight[face];
  return w * values[components * m.low[face] + component] + (1.0 - w) * values[components * m.high[face] + component];
}

void FaceVelocity::predict(const Cells& cells, std::span<const double> inverseDensity, double dt,
                           std::span<double> faceVelocity) {
  const Mesh& m = context_.mesh;
  for (int face = 0; face < m.interiorFaces; ++face) {
    const int axis = m.normalAxis[face];
    const double slope = (cells.pressure[m.high[face]] - cells.pressure[m.low[face]]) / m.distance[face] -
                         context_.bodyForce(1.0 / inverseDensity[face], axis);
    const double excess = mean(face, cells.acceleration, 2, axis) - inverseDensity[face] * slope;
    // The deviation's equation with constant coefficients, exactly.
    const double decayed = dt * mean(face, cells.relaxation, 1, 0);
    const double lost = -std::expm1(-decayed);
    const double deviation = (1.0 - lost) * deviation_[face] + dt * excess * (decayed > 0.0 ? lost / decayed : 1.0);
    faceVelocity[face] = mean(face, cells.velocity, 2, axis) + deviation;
  }
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const BoundaryCondition& boundary = context_.boundaryOf(face);
    const int low = m.low[face];
    const int axis = m.normalAxis[face];
    // Extrapolated along the cell's own slope.
    const double outward = m.normalSign[face] * cells.velocity[2 * low + axis] +
                           m.distance[face] * cells.velocityGradient[4 * low + 3 * axis];
    faceVelocity[face] = boundary.kind == BoundaryKind::Outlet  ? outward
                         : boundary.kind == BoundaryKind::Inlet ? -context_.boundarySpeed(face)
                                                                : 0.0;
  }
}

void FaceVelocity::take(std::span<const double> velocity, std::span<const double> faceVelocity) {
  const Mesh& m = context_.mesh;
  for (int face = 0; face < m.interiorFaces; ++face)
    found_[face] = faceVelocity[face] - mean(face, velocity, 2, m.normalAxis[face]);
}

}  // namespace lampblack::flow
