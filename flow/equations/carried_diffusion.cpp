// How what is carried diffuses: between cells, to walls and to inlets that hold it.
#include <algorithm>

#include "flow/boundaries/wall_flux.hpp"
#include "flow/discretisation/face_fluxes.hpp"
#include "flow/equations/carried_transport.hpp"
#include "flow/properties/wall_transfer.hpp"

namespace lampblack::flow {

// kg/m3, between the cells of a face, whichever way the gas flows: with the density of the gas upwind diffusion would
// jump where the flow turns round, and a state with such a face need not have a steady one beside it.
double CarriedTransport::densityBetween(const State& state, int face) const {
  const Mesh& m = context_.mesh;
  const double w = m.lowWeight[face];
  return w * state.density[m.low[face]] + (1.0 - w) * state.density[m.high[face]];
}

// kg/s of gas: the conductance of diffusion to a wall, of its still layer, or to an inlet.
double CarriedTransport::wallDiffusion(const State& state, const FaceState& faces, const GasProperties& properties,
                                       int face, int scalar) const {
  const Mesh& m = context_.mesh;
  const double metric = m.area[face] / m.distance[face];
  const double share = state.scalars[scalar].wallDiffusivity;
  if (share > 0.0 && context_.boundaryOf(face).kind == BoundaryKind::Wall)
    return metric * share * properties.boundaryViscosity[face - m.interiorFaces];
  const double D = state.carriedDiffusivity[m.low[face] * state.carriedCount() + scalar];
  if (!state.scalars[scalar].isStirred) return faces.density[face] * metric * D;
  return conductanceToWall(context_, state, properties, face, faces.density[face], D);
}

const std::vector<double>& CarriedTransport::diffusivities(const State& state) const {
  if (state.eddyViscosity.empty() || std::ranges::none_of(state.scalars, &CarriedScalar::isStirred))
    return state.carriedDiffusivity;
  diffusivity_ = state.carriedDiffusivity;
  const std::size_t n = state.scalars.size();
  for (std::size_t c = 0; c < state.eddyViscosity.size(); ++c)
    for (std::size_t s = 0; s < n; ++s)
      if (state.scalars[s].isStirred) diffusivity_[c * n + s] += eddyMixing(context_, state, c);
  return diffusivity_;
}

// What turbulence has at a boundary that holds it counts in its slopes beside it: there it may fall to nothing within
// the cell. What is stirred has layers there of which the cells see nothing.
void CarriedTransport::findHeld(const State& state, const ScalarBoundaries& boundaries) const {
  const Mesh& m = context_.mesh;
  const std::size_t n = state.scalars.size();
  known_.assign(static_cast<std::size_t>(m.boundaryFaces()) * n, BoundaryData::ZeroSlope);
  held_.assign(known_.size(), 0.0);
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const std::span<const ScalarBoundary> given = boundaries.at(face);
    for (std::size_t s = 0; s < n; ++s) {
      if (!given[s].isHeld || state.scalars[s].isStirred) continue;
      const std::size_t i = static_cast<std::size_t>(face - m.interiorFaces) * n + s;
      known_[i] = BoundaryData::Value;
      held_[i] = given[s].value;
    }
  }
}

void CarriedTransport::diffusiveFlux(const State& state, const FaceState& faces, const GasProperties& properties,
                                     std::span<double> conductance, std::span<double> flux) const {
  const Mesh& m = context_.mesh;
  const std::vector<double>& D = diffusivities(state);
  const int n = state.carriedCount();
  if (m.isOblique()) {
    perMass_.resize(static_cast<std::size_t>(m.cells) * n);
    for (int c = 0; c < m.cells; ++c)
      for (int s = 0; s < n; ++s) perMass_[c * n + s] = state.carried[c * n + s] / state.density[c];
    perMassGradient_.resize(perMass_.size() * m.dimension);
    if (known_.empty()) findHeld(state, faces.carriedBoundaries());
    gradient_.compute(perMass_, held_, n, perMassGradient_, known_);
    context_.halo.update(perMassGradient_, n * m.dimension);
  }
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    if (!faces.carriedBoundaries().holdsAny(face) || m.area[face] <= 0.0) continue;
    const std::span<const ScalarBoundary> given = faces.carriedBoundaries().at(face);
    const double eddies = eddiesToWall(context_, state, properties, face).resistance;
    for (int s = 0; s < n; ++s) {
      if (!given[s].isHeld) continue;
      const int i = m.low[face] * n + s;
      const double drift = state.scalars[s].thermophoresis * driftFlux_[face];
      const double diffusion = wallDiffusion(state, faces, properties, face, s);
      const double taken = takenByWall(drift, diffusion);
      const double passes = state.scalars[s].isStirred ? behindEddies(taken, eddies) : 1.0;
      double& g = conductance[face * n + s];
      g = taken * passes;
      flux[face * n + s] =
          g * state.carried[i] / state.density[m.low[face]] - takenByWall(-drift, diffusion) * passes * given[s].value;
      if (m.isOblique() && !state.scalars[s].isStirred)
        flux[face * n + s] -= g * m.distance[face] * faceSlope(m, face, m.oblique[face], perMassGradient_, n, s);
    }
  }
  for (int face = 0; face < m.interiorFaces; ++face) {
    const int low = m.low[face], high = m.high[face];
    const double w = m.lowWeight[face];
    const double metric = densityBetween(state, face) * m.area[face] / m.distance[face];
    for (int s = 0; s < n; ++s) {
      double& g = conductance[face * n + s];
      g = metric * (w * D[low * n + s] + (1.0 - w) * D[high * n + s]);
      flux[face * n + s] =
          g * (state.carried[low * n + s] / state.density[low] - state.carried[high * n + s] / state.density[high]);
      if (m.isOblique())
        flux[face * n + s] -= g * m.distance[face] * faceSlope(m, face, m.oblique[face], perMassGradient_, n, s);
    }
  }
  leaveOut(state, conductance);
  leaveOut(state, flux);
}

}  // namespace lampblack::flow
