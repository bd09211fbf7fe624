#include "flow/carried_transport.hpp"

#include <algorithm>

#include "flow/face_fluxes.hpp"

namespace lampblack::flow {

void CarriedTransport::advance(State& state, const GasProperties& properties, const FaceState& faces,
                               std::span<const double> faceVelocity, std::span<const double> newMass, double dt) {
  const Mesh& m = context_.mesh;
  const int n = state.carriedCount();
  if (n == 0) return;
  const auto temperatureGradient = faces.temperatureGradient();
  for (int face = 0; face < m.faces; ++face) {
    double* flux = &flux_[static_cast<std::size_t>(face) * n];
    std::fill_n(flux, n, 0.0);
    const int low = m.low[face];
    const int high = m.high[face];
    if (m.area[face] <= 0.0) continue;
    if (high < 0) {
      // Particles leave with the gas; nothing enters with it, and walls take none.
      if (state.massFlux[face] > 0.0)
        for (int s = 0; s < n; ++s) flux[s] = state.massFlux[face] * state.carried[low * n + s] / state.density[low];
      continue;
    }
    const double w = m.lowWeight[face];
    const int axis = m.normalAxis[face];
    const auto mean = [&](const std::vector<double>& field) { return w * field[low] + (1.0 - w) * field[high]; };
    const double slope = w * temperatureGradient[2 * low + axis] + (1.0 - w) * temperatureGradient[2 * high + axis];
    const double drift = -mean(properties.viscosity) / mean(state.density) * slope / mean(state.temperature);
    for (int s = 0; s < n; ++s) {
      const double velocity = faceVelocity[face] + state.scalars[s].thermophoresis * drift;
      flux[s] = faces.density[face] * m.area[face] * velocity * faces.carriedPerMass(face, s, velocity);
    }
  }
  std::vector<double> content(static_cast<std::size_t>(m.owned) * n);
  for (int c = 0; c < m.owned; ++c)
    for (int s = 0; s < n; ++s)
      content[c * n + s] = m.volume[c] * (state.carried[c * n + s] + dt * state.balance.carried[c * n + s]);
  addFaceFluxes(m, flux_, n, dt, content);
  diffuse(state, faces, newMass, dt, content);
  for (int c = 0; c < m.owned; ++c)
    for (int s = 0; s < n; ++s) state.carried[c * n + s] = content[c * n + s] / m.volume[c];
}

// Implicit: particles of a nucleus's size diffuse almost like molecules.
void CarriedTransport::diffuse(const State& state, const FaceState& faces, std::span<const double> newMass, double dt,
                               std::span<double> content) {
  const Mesh& m = context_.mesh;
  const int n = state.carriedCount();
  std::vector<double> diagonal(content.size());
  std::vector<double> conductance(static_cast<std::size_t>(m.interiorFaces) * n);
  std::vector<double> perMass(static_cast<std::size_t>(m.cells) * n);
  std::vector<double> source(content.size());
  for (int c = 0; c < m.owned; ++c)
    for (int s = 0; s < n; ++s) {
      diagonal[c * n + s] = newMass[c] / dt;
      source[c * n + s] = content[c * n + s] / dt;
      perMass[c * n + s] = state.carried[c * n + s] / state.density[c];
    }
  for (int face = 0; face < m.interiorFaces; ++face) {
    const double w = m.lowWeight[face];
    const double metric = faces.density[face] * m.area[face] / m.distance[face];
    for (int s = 0; s < n; ++s)
      conductance[face * n + s] = metric * (w * state.carriedDiffusivity[m.low[face] * n + s] +
                                            (1.0 - w) * state.carriedDiffusivity[m.high[face] * n + s]);
  }
  // Particles see how much there is of them where there is next to nothing.
  diffusion_.solve(n, diagonal, conductance, source, perMass, 1e-8);
  std::vector<double> flux(flux_.size(), 0.0);
  for (int face = 0; face < m.interiorFaces; ++face)
    for (int s = 0; s < n; ++s)
      flux[face * n + s] = conductance[face * n + s] * (perMass[m.low[face] * n + s] - perMass[m.high[face] * n + s]);
  addFaceFluxes(m, flux, n, dt, content);
}

}  // namespace lampblack::flow
