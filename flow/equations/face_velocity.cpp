#include "flow/equations/face_velocity.hpp"

#include <cmath>

#include "core/least_squares.hpp"
#include "flow/discretisation/upwind.hpp"

namespace lampblack::flow {

FaceVelocity::FaceVelocity(const FlowContext& context)
    : context_(context),
      deviation_(static_cast<std::size_t>(context.mesh.faces), 0.0),
      found_(deviation_),
      offset_(context.mesh.isSkewed() ? deviation_ : std::vector<double>{}) {
  const Mesh& m = context.mesh;
  excess_.resize(static_cast<std::size_t>(m.interiorFaces));
  normalWeight_.resize(static_cast<std::size_t>(m.faceStart[m.owned]));
  for (int c = 0; c < m.owned; ++c) {
    // Of other shapes' faces there are too few: next to nothing is left of what they have not in common.
    if (!hasOppositeSides(m.shape[c])) continue;
    LeastSquares squares;
    for (int i = m.faceStart[c]; i < m.faceStart[c + 1]; ++i)
      if (m.high[m.faceOfCell[i]] >= 0) squares.add(m.normal[m.faceOfCell[i]]);
    squares.finish(m.dimension);
    for (int i = m.faceStart[c]; i < m.faceStart[c + 1]; ++i)
      if (m.high[m.faceOfCell[i]] >= 0) normalWeight_[i] = squares.weight(m.normal[m.faceOfCell[i]]);
  }
}

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
  removeSmoothExcess();
}

// What the faces of a cell have in common, as vectors in the cells, interpolated back to the faces: all of the excess
// in a smooth flow, nothing of that of pressures that go up and down from cell to cell.
void FaceVelocity::removeSmoothExcess() {
  const Mesh& m = context_.mesh;
  const int d = m.dimension;
  common_.assign(static_cast<std::size_t>(m.cells) * d, 0.0);
  for (int c = 0; c < m.owned; ++c)
    for (int i = m.faceStart[c]; i < m.faceStart[c + 1]; ++i) {
      if (m.high[m.faceOfCell[i]] < 0) continue;
      for (int axis = 0; axis < d; ++axis) common_[c * d + axis] += normalWeight_[i][axis] * excess_[m.faceOfCell[i]];
    }
  context_.halo.update(common_, d);
  for (int face = 0; face < m.interiorFaces; ++face) excess_[face] -= meanAlong(m.normal[face], face, common_);
}

// Of the cells around an interior face, at its centre; keeps the part of Mesh::offset for take().
double FaceVelocity::ofCells(int face, const Cells& cells) {
  const Mesh& m = context_.mesh;
  const int d = m.dimension;
  const Vector3& normal = m.normal[face];
  const double mean = meanAlong(normal, face, cells.velocity);
  if (!m.isSkewed()) return mean;
  double ofOffset = 0.0;
  for (int i = 0; i < d; ++i) ofOffset += normal[i] * riseToCentre(m, face, cells.velocityGradient, d, i);
  offset_[face] = ofOffset;
  return mean;
}

double FaceVelocity::ofBoundary(int face, const Cells& cells) const {
  const Mesh& m = context_.mesh;
  const int d = m.dimension, low = m.low[face];
  const BoundaryCondition& boundary = context_.boundaryOf(face);
  if (boundary.kind == BoundaryKind::Inlet) return -context_.boundarySpeed(face);
  if (boundary.kind != BoundaryKind::Outlet) return 0.0;
  // Extrapolated along the cell's own slope.
  double outward = slopeAlong(m.normal[face], &cells.velocity[d * low], d);
  for (int i = 0; i < d; ++i)
    outward += m.normal[face][i] * slopeAlong(m.step[face], &cells.velocityGradient[(low * d + i) * d], d);
  return outward;
}

void FaceVelocity::predict(const Cells& cells, std::span<const double> inverseDensity, double dt,
                           std::span<double> faceVelocity) {
  const Mesh& m = context_.mesh;
  computeExcess(cells, inverseDensity);
  for (int face = 0; face < m.interiorFaces; ++face) {
    // The deviation's equation with constant coefficients, exactly.
    const double decayed = dt * mean(face, cells.relaxation);
    const double lost = -std::expm1(-decayed);
    const double deviation =
        (1.0 - lost) * deviation_[face] + dt * excess_[face] * (decayed > 0.0 ? lost / decayed : 1.0);
    faceVelocity[face] = ofCells(face, cells) + deviation;
    if (m.isSkewed()) faceVelocity[face] += offset_[face];
  }
  for (int face = m.interiorFaces; face < m.faces; ++face) faceVelocity[face] = ofBoundary(face, cells);
}

void FaceVelocity::settled(const Cells& cells, std::span<const double> inverseDensity, std::span<double> faceVelocity) {
  const Mesh& m = context_.mesh;
  computeExcess(cells, inverseDensity);
  for (int face = 0; face < m.interiorFaces; ++face) {
    const double relaxation = mean(face, cells.relaxation);
    faceVelocity[face] = ofCells(face, cells) + (relaxation > 0.0 ? excess_[face] / relaxation : 0.0);
    if (m.isSkewed()) faceVelocity[face] += offset_[face];
  }
  for (int face = m.interiorFaces; face < m.faces; ++face) faceVelocity[face] = ofBoundary(face, cells);
}

void FaceVelocity::take(std::span<const double> velocity, std::span<const double> faceVelocity) {
  const Mesh& m = context_.mesh;
  for (int face = 0; face < m.interiorFaces; ++face) {
    found_[face] = faceVelocity[face] - meanAlong(m.normal[face], face, velocity);
    if (m.isSkewed()) found_[face] -= offset_[face];
  }
}

}  // namespace lampblack::flow
