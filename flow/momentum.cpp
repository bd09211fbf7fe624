#include "flow/momentum.hpp"

#include <algorithm>
#include <cmath>

#include "flow/limiter.hpp"

namespace lampblack::flow {
namespace {

// Whether the velocity component along `component` is given at this boundary face.
bool isGiven(const BoundaryCondition& boundary, bool normalComponent) {
  switch (boundary.kind) {
    case BoundaryKind::Inlet:
      return true;
    case BoundaryKind::Outlet:
      return false;
    case BoundaryKind::Symmetry:
      return normalComponent;
    case BoundaryKind::Wall:
      return normalComponent || !boundary.slip;
  }
  return false;
}

}  // namespace

Momentum::Momentum(const FlowContext& context)
    : context_(context), gradient_(context.mesh), diffusion_(context.mesh, context.halo), projection_(context) {
  const Mesh& m = context.mesh;
  boundaryVelocity_.resize(2 * m.boundaryFaces());
  boundaryPressure_.assign(m.boundaryFaces(), 0.0);
  velocityGradient_.resize(static_cast<std::size_t>(m.cells) * 4);
  pressureGradient_.resize(static_cast<std::size_t>(m.cells) * 2);
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const BoundaryCondition& boundary = context.boundaryOf(face);
    const bool isOutlet = boundary.kind == BoundaryKind::Outlet;
    pressureKnown_.push_back(isOutlet ? BoundaryData::Value : BoundaryData::Nothing);
    for (int i = 0; i < 2; ++i)
      velocityKnown_.push_back(isGiven(boundary, i == m.normalAxis[face]) ? BoundaryData::Value
                               : isOutlet                                 ? BoundaryData::Nothing
                                                                          : BoundaryData::ZeroSlope);
  }
  for (int i = 0; i < 2; ++i) {
    std::vector<BoundaryData> known;
    for (int b = 0; b < m.boundaryFaces(); ++b) known.push_back(velocityKnown_[2 * b + i]);
    upwind_.emplace_back(context, known);
  }
}

void Momentum::boundaryVelocities(const State& state) {
  const Mesh& m = context_.mesh;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const BoundaryCondition& boundary = context_.boundaryOf(face);
    for (int i = 0; i < 2; ++i) {
      const bool normal = i == m.normalAxis[face];
      double value = state.velocity[2 * m.low[face] + i];
      if (isGiven(boundary, normal)) value = normal ? -m.normalSign[face] * boundary.speed : 0.0;
      boundaryVelocity_[2 * (face - m.interiorFaces) + i] = value;
    }
  }
}

// Gas that leaves meets the ambient pressure, zero; gas that is drawn in has been accelerated from rest, so that its
// total pressure is zero (Bernoulli), which also keeps entrainment from running away.
void Momentum::outletPressures(const State& state) {
  const Mesh& m = context_.mesh;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const BoundaryCondition& boundary = context_.boundaryOf(face);
    if (boundary.kind != BoundaryKind::Outlet) continue;
    double pressure = 0.0;
    if (state.massFlux[face] < 0.0) {
      const double rho = context_.thermo.density(boundary.temperature, state.thermodynamicPressure, boundary.Y);
      const double velocity = state.massFlux[face] / (rho * m.area[face]);
      pressure = -0.5 * rho * velocity * velocity;
    }
    boundaryPressure_[face - m.interiorFaces] = pressure;
  }
}

void Momentum::pressureGradient(std::span<const double> pressure) {
  gradient_.compute(pressure, boundaryPressure_, 1, pressureGradient_, pressureKnown_);
}

void Momentum::explicitStress(const State& state, const GasProperties& properties) {
  // The part of the stress that the component-wise Laplacian leaves out: mu (grad u)^T - 2/3 mu (div u) I, and the hoop
  // stress's dilatation part.
  const Mesh& m = context_.mesh;
  const bool axisymmetric = m.axisymmetric();
  const auto dilatation = [&](int cell) {
    const double* g = &velocityGradient_[4 * cell];
    return g[0] + g[3] + (axisymmetric ? state.velocity[2 * cell] / m.centre[cell][0] : 0.0);
  };
  for (int face = 0; face < m.faces; ++face) {
    const int low = m.low[face];
    const int high = m.high[face] >= 0 ? m.high[face] : low;
    const double w = m.high[face] >= 0 ? m.lowWeight[face] : 1.0;
    const double mu = w * properties.viscosity[low] + (1.0 - w) * properties.viscosity[high];
    const int axis = m.normalAxis[face];
    const double divergence = w * dilatation(low) + (1.0 - w) * dilatation(high);
    for (int i = 0; i < 2; ++i) {
      // velocityGradient_[4 c + 2 j + i] is du_j/dx_i; the transposed part needs du_normal/dx_i.
      const double transposed =
          w * velocityGradient_[4 * low + 2 * axis + i] + (1.0 - w) * velocityGradient_[4 * high + 2 * axis + i];
      const double traction =
          m.normalSign[face] * mu * m.area[face] * (transposed - (i == axis ? 2.0 / 3.0 * divergence : 0.0));
      if (low < m.owned) source_[2 * low + i] += traction;
      if (m.high[face] >= 0 && m.high[face] < m.owned) source_[2 * m.high[face] + i] -= traction;
    }
  }
  if (!axisymmetric) return;
  for (int c = 0; c < m.owned; ++c)
    source_[2 * c] += 2.0 / 3.0 * properties.viscosity[c] * dilatation(c) * m.planarArea[c];
}

void Momentum::predict(State& state, const GasProperties& properties, std::span<const double> newDensity, double dt) {
  const Mesh& m = context_.mesh;
  boundaryVelocities(state);
  outletPressures(state);
  gradient_.compute(state.velocity, boundaryVelocity_, 2, velocityGradient_, velocityKnown_);
  context_.halo.update(velocityGradient_, 4);
  pressureGradient(state.pressure);

  diagonal_.assign(2 * m.owned, 0.0);
  source_.assign(2 * m.owned, 0.0);
  conductance_.assign(static_cast<std::size_t>(m.interiorFaces) * 2, 0.0);
  for (int c = 0; c < m.owned; ++c) {
    const double inertia = newDensity[c] * m.volume[c] / dt;
    for (int i = 0; i < 2; ++i) {
      diagonal_[2 * c + i] = inertia;
      source_[2 * c + i] = inertia * state.velocity[2 * c + i] - m.volume[c] * pressureGradient_[2 * c + i];
    }
    // Hoop stress 2 mu v_r / r^2 (its dilatation part is explicit).
    if (m.axisymmetric()) diagonal_[2 * c] += 2.0 * properties.viscosity[c] * m.planarArea[c] / m.centre[c][0];
  }
  for (int face = 0; face < m.faces; ++face) {
    const int low = m.low[face];
    const int high = m.high[face];
    const int axis = m.normalAxis[face];
    const double flux = state.massFlux[face];
    if (high >= 0) {
      const double mu =
          m.lowWeight[face] * properties.viscosity[low] + (1.0 - m.lowWeight[face]) * properties.viscosity[high];
      for (int i = 0; i < 2; ++i) {
        const Upwind u = upwind_[i].of(face, flux);
        const double value = limitedFaceValue(state.velocity[2 * u.up + i], state.velocity[2 * u.down + i],
                                              velocityGradient_[4 * u.up + 2 * i + axis] * u.sign, u);
        // Advective form: convection of the difference to the cell's own velocity.
        if (low < m.owned) source_[2 * low + i] -= flux * (value - state.velocity[2 * low + i]);
        if (high < m.owned) source_[2 * high + i] += flux * (value - state.velocity[2 * high + i]);
        conductance_[2 * face + i] = mu * m.area[face] / m.distance[face];
      }
      continue;
    }
    const BoundaryCondition& boundary = context_.boundaryOf(face);
    for (int i = 0; i < 2; ++i) {
      if (!isGiven(boundary, i == axis)) continue;
      const double value = boundaryVelocity_[2 * (face - m.interiorFaces) + i];
      const double conductance = properties.viscosity[low] * m.area[face] / m.distance[face];
      diagonal_[2 * low + i] += conductance;
      source_[2 * low + i] += conductance * value - flux * (value - state.velocity[2 * low + i]);
    }
  }
  explicitStress(state, properties);
  predicted_.assign(state.velocity.begin(), state.velocity.end());
  diffusion_.solve(2, diagonal_, conductance_, source_, predicted_);
}

Projection::Result Momentum::advance(State& state, const GasProperties& properties, std::span<const double> newDensity,
                                     std::span<const double> divergence, double dt, std::span<double> faceVelocity) {
  const Mesh& m = context_.mesh;
  predict(state, properties, newDensity, dt);
  // Take the old pressure gradient back, so that the projection finds the whole pressure.
  for (int c = 0; c < m.owned; ++c)
    for (int i = 0; i < 2; ++i) predicted_[2 * c + i] += dt / newDensity[c] * pressureGradient_[2 * c + i];
  context_.halo.update(predicted_, 2);

  std::vector<double> inverseDensity(m.faces);
  for (int face = 0; face < m.faces; ++face) {
    const int low = m.low[face];
    const int axis = m.normalAxis[face];
    if (m.high[face] >= 0) {
      const double w = m.lowWeight[face];
      const int high = m.high[face];
      inverseDensity[face] = 1.0 / (w * newDensity[low] + (1.0 - w) * newDensity[high]);
      faceVelocity[face] = w * predicted_[2 * low + axis] + (1.0 - w) * predicted_[2 * high + axis];
      continue;
    }
    inverseDensity[face] = 1.0 / newDensity[low];
    const BoundaryCondition& boundary = context_.boundaryOf(face);
    faceVelocity[face] = boundary.kind == BoundaryKind::Outlet  ? m.normalSign[face] * predicted_[2 * low + axis]
                         : boundary.kind == BoundaryKind::Inlet ? -boundary.speed
                                                                : 0.0;
  }
  const Projection::Result result =
      projection_.solve(dt, inverseDensity, divergence, boundaryPressure_, faceVelocity, state.pressure);
  pressureGradient(state.pressure);
  for (int c = 0; c < m.owned; ++c)
    for (int i = 0; i < 2; ++i)
      state.velocity[2 * c + i] = predicted_[2 * c + i] - dt / newDensity[c] * pressureGradient_[2 * c + i];
  context_.halo.update(state.velocity, 2);
  return result;
}

}  // namespace lampblack::flow
