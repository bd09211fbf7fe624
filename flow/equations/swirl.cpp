#include "flow/equations/swirl.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "flow/discretisation/limiter.hpp"

namespace lampblack::flow {
namespace {

// The axis a face of a box is normal to.
int axisOf(const Mesh& m, int face) {
  return m.normal[face][0] != 0.0 ? 0 : 1;
}

// Where nothing rubs, w/r has no slope: r w has none at the axis or along it, and some where a boundary lies outwards.
std::vector<BoundaryData> knownData(const FlowContext& context) {
  const Mesh& m = context.mesh;
  std::vector<BoundaryData> known;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const BoundaryCondition& boundary = context.boundaryOf(face);
    const bool isSmooth = boundary.kind == BoundaryKind::Symmetry || boundary.slip;
    const bool hasSlope = axisOf(m, face) == 0 && m.faceCentre[face][0] > 0.0;
    known.push_back(boundary.kind == BoundaryKind::Outlet ? BoundaryData::Nothing
                    : !isSmooth                           ? BoundaryData::Value
                    : hasSlope                            ? BoundaryData::Nothing
                                                          : BoundaryData::ZeroSlope);
  }
  return known;
}

}  // namespace

Swirl::Swirl(const FlowContext& context, std::span<const BoundaryData> pressureKnown)
    : context_(context),
      gradient_(context.mesh),
      diffusion_(context.mesh, context.halo),
      known_(knownData(context)),
      upwind_(context, known_) {
  const Mesh& m = context.mesh;
  if (!m.axisymmetric() || m.isOblique() || m.isSkewed())
    throw InputError(
        "a flow with swirl needs an axisymmetric mesh of rectangles: take a box that no table or formula bends");
  boundary_.resize(static_cast<std::size_t>(m.boundaryFaces()));
  angularMomentum_.resize(static_cast<std::size_t>(m.cells));
  slope_.resize(static_cast<std::size_t>(m.cells) * 2);
  excess_.resize(static_cast<std::size_t>(m.cells));
  turning_.resize(static_cast<std::size_t>(m.cells));
  centrifugal_.resize(static_cast<std::size_t>(m.cells));
  std::vector<char> isOuter(static_cast<std::size_t>(m.cells), 0);
  for (int face = m.interiorFaces; face < m.faces; ++face)
    if (axisOf(m, face) == 0 && pressureKnown[face - m.interiorFaces] == BoundaryData::Nothing)
      isOuter[m.low[face]] = 1;
  for (int face = 0; face < m.interiorFaces; ++face)
    if (axisOf(m, face) == 0 && m.high[face] < m.owned && isOuter[m.high[face]] != 0)
      outermost_.push_back({m.high[face], face});
}

void Swirl::setCentrifugal(const State& a, const State& b) {
  for (int c = 0; c < context_.mesh.cells; ++c) {
    const double w = 0.5 * (a.swirl[c] + b.swirl[c]);
    centrifugal_[c] = w * w / context_.mesh.centre[c][0];
  }
}

void Swirl::completeOuterSlopes(std::span<const double> density, std::span<double> gradient) const {
  const Mesh& m = context_.mesh;
  const auto force = [&](int cell) { return density[cell] * centrifugal_[cell]; };
  for (const auto& [cell, face] : outermost_) {
    const double w = m.lowWeight[face];
    gradient[2 * cell] += force(cell) - (w * force(m.low[face]) + (1.0 - w) * force(m.high[face]));
  }
}

// Whether a boundary holds the gas beside it at a velocity of its own.
bool Swirl::isGiven(int face) const {
  const BoundaryCondition& boundary = context_.boundaryOf(face);
  return (boundary.kind == BoundaryKind::Inlet && !context_.isSuction(face)) || boundary.isNoSlipWall();
}

// Gas that is drawn in through an outlet comes from rest.
void Swirl::setBoundaries(const State& mean) {
  const Mesh& m = context_.mesh;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const int b = face - m.interiorFaces;
    const BoundaryKind kind = context_.boundaryOf(face).kind;
    const bool isDrawnIn = kind == BoundaryKind::Outlet && mean.massFlux[face] < 0.0;
    if (kind == BoundaryKind::Outlet || kind == BoundaryKind::Inlet)
      known_[b] = isDrawnIn || isGiven(face) ? BoundaryData::Value : BoundaryData::Nothing;
    boundary_[b] = isDrawnIn       ? 0.0
                   : isGiven(face) ? m.faceCentre[face][0] * context_.boundarySwirl(face)
                                   : angularMomentum_[m.low[face]];
  }
}

void Swirl::addInside(const MomentumSweep& sweep) {
  const Mesh& m = context_.mesh;
  for (int face = 0; face < m.interiorFaces; ++face) {
    const int low = m.low[face];
    const int high = m.high[face];
    const double radius = m.faceCentre[face][0];
    const double mu = m.lowWeight[face] * sweep.viscosity[low] + (1.0 - m.lowWeight[face]) * sweep.viscosity[high];
    conductance_[face] = mu * radius * radius * m.area[face] / m.distance[face];
    const double flux = sweep.mean.massFlux[face];
    const Upwind u = upwind_.of(face, flux);
    const double value = limitedFaceValue(angularMomentum_[u.up], angularMomentum_[u.down],
                                          slopeAlong(u.direction, &slope_[2 * u.up], 2), u);
    if (low < m.owned) source_[low] -= flux * (value - angularMomentum_[low]);
    if (high < m.owned) source_[high] += flux * (value - angularMomentum_[high]);
  }
}

void Swirl::addBoundaries(const MomentumSweep& sweep) {
  const Mesh& m = context_.mesh;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const int b = face - m.interiorFaces;
    const int c = m.low[face];
    const int axis = axisOf(m, face);
    const double radius = m.faceCentre[face][0];
    const double viscous = sweep.boundaryViscosity[b] * radius * radius * m.area[face];
    const double flux = sweep.mean.massFlux[face];
    if (isGiven(face)) {
      const double conductance = viscous / m.distance[face];
      diagonal_[c] += conductance;
      source_[c] += conductance * boundary_[b] / (radius * radius) - flux * (boundary_[b] - angularMomentum_[c]);
    } else if (flux < 0.0) {
      source_[c] -= flux * (boundary_[b] - angularMomentum_[c]);
    } else if (known_[b] == BoundaryData::Nothing && flux > 0.0) {
      // What leaves goes along the cell's own slope. The torque across the outlet is that on the cell's other side:
      // with the stress at the outlet alone, a vortex that leaves outwards would lose its angular momentum.
      const double outwards = m.normal[face][axisOf(m, face)] * m.distance[face];
      const double slope = slope_[2 * c + axis];
      const double opposite = radius - 2.0 * outwards;
      const double torque = axis == 1 ? slope : opposite * slope - 2.0 * (angularMomentum_[c] - outwards * slope);
      const double perRadius = axis == 1 ? 1.0 : 1.0 / radius;
      source_[c] += m.normal[face][axisOf(m, face)] * sweep.boundaryViscosity[b] * m.area[face] * perRadius * torque -
                    flux * outwards * slope;
    }
  }
}

void Swirl::assemble(const State& state, const MomentumSweep& sweep) {
  const Mesh& m = context_.mesh;
  for (int c = 0; c < m.cells; ++c) angularMomentum_[c] = m.centre[c][0] * sweep.mean.swirl[c];
  setBoundaries(sweep.mean);
  gradient_.compute(angularMomentum_, boundary_, 1, slope_, known_);
  context_.halo.update(slope_, 2);

  diagonal_.assign(static_cast<std::size_t>(m.owned), 0.0);
  source_.assign(static_cast<std::size_t>(m.owned), 0.0);
  conductance_.assign(static_cast<std::size_t>(m.interiorFaces), 0.0);
  addInside(sweep);
  addBoundaries(sweep);
  for (int c = 0; c < m.cells; ++c) excess_[c] = 0.5 * (sweep.start.swirl[c] - state.swirl[c]) / m.centre[c][0];
  diffusion_.subtract(1, diagonal_, conductance_, excess_, source_);
  for (int c = 0; c < m.cells; ++c) turning_[c] = state.swirl[c] / m.centre[c][0];
}

void Swirl::rates(const State& state, const MomentumSweep& sweep, std::span<double> moment) {
  assemble(state, sweep);
  diffusion_.subtract(1, diagonal_, conductance_, turning_, source_);
  std::ranges::copy(source_, moment.begin());
  setCentrifugal(state, state);
}

void Swirl::advance(State& state, const MomentumSweep& sweep) {
  const Mesh& m = context_.mesh;
  assemble(state, sweep);
  for (int c = 0; c < m.owned; ++c) {
    const double r = m.centre[c][0];
    const double inertia = sweep.start.density[c] * m.volume[c] * r / sweep.dt;
    diagonal_[c] += inertia * r;
    source_[c] += inertia * sweep.start.swirl[c];
  }
  diffusion_.solve(1, diagonal_, conductance_, source_, turning_);
  for (int c = 0; c < m.cells; ++c) state.swirl[c] = m.centre[c][0] * turning_[c];
  setCentrifugal(sweep.start, state);
}

}  // namespace lampblack::flow
