#include "flow/equations/carried_transport.hpp"

#include <algorithm>

#include "flow/boundaries/wall_flux.hpp"
#include "flow/discretisation/face_fluxes.hpp"
#include "flow/properties/wall_transfer.hpp"

namespace lampblack::flow {
// Those that their owner moves have no fluxes here; `perFace`: a value a scalar of each face.
void CarriedTransport::leaveOut(const State& state, std::span<double> perFace) {
  for (std::size_t s = 0; s < state.scalars.size(); ++s)
    if (!state.scalars[s].isTransported)
      for (std::size_t i = s; i < perFace.size(); i += state.scalars.size()) perFace[i] = 0.0;
}

bool CarriedTransport::hasDriftToWall(const FaceState& faces, int face) const {
  return context_.mesh.area[face] > 0.0 && context_.boundaryOf(face).kind == BoundaryKind::Wall &&
         (context_.takesParticles(face) || faces.carriedBoundaries().holdsAny(face));
}

void CarriedTransport::findDrift(const Gas& gas) {
  const Mesh& m = context_.mesh;
  const auto temperatureGradient = gas.faces.temperatureGradient();
  for (int face = 0; face < m.interiorFaces; ++face) {
    const int low = m.low[face], high = m.high[face];
    const double w = m.lowWeight[face];
    const auto mean = [&](std::span<const double> field) { return w * field[low] + (1.0 - w) * field[high]; };
    const double slope = faceSlope(m, face, m.normal[face], temperatureGradient);
    driftFlux_[face] = -m.area[face] * mean(gas.viscosity) * slope / mean(gas.mean.temperature);
    faceDensity_[face] = densityBetween(gas.mean, face);
  }
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    driftFlux_[face] = hasDriftToWall(gas.faces, face) ? driftToWall(gas, face) : 0.0;
    faceDensity_[face] = gas.faces.density[face];
  }
}

// -A mu (grad T . n)/T at the end of the still layer at a wall, by the heat that the wall takes: viscosity
// over conductivity hardly changes with the temperature.
double CarriedTransport::driftToWall(const Gas& gas, int face) const {
  const Mesh& m = context_.mesh;
  const int b = face - m.interiorFaces;
  const double conductivity = gas.properties.boundaryConductivity[b], inCell = gas.mean.temperature[m.low[face]];
  double T = context_.boundaryTemperature(face);
  if (!context_.isTemperatureGiven(face))
    T = inCell - gas.heat[face] / m.area[face] * m.distance[face] / gas.properties.effectiveBoundaryConductivity()[b];
  T += (inCell - T) * (1.0 - eddiesToWall(context_, gas.mean, gas.properties, face).ofHeat);
  return gas.properties.boundaryViscosity[b] / conductivity * gas.heat[face] / T;
}

void CarriedTransport::convectiveFlux(const State& state, const Gas& gas) {
  const Mesh& m = context_.mesh;
  const int n = state.carriedCount();
  for (int face = 0; face < m.faces; ++face) {
    double* flux = &flux_[static_cast<std::size_t>(face) * n];
    std::fill_n(flux, n, 0.0);
    const int low = m.low[face];
    if (m.area[face] <= 0.0) continue;
    if (m.high[face] < 0) {
      // What walls take is implicit but for how scalars outside the layer in which they diffuse to the wall change over
      // the half cell.
      const double gasFlux = state.massFlux[face];
      const std::span<const ScalarBoundary> given = gas.faces.carriedBoundaries().at(face);
      if (gasFlux > 0.0)
        for (int s = 0; s < n; ++s) flux[s] = gasFlux * gas.mean.carried[low * n + s] / gas.mean.density[low];
      if (gasFlux < 0.0)
        for (int s = 0; s < n; ++s) flux[s] = gasFlux * given[s].value;
      if (gas.faces.carriedBoundaries().holdsAny(face) && context_.boundaryOf(face).kind == BoundaryKind::Wall) {
        // Nothing flows through these. What eddies mix does not follow the slope in the cell.
        const bool hasEddies = eddiesToWall(context_, gas.mean, gas.properties, face).resistance > 0.0;
        for (int s = 0; s < n; ++s) {
          if (!given[s].isHeld || (hasEddies && state.scalars[s].isStirred)) continue;
          const double drift = state.scalars[s].thermophoresis * driftFlux_[face];
          const double share = outsideWallLayer(drift, wallDiffusion(state, gas.faces, gas.properties, face, s));
          if (share > 0.0) flux[s] = drift * share * gas.faces.carriedRiseToWall(face, s);
        }
      }
      continue;
    }
    const double gasFlux = gas.faces.density[face] * m.area[face] * gas.faceVelocity[face];
    for (int s = 0; s < n; ++s) {
      const double carrying = gasFlux + state.scalars[s].thermophoresis * driftFlux_[face];
      flux[s] = carrying * gas.faces.carriedPerMass(face, s, carrying);
    }
  }
  leaveOut(state, flux_);
}

void CarriedTransport::advance(State& state, const Gas& gas, double dt) {
  const Mesh& m = context_.mesh;
  const int n = state.carriedCount();
  if (n == 0) return;
  findDrift(gas);
  if (std::ranges::none_of(state.scalars, &CarriedScalar::isTransported)) return;
  convectiveFlux(state, gas);
  std::vector<double> content(static_cast<std::size_t>(m.owned) * n);
  for (int c = 0; c < m.owned; ++c)
    for (int s = 0; s < n; ++s)
      content[c * n + s] = m.volume[c] * (gas.start.carried[c * n + s] + dt * state.balance.carried[c * n + s]);
  addFaceFluxes(m, flux_, n, dt, content);
  diffuse(state, gas, dt, content);
  for (int c = 0; c < m.owned; ++c)
    for (int s = 0; s < n; ++s)
      if (state.scalars[s].isTransported) state.carried[c * n + s] = content[c * n + s] / m.volume[c];
}

void CarriedTransport::presentFlux(const State& state, const Gas& gas, std::span<double> flux) {
  findDrift(gas);
  convectiveFlux(state, gas);
  std::vector<double> conductance(flux.size());
  std::ranges::fill(flux, 0.0);
  diffusiveFlux(state, gas.faces, gas.properties, conductance, flux);
  for (std::size_t i = 0; i < flux.size(); ++i) flux[i] += flux_[i];
  const auto boundary = static_cast<std::ptrdiff_t>(firstOfBoundary());
  std::copy(flux.begin() + boundary, flux.end(), flux_.begin() + boundary);
}

std::size_t CarriedTransport::firstOfBoundary() const {
  const Mesh& m = context_.mesh;
  return flux_.size() / static_cast<std::size_t>(m.faces) * static_cast<std::size_t>(m.interiorFaces);
}

// Through the boundary, beside what is there already.
void CarriedTransport::addCrossed(std::span<const double> flux) {
  for (std::size_t i = firstOfBoundary(); i < flux.size(); ++i) flux_[i] += flux[i];
}

// From rates to changes. Each block by itself: how one is iterated does not depend on what is beside it.
void CarriedTransport::solveChanges(const State& state, std::span<const double> inertia,
                                    std::span<const double> conductance, std::span<const double> sinks,
                                    std::span<double> change) {
  const auto n = static_cast<std::size_t>(state.carriedCount()), cells = static_cast<std::size_t>(context_.mesh.cells);
  std::vector<double> own, ownSinks;
  for (const ScalarRange& block : state.blocks) {
    const auto first = static_cast<std::size_t>(block.first), count = static_cast<std::size_t>(block.count);
    if (std::ranges::none_of(std::span(state.scalars).subspan(first, count), &CarriedScalar::isTransported)) continue;
    const auto through = [&](int face, std::span<const int> scalars, double* g) {
      const double* ofBlock = &conductance[static_cast<std::size_t>(face) * n + first];
      for (std::size_t i = 0; i < scalars.size(); ++i) g[i] = ofBlock[scalars[i]];
    };
    own.resize(cells * count);
    for (std::size_t c = 0; c < cells; ++c) std::copy_n(&change[c * n + first], count, &own[c * count]);
    ownSinks.resize(sinks.empty() ? 0 : inertia.size() * count);
    for (std::size_t c = 0; c < inertia.size() && !sinks.empty(); ++c)
      std::copy_n(&sinks[c * n + first], count, &ownSinks[c * count]);
    // Particles see how much there is of them where there is next to nothing.
    diffusion_.changes(block.count, inertia, through, own, 1e-8, 100000, ownSinks);
    for (std::size_t c = 0; c < cells; ++c) std::copy_n(&own[c * count], count, &change[c * n + first]);
  }
}

// Implicit: particles of a nucleus's size diffuse almost like molecules. From the second sweep on corrected so that it
// becomes the mean of the diffusion at both ends of the step.
void CarriedTransport::diffuse(const State& state, const Gas& gas, double dt, std::span<double> content) {
  const Mesh& m = context_.mesh;
  const int n = state.carriedCount();
  std::vector<double> conductance(flux_.size());
  std::vector<double> flux(flux_.size(), 0.0), startFlux(flux_.size(), 0.0);
  if (&gas.start != &state) {
    diffusiveFlux(gas.start, gas.faces, gas.properties, conductance, startFlux);
    diffusiveFlux(state, gas.faces, gas.properties, conductance, flux);
    for (std::size_t i = 0; i < flux.size(); ++i) flux[i] = 0.5 * (startFlux[i] - flux[i]);
    addFaceFluxes(m, flux, n, dt, content);
    addCrossed(flux);
  }
  diffusiveFlux(state, gas.faces, gas.properties, conductance, flux);
  // At what rate the contents change by everything else and by the guess's diffusion and sinks.
  const std::vector<double>& sink = state.balance.carriedSink;
  std::vector<double> sinks;  // kg/s
  if (std::ranges::any_of(sink, [](double rate) { return rate != 0.0; })) sinks = sink;
  std::vector<double> inertia(static_cast<std::size_t>(m.owned));
  std::vector<double> perMass(static_cast<std::size_t>(m.cells) * n);
  for (int c = 0; c < m.owned; ++c) {
    inertia[c] = gas.newMass[c] / dt;
    for (int s = 0; s < n; ++s)
      perMass[c * n + s] = content[c * n + s] / dt - inertia[c] * state.carried[c * n + s] / state.density[c];
    for (int s = 0; s < n && !sinks.empty(); ++s) {
      sinks[c * n + s] *= gas.newMass[c];
      perMass[c * n + s] -= sinks[c * n + s] * state.carried[c * n + s] / state.density[c];
    }
  }
  addFaceFluxes(m, flux, n, 1.0, perMass);
  solveChanges(state, inertia, conductance, sinks, perMass);
  for (std::size_t i = 0; i < sinks.size(); ++i) {
    const std::size_t c = i / state.scalars.size();
    content[i] -= dt * sinks[i] * (state.carried[i] / state.density[c] + perMass[i]);
  }
  for (int face = 0; face < m.interiorFaces; ++face)
    for (int s = 0; s < n; ++s)
      flux[face * n + s] += conductance[face * n + s] * (perMass[m.low[face] * n + s] - perMass[m.high[face] * n + s]);
  for (int face = m.interiorFaces; face < m.faces; ++face)
    for (int s = 0; s < n; ++s) flux[face * n + s] += conductance[face * n + s] * perMass[m.low[face] * n + s];
  addFaceFluxes(m, flux, n, dt, content);
  // Where a sink takes more than there is, the balance is a difference of what is far larger than what is left: there
  // the sink has taken what the solution leaves over.
  for (std::size_t i = 0; i < sinks.size(); ++i) {
    const std::size_t c = i / state.scalars.size();
    if (sinks[i] * dt > gas.newMass[c])
      content[i] = gas.newMass[c] * (state.carried[i] / state.density[c] + perMass[i]);
  }
  addCrossed(flux);
}

}  // namespace lampblack::flow
