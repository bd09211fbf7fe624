#include "flow/equations/momentum.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lampblack::flow {

Momentum::Momentum(const FlowContext& context, bool swirls, VelocityScheme scheme)
    : context_(context),
      dimension_(context.mesh.dimension),
      forces_(context, swirls, scheme),
      diffusion_(context.mesh, context.halo),
      projection_(context, forces_.pressureKnown()),
      faceVelocity_(context) {
  const Mesh& m = context.mesh;
  const auto d = static_cast<std::size_t>(dimension_);
  acceleration_.resize(static_cast<std::size_t>(m.cells) * d);
}

void Momentum::predict(const State& state, const MomentumSweep& sweep) {
  const Mesh& m = context_.mesh;
  const int d = dimension_;
  forces_.assemble(state, sweep);
  const std::span<double> diagonal = forces_.diagonal(), source = forces_.source();
  for (int c = 0; c < m.owned; ++c) {
    const double inertia = sweep.start.density[c] * m.volume[c] / sweep.dt;
    for (int i = 0; i < d; ++i) {
      diagonal[d * c + i] += inertia;
      source[d * c + i] += inertia * sweep.start.velocity[d * c + i];
    }
  }
  predicted_.assign(state.velocity.begin(), state.velocity.end());
  diffusion_.solve(d, diagonal, forces_.conductance(), source, predicted_);
}

std::vector<double> inverseFaceDensity(const Mesh& m, std::span<const double> density) {
  std::vector<double> inverse(static_cast<std::size_t>(m.faces));
  for (int face = 0; face < m.faces; ++face) {
    const double w = m.high[face] >= 0 ? m.lowWeight[face] : 1.0;
    const double beyond = m.high[face] >= 0 ? density[m.high[face]] : 0.0;
    inverse[face] = 1.0 / (w * density[m.low[face]] + (1.0 - w) * beyond);
  }
  return inverse;
}

void Momentum::balanceForces(State& state) {
  const Mesh& m = context_.mesh;
  inverseDensity_ = inverseFaceDensity(m, state.density);
  // Velocities after falling for a second, which the pressure has to stop.
  std::vector<double> fall(static_cast<std::size_t>(m.faces), 0.0);
  for (int face = 0; face < m.faces; ++face)
    if (m.high[face] >= 0 || context_.boundaryOf(face).kind == BoundaryKind::Outlet)
      fall[face] = inverseDensity_[face] * context_.bodyForce(1.0 / inverseDensity_[face], m.normal[face]);
  if (Swirl* swirl = forces_.swirl()) {
    swirl->setCentrifugal(state, state);
    for (int face = 0; face < m.interiorFaces; ++face)
      if (m.normal[face][0] != 0.0)
        fall[face] += m.lowWeight[face] * swirl->centrifugal(m.low[face]) +
                      (1.0 - m.lowWeight[face]) * swirl->centrifugal(m.high[face]);
  }
  const std::vector<double> divergence(static_cast<std::size_t>(m.owned), 0.0);
  std::ranges::fill(state.pressure, 0.0);
  projection_.solve(1.0, inverseDensity_, divergence, fall, state.pressure);
}

Projection::Result Momentum::advance(State& state, const MomentumSweep& sweep, std::span<double> faceVelocity) {
  const Mesh& m = context_.mesh;
  const std::vector<double>& density = sweep.start.density;
  if (Swirl* swirl = forces_.swirl()) swirl->advance(state, sweep);
  predict(state, sweep);
  const int d = dimension_;
  forces_.acceleration(density, acceleration_);
  VelocityGradient& gradient = forces_.gradient();
  gradient.compute(predicted_);
  const std::span<double> relaxation = forces_.relaxation();
  std::vector<FieldView> known{{predicted_, d}, {acceleration_, d}, {relaxation, 1}};
  if (m.isSkewed()) known.push_back({gradient.values(), d * d});
  context_.halo.update(known);
  inverseDensity_ = inverseFaceDensity(m, density);
  faceVelocity_.predict({predicted_, acceleration_, relaxation, state.pressure, gradient.values()}, inverseDensity_,
                        sweep.dt, faceVelocity);

  pressureChange_.assign(static_cast<std::size_t>(m.cells), 0.0);
  // A millionth of the velocity with which viscosity crosses a cell.
  double slowFlow = 0.0;
  for (int face = 0; face < m.interiorFaces; ++face)
    slowFlow = std::max(slowFlow, 1e-6 * forces_.conductance()[d * face] * inverseDensity_[face]);
  const Projection::Result result =
      projection_.solve(sweep.dt, inverseDensity_, sweep.divergence, faceVelocity, pressureChange_, slowFlow);
  const std::span<const double> slope = forces_.gradientOfChange(pressureChange_);
  for (int c = 0; c < m.owned; ++c)
    for (int i = 0; i < d; ++i)
      state.velocity[d * c + i] = predicted_[d * c + i] - sweep.dt / density[c] * slope[d * c + i];
  for (int c = 0; c < m.cells; ++c) state.pressure[c] += pressureChange_[c];
  context_.halo.update(state.velocity, d);
  faceVelocity_.take(state.velocity, faceVelocity);
  return result;
}

}  // namespace lampblack::flow
