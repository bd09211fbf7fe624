#include "flow/discretisation/velocity_gradient.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lampblack::flow {
namespace {

// Along a boundary of a plane mesh, in the direction of the axis it is closest to.
Vector3 tangentOf(const Vector3& normal) {
  const bool isAlongSecond = std::abs(normal[0]) >= std::abs(normal[1]);
  const double sign = (isAlongSecond ? normal[0] : -normal[1]) >= 0.0 ? 1.0 : -1.0;
  return {-sign * normal[1], sign * normal[0], 0.0};
}

}  // namespace

GivenVelocity givenVelocity(const BoundaryCondition& boundary) {
  switch (boundary.kind) {
    case BoundaryKind::Inlet:
      return GivenVelocity::All;
    case BoundaryKind::Outlet:
      return GivenVelocity::Nothing;
    case BoundaryKind::Symmetry:
      return GivenVelocity::Normal;
    case BoundaryKind::Wall:
      return boundary.slip ? GivenVelocity::Normal : GivenVelocity::All;
  }
  return GivenVelocity::Nothing;
}

VelocityGradient::VelocityGradient(const FlowContext& context)
    : context_(context), dimension_(context.mesh.dimension), byLeastSquares_(context.mesh) {
  const Mesh& m = context.mesh;
  const auto d = static_cast<std::size_t>(dimension_);
  boundary_.resize(d * m.boundaryFaces());
  gradient_.resize(static_cast<std::size_t>(m.cells) * d * d);
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const GivenVelocity given = givenVelocity(context.boundaryOf(face));
    for (int i = 0; i < dimension_; ++i) {
      // Of a boundary along the axes each component is given or has no slope.
      const double share = std::abs(m.normal[face][i]);
      known_.push_back(given == GivenVelocity::Nothing                  ? BoundaryData::Nothing
                       : given == GivenVelocity::Normal && share == 0.0 ? BoundaryData::ZeroSlope
                                                                        : BoundaryData::Value);
    }
  }
  findOpposites();
}

std::vector<BoundaryData> VelocityGradient::known(int component) const {
  std::vector<BoundaryData> known;
  for (int b = 0; b < context_.mesh.boundaryFaces(); ++b) known.push_back(known_[dimension_ * b + component]);
  return known;
}

void VelocityGradient::findOpposites() {
  constexpr double straight = 0.9;
  const Mesh& m = context_.mesh;
  opposite_.assign(m.boundaryFaces(), -1);
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const int cell = m.low[face];
    for (int j = m.faceStart[cell]; j < m.faceStart[cell + 1]; ++j) {
      const int other = m.faceOfCell[j];
      const double outwards = (m.low[other] == cell ? 1.0 : -1.0) * dot(m.normal[other], m.normal[face]);
      if (m.high[other] >= 0 && outwards < -straight) opposite_[face - m.interiorFaces] = other;
    }
  }
  int open = 0;
  if (m.isOblique() || m.isSkewed())
    for (int face = m.interiorFaces; face < m.faces; ++face) open = std::max(open, isOpenCorner(face) ? 1 : 0);
  MPI_Allreduce(MPI_IN_PLACE, &open, 1, MPI_INT, MPI_MAX, m.comm);
  hasOpenCorners_ = open != 0;
}

// Cells at an outlet that have no face on the other side, such as triangles, know two slopes along it and none across:
// what leaves along their own gradient would feed itself, along their neighbours' it would where much leaves. It leaves
// as it is.
void VelocityGradient::setOutletGradients() {
  if (!hasOpenCorners_) return;
  const Mesh& m = context_.mesh;
  const auto entries = static_cast<std::ptrdiff_t>(dimension_ * dimension_);
  for (int face = m.interiorFaces; face < m.faces; ++face)
    if (isOpenCorner(face)) std::fill_n(gradient_.begin() + m.low[face] * entries, entries, 0.0);
}

bool VelocityGradient::isOpenCorner(int face) const {
  return context_.boundaryOf(face).kind == BoundaryKind::Outlet && opposite_[face - context_.mesh.interiorFaces] < 0;
}

void VelocityGradient::setBoundary(std::span<const double> velocity) {
  const Mesh& m = context_.mesh;
  const int d = dimension_;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const std::array<double, 2> given = context_.boundaryVelocity(face);
    const double* own = &velocity[d * m.low[face]];
    double* value = &boundary_[d * (face - m.interiorFaces)];
    const Vector3& normal = m.normal[face];
    switch (givenVelocity(context_.boundaryOf(face))) {
      case GivenVelocity::Nothing:
        for (int i = 0; i < d; ++i) value[i] = own[i];
        break;
      case GivenVelocity::Normal: {
        double outwards = given[0];
        for (int i = 0; i < d; ++i) outwards += own[i] * normal[i];
        for (int i = 0; i < d; ++i) value[i] = own[i] - outwards * normal[i];
        break;
      }
      case GivenVelocity::All: {
        const Vector3 tangent = tangentOf(normal);
        for (int i = 0; i < d; ++i) value[i] = -given[0] * normal[i] + given[1] * tangent[i];
        break;
      }
    }
  }
}

void VelocityGradient::compute(std::span<const double> velocity) {
  byLeastSquares_.compute(velocity, boundary_, dimension_, gradient_, known_);
  setOutletGradients();
}

double VelocityGradient::dilatation(int cell, std::span<const double> velocity) const {
  const Mesh& m = context_.mesh;
  const int d = dimension_;
  const double* g = &gradient_[d * d * cell];
  double sum = 0.0;
  for (int i = 0; i < d; ++i) sum += g[i * d + i];
  return sum + (m.axisymmetric() ? velocity[d * cell] / m.centre[cell][0] : 0.0);
}

// Slopes of the velocity along `normal`: of a cell, and interpolated to a face.
Vector3 VelocityGradient::slopesAlong(int cell, const Vector3& normal) const {
  Vector3 slopes{};
  for (int j = 0; j < dimension_; ++j)
    for (int i = 0; i < dimension_; ++i) slopes[i] += normal[j] * of(cell, j)[i];
  return slopes;
}

Vector3 VelocityGradient::slopesBetween(int face, const Vector3& normal) const {
  const Mesh& m = context_.mesh;
  const double w = m.lowWeight[face];
  return sum(scaled(slopesAlong(m.low[face], normal), w), scaled(slopesAlong(m.high[face], normal), 1.0 - w));
}

// At an opening the normal velocity's slope along it lies on the line from the face on the cell's other side through
// its centre. With the cell's own the force on it would be half of what it is.
Vector3 VelocityGradient::transposedAt(int face) const {
  const Mesh& m = context_.mesh;
  const Vector3& normal = m.normal[face];
  if (m.high[face] >= 0) return slopesBetween(face, normal);
  const Vector3 own = slopesAlong(m.low[face], normal);
  const int opposite = opposite_[face - m.interiorFaces];
  if (opposite < 0) return own;
  const Vector3 extrapolated = difference(scaled(own, 2.0), slopesBetween(opposite, normal));
  return sum(extrapolated, scaled(normal, dot(own, normal) - dot(extrapolated, normal)));
}

Vector3 VelocityGradient::transposedTraction(int face, std::span<const double> velocity) const {
  const Mesh& m = context_.mesh;
  const bool isInside = m.high[face] >= 0;
  const int low = m.low[face], high = isInside ? m.high[face] : low;
  const double w = isInside ? m.lowWeight[face] : 1.0;
  const double divergence = w * dilatation(low, velocity) + (1.0 - w) * dilatation(high, velocity);
  const Vector3& normal = m.normal[face];
  const Vector3 traction = difference(transposedAt(face), scaled(normal, 2.0 / 3.0 * divergence));
  const bool isTight = !isInside && (context_.boundaryOf(face).kind == BoundaryKind::Wall ||
                                     context_.boundaryOf(face).kind == BoundaryKind::Symmetry);
  return isTight ? scaled(normal, dot(traction, normal)) : traction;
}

}  // namespace lampblack::flow
