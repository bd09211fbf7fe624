// The part of the viscous stress that the implicit Laplacian of each velocity component leaves out.
#include <algorithm>

#include "flow/equations/momentum_forces.hpp"

namespace lampblack::flow {

// mu (grad u)^T - 2/3 mu (div u) I, and the hoop stress's dilatation part.
void MomentumForces::explicitStress(const MomentumSweep& sweep) {
  const Mesh& m = context_.mesh;
  const int d = dimension_;
  const std::span<const double> viscosity = sweep.viscosity;
  for (int face = 0; face < m.faces; ++face) {
    const bool isInside = m.high[face] >= 0;
    const int low = m.low[face], high = isInside ? m.high[face] : low;
    const double w = isInside ? m.lowWeight[face] : 1.0;
    const double mu =
        isInside ? w * viscosity[low] + (1.0 - w) * viscosity[high] : sweep.boundaryViscosity[face - m.interiorFaces];
    const Vector3 force = scaled(gradient_.transposedTraction(face, sweep.mean.velocity), mu * m.area[face]);
    for (int i = 0; i < d; ++i) {
      if (low < m.owned) source_[d * low + i] += force[i];
      if (isInside && high < m.owned) source_[d * high + i] -= force[i];
    }
  }
  if (!m.axisymmetric()) return;
  for (int c = 0; c < m.owned; ++c)
    source_[d * c] += 2.0 / 3.0 * viscosity[c] * gradient_.dilatation(c, sweep.mean.velocity) * m.planarArea[c];
}

// At outlets the Laplacian part of the stress is that of the cell's own slope, and the gas that leaves has the velocity
// along it.
void MomentumForces::outletStress(const MomentumSweep& sweep) {
  const Mesh& m = context_.mesh;
  const int d = dimension_;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    if (context_.boundaryOf(face).kind != BoundaryKind::Outlet) continue;
    const int c = m.low[face];
    const double leaving = std::max(sweep.mean.massFlux[face], 0.0);
    for (int i = 0; i < d; ++i) {
      const double* gradient = gradient_.of(c, i);
      source_[d * c + i] += sweep.viscosity[c] * m.area[face] * slopeAlong(m.normal[face], gradient, d) -
                            leaving * slopeAlong(m.step[face], gradient, d);
    }
  }
}

const VelocityGradient& MomentumForces::velocityGradient(const State& state) {
  gradient_.setBoundary(state.velocity);
  gradient_.compute(state.velocity);
  gradient_.updateHalo();
  return gradient_;
}

// N, by the gas on what lies beyond: the stress that addBoundary(), explicitStress() and outletStress() move the gas
// by.
Vector3 MomentumForces::boundaryTraction(int face, const State& state, double viscosity) const {
  const Mesh& m = context_.mesh;
  const int d = dimension_, cell = m.low[face];
  const GivenVelocity given = givenVelocity(context_.boundaryOf(face));
  Vector3 slope = gradient_.transposedTraction(face, state.velocity);
  for (int i = 0; i < d; ++i) {
    if (given == GivenVelocity::Nothing) {
      slope[i] += slopeAlong(m.normal[face], gradient_.of(cell, i), d);
      continue;
    }
    const double beyond = gradient_.boundary()[d * (face - m.interiorFaces) + i];
    slope[i] += (beyond - state.velocity[d * cell + i]) / m.distance[face];
    if (m.isOblique() && given == GivenVelocity::All)
      slope[i] += faceSlope(m, face, m.oblique[face], gradient_.values(), d, i);
  }
  return scaled(slope, -viscosity * m.area[face]);
}

std::vector<double> MomentumForces::boundaryPressures(const State& state) {
  outletPressures(state);
  std::vector<double> pressures(boundaryPressure_.size());
  pressureForce_.atBoundary(state.pressure, boundaryPressure_, pressures);
  return pressures;
}

}  // namespace lampblack::flow
