#include "flow/steady/flow_update.hpp"

#include <algorithm>
#include <cmath>

#include "flow/discretisation/upwind.hpp"
#include "flow/discretisation/velocity_gradient.hpp"

namespace lampblack::flow {
namespace {

constexpr double flowReduction = 0.03;
constexpr int mostFlowIterations = 60;
// What a pass leaves of continuity where eddies stir, with which momentum is another in the next one anyway. Flames
// take a fifth more iterations with it.
constexpr double leftByEddies = 0.1;

}  // namespace

FlowUpdate::FlowUpdate(const FlowContext& context, const State& state, FlowResidual& residual)
    : context_(context),
      residual_(residual),
      d_(static_cast<std::size_t>(state.dimension)),
      fields_(d_ + (state.swirls ? 1 : 0)),
      system_(context.mesh, context.halo, fields_),
      projection_(context, residual.forces().pressureKnown(),
                  {.ofLeft = state.eddyViscosity.empty() ? PressureAccuracy{}.ofLeft : leftByEddies}) {
  const auto cells = static_cast<std::size_t>(context.mesh.cells), owned = static_cast<std::size_t>(context.mesh.owned);
  const auto faces = static_cast<std::size_t>(context.mesh.faces);
  right_.resize(owned * fields_);
  rise_.resize(cells * fields_);
  change_.resize(cells);
  inverse_.resize(owned);
  response_.resize(cells);
  share_.resize(cells);
  for (std::vector<double>* all : {&faceResponse_, &faceShare_, &faceFlux_, &flux_}) all->resize(faces);
  divergence_.resize(owned);
}

void FlowUpdate::assemble(const State& state, std::span<const double> inertia) {
  const Mesh& m = context_.mesh;
  MomentumForces& forces = residual_.forces();
  system_.clear();
  for (int c = 0; c < m.owned; ++c) {
    const auto cell = static_cast<std::size_t>(c);
    double* block = system_.block(c);
    for (std::size_t i = 0; i < d_; ++i) block[i * (fields_ + 1)] += forces.diagonal()[cell * d_ + i];
    if (state.swirls) block[d_ * (fields_ + 1)] += forces.diagonal()[cell * d_ + 1];
    system_.addInertia(c, inertia[c]);
  }
  for (int face = 0; face < m.faces; ++face) {
    const bool isInside = m.high[face] >= 0;
    // Where nothing is given beyond a boundary, velocities there are the cell's.
    if (!isInside && givenVelocity(context_.boundaryOf(face)) == GivenVelocity::Nothing) continue;
    for (std::size_t i = 0; i < fields_; ++i) {
      const std::size_t component = std::min(i, d_ - 1);
      const double g = isInside ? forces.conductance()[static_cast<std::size_t>(face) * d_ + component] : 0.0;
      system_.connect(face, i, g, state.massFlux[face]);
    }
  }
}

void FlowUpdate::findResponses(const State& state, std::span<const double> inertia) {
  const Mesh& m = context_.mesh;
  const std::span<const double> relaxation = residual_.forces().relaxation();
  through_ = 0.0;
  for (const double flow : state.massFlux) through_ = std::max(through_, std::abs(flow));
  for (int c = 0; c < m.owned; ++c) {
    const double step = state.density[c] * m.volume[c] / inertia[c];
    response_[c] = step;
    share_[c] = step * relaxation[c] / (1.0 + step * relaxation[c]);
    inverse_[c] = 1.0 / state.density[c];
  }
  std::vector<FieldView> known{{response_, 1}, {share_, 1}};
  context_.halo.update(known);
  for (int face = 0; face < m.faces; ++face) {
    const auto low = static_cast<std::size_t>(m.low[face]);
    const bool isInside = m.high[face] >= 0;
    const std::size_t high = isInside ? static_cast<std::size_t>(m.high[face]) : low;
    const double w = isInside ? m.lowWeight[face] : 1.0;
    const bool isOpen = isInside || context_.boundaryOf(face).kind == BoundaryKind::Outlet;
    const double density = residual_.faces().density[face];
    // What goes through an outlet has the velocity of its cell, whose gas may be far lighter than what is drawn in: the
    // flux follows the pressure by as much more than the cell's momentum.
    const double denser = !isInside && isOpen ? density / state.density[low] : 1.0;
    // Gas that is drawn in through an outlet lowers the pressure there, by its velocity for each change of its flow.
    double holds = 1.0;
    if (!isInside && isOpen && state.massFlux[face] < 0.0)
      holds += denser * response_[low] / m.distance[face] * -state.massFlux[face] / (density * m.area[face]);
    faceShare_[face] = (isInside ? w * share_[low] + (1.0 - w) * share_[high] : 1.0) / holds;
    faceFlux_[face] = isOpen ? density / holds : 0.0;
    faceResponse_[face] = denser * (w * response_[low] + (1.0 - w) * response_[high]) / holds;
  }
}

// Velocities and mass fluxes under the pressure there is, and the pressure that takes what is left of the mass away.
FlowUpdate::Result FlowUpdate::advance(State& state, std::span<const double> inertia) {
  const Mesh& m = context_.mesh;
  const FlowResidual::Rates& rates = residual_.rates();
  assemble(state, inertia);
  system_.factorise();
  findResponses(state, inertia);
  for (std::size_t c = 0; c < static_cast<std::size_t>(m.owned); ++c) {
    for (std::size_t i = 0; i < d_; ++i) right_[c * fields_ + i] = rates.momentum[c * d_ + i];
    if (state.swirls) right_[c * fields_ + d_] = rates.angularMomentum[c] / m.centre[c][0];
  }
  Result result;
  result.iterations = system_.solve(right_, rise_, flowReduction, mostFlowIterations).iterations;
  for (int face = 0; face < m.faces; ++face) {
    const auto low = static_cast<std::size_t>(m.low[face]);
    const bool isInside = m.high[face] >= 0;
    const std::size_t high = isInside ? static_cast<std::size_t>(m.high[face]) : low;
    const double w = isInside ? m.lowWeight[face] : 1.0;
    double rises = 0.0;
    for (std::size_t i = 0; i < d_; ++i)
      rises += m.normal[face][i] * (w * rise_[low * fields_ + i] + (1.0 - w) * rise_[high * fields_ + i]);
    const double area = m.area[face];
    flux_[face] = area > 0.0 ? faceShare_[face] * rates.massFlux[face] / area + faceFlux_[face] * rises : 0.0;
  }
  for (int c = 0; c < m.owned; ++c) divergence_[c] = rates.mass[c] / m.volume[c];

  std::ranges::fill(change_, 0.0);
  result.pressureIterations = projection_.solve(1.0, faceResponse_, divergence_, flux_, change_, through_).iterations;
  const std::span<const double> slope = residual_.forces().gradientOfChange(change_);
  for (std::size_t c = 0; c < static_cast<std::size_t>(m.owned); ++c) {
    for (std::size_t i = 0; i < d_; ++i)
      state.velocity[c * d_ + i] += rise_[c * fields_ + i] - response_[c] * inverse_[c] * slope[c * d_ + i];
    if (state.swirls) state.swirl[c] += rise_[c * fields_ + d_];
  }
  for (int c = 0; c < m.cells; ++c) state.pressure[c] += change_[c];
  for (int face = 0; face < m.faces; ++face) state.massFlux[face] += flux_[face] * m.area[face];
  state.updateHalo(context_.halo);
  return result;
}

}  // namespace lampblack::flow
