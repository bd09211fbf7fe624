// The part of the viscous stress that the implicit Laplacian of each velocity component leaves out.
#include <algorithm>

#include "flow/momentum.hpp"

namespace lampblack::flow {

// mu (grad u)^T - 2/3 mu (div u) I, and the hoop stress's dilatation part.
void Momentum::explicitStress(const MomentumSweep& sweep) {
  const Mesh& m = context_.mesh;
  const int d = dimension_;
  const std::span<const double> viscosity = sweep.viscosity;
  const auto dilatation = [&](int cell) {
    const double* g = &velocityGradient_[d * d * cell];
    double sum = 0.0;
    for (int i = 0; i < d; ++i) sum += g[i * d + i];
    return sum + (m.axisymmetric() ? sweep.mean.velocity[d * cell] / m.centre[cell][0] : 0.0);
  };
  // Slopes of the velocity along `normal`: of a cell, and interpolated to a face.
  const auto ofCell = [&](int cell, const Vector3& normal) {
    // velocityGradient_[(c d + j) d + i] is du_j/dx_i.
    Vector3 slopes{};
    for (int j = 0; j < d; ++j)
      for (int i = 0; i < d; ++i) slopes[i] += normal[j] * velocityGradient_[(cell * d + j) * d + i];
    return slopes;
  };
  const auto between = [&](int face, const Vector3& normal) {
    const double w = m.lowWeight[face];
    return sum(scaled(ofCell(m.low[face], normal), w), scaled(ofCell(m.high[face], normal), 1.0 - w));
  };
  // At an opening the normal velocity's slope along it lies on the line from the face on the cell's other side through
  // its centre. With the cell's own the force on it would be half of what it is.
  const auto transposedAt = [&](int face) {
    const Vector3& normal = m.normal[face];
    if (m.high[face] >= 0) return between(face, normal);
    const Vector3 own = ofCell(m.low[face], normal);
    const int opposite = opposite_[face - m.interiorFaces];
    if (opposite < 0) return own;
    const Vector3 extrapolated = difference(scaled(own, 2.0), between(opposite, normal));
    return sum(extrapolated, scaled(normal, dot(own, normal) - dot(extrapolated, normal)));
  };
  for (int face = 0; face < m.faces; ++face) {
    const bool isInside = m.high[face] >= 0;
    const int low = m.low[face], high = isInside ? m.high[face] : low;
    const double w = isInside ? m.lowWeight[face] : 1.0;
    const double mu =
        isInside ? w * viscosity[low] + (1.0 - w) * viscosity[high] : sweep.boundaryViscosity[face - m.interiorFaces];
    const double divergence = w * dilatation(low) + (1.0 - w) * dilatation(high);
    const Vector3& normal = m.normal[face];
    Vector3 traction = difference(transposedAt(face), scaled(normal, 2.0 / 3.0 * divergence));
    // Along walls and symmetries the normal velocity stays zero.
    const bool isTight = !isInside && (context_.boundaryOf(face).kind == BoundaryKind::Wall ||
                                       context_.boundaryOf(face).kind == BoundaryKind::Symmetry);
    if (isTight) traction = scaled(normal, dot(traction, normal));
    traction = scaled(traction, mu * m.area[face]);
    for (int i = 0; i < d; ++i) {
      if (low < m.owned) source_[d * low + i] += traction[i];
      if (isInside && high < m.owned) source_[d * high + i] -= traction[i];
    }
  }
  if (!m.axisymmetric()) return;
  for (int c = 0; c < m.owned; ++c) source_[d * c] += 2.0 / 3.0 * viscosity[c] * dilatation(c) * m.planarArea[c];
}

// At outlets the Laplacian part of the stress is that of the cell's own slope, and the gas that leaves has the velocity
// along it.
void Momentum::outletStress(const MomentumSweep& sweep) {
  const Mesh& m = context_.mesh;
  const int d = dimension_;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    if (context_.boundaryOf(face).kind != BoundaryKind::Outlet) continue;
    const int c = m.low[face];
    const double leaving = std::max(sweep.mean.massFlux[face], 0.0);
    for (int i = 0; i < d; ++i) {
      const double* gradient = &velocityGradient_[(c * d + i) * d];
      source_[d * c + i] += sweep.viscosity[c] * m.area[face] * slopeAlong(m.normal[face], gradient, d) -
                            leaving * slopeAlong(m.step[face], gradient, d);
    }
  }
}

}  // namespace lampblack::flow
