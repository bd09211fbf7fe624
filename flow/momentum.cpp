#include "flow/momentum.hpp"

#include <algorithm>
#include <array>
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

Momentum::Momentum(const FlowContext& context, bool swirls)
    : context_(context),
      gradient_(context.mesh),
      diffusion_(context.mesh, context.halo),
      projection_(context),
      faceVelocity_(context) {
  const Mesh& m = context.mesh;
  boundaryVelocity_.resize(2 * m.boundaryFaces());
  boundaryPressure_.assign(m.boundaryFaces(), 0.0);
  velocityGradient_.resize(static_cast<std::size_t>(m.cells) * 4);
  pressureGradient_.resize(static_cast<std::size_t>(m.cells) * 2);
  acceleration_.resize(pressureGradient_.size());
  relaxation_.resize(static_cast<std::size_t>(m.cells));
  inverseDensity_.resize(static_cast<std::size_t>(m.faces));
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const BoundaryCondition& boundary = context.boundaryOf(face);
    const bool isOutlet = boundary.kind == BoundaryKind::Outlet;
    pressureKnown_.push_back(isOutlet                                  ? BoundaryData::Value
                             : boundary.kind == BoundaryKind::Symmetry ? BoundaryData::ZeroSlope
                                                                       : BoundaryData::Nothing);
    for (int i = 0; i < 2; ++i)
      velocityKnown_.push_back(isGiven(boundary, i == m.normalAxis[face]) ? BoundaryData::Value
                               : isOutlet                                 ? BoundaryData::Nothing
                                                                          : BoundaryData::ZeroSlope);
  }
  findOpposites();
  for (int i = 0; i < 2; ++i) {
    std::vector<BoundaryData> known;
    for (int b = 0; b < m.boundaryFaces(); ++b) known.push_back(velocityKnown_[2 * b + i]);
    upwind_.emplace_back(context, known);
  }
  if (swirls) swirl_.emplace(context, pressureKnown_);
}

void Momentum::findOpposites() {
  const Mesh& m = context_.mesh;
  opposite_.assign(m.boundaryFaces(), -1);
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const int cell = m.low[face];
    for (int j = m.faceStart[cell]; j < m.faceStart[cell + 1]; ++j) {
      const int other = m.faceOfCell[j];
      if (m.high[other] >= 0 && m.normalAxis[other] == m.normalAxis[face]) opposite_[face - m.interiorFaces] = other;
    }
  }
}

void Momentum::boundaryVelocities(const State& state) {
  const Mesh& m = context_.mesh;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const BoundaryCondition& boundary = context_.boundaryOf(face);
    const std::array<double, 2> given = context_.boundaryVelocity(face);
    for (int i = 0; i < 2; ++i) {
      const bool normal = i == m.normalAxis[face];
      double value = state.velocity[2 * m.low[face] + i];
      if (isGiven(boundary, normal)) value = normal ? -m.normalSign[face] * given[0] : given[1];
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
      const double rho = context_.thermo.density(context_.boundaryTemperature(face), state.thermodynamicPressure,
                                                 context_.boundaryY(face));
      const double velocity = state.massFlux[face] / (rho * m.area[face]);
      pressure = -0.5 * rho * velocity * velocity;
    }
    boundaryPressure_[face - m.interiorFaces] = pressure;
  }
}

void Momentum::explicitStress(const MomentumSweep& sweep) {
  // The part of the stress that the component-wise Laplacian leaves out: mu (grad u)^T - 2/3 mu (div u) I, and the hoop
  // stress's dilatation part.
  const Mesh& m = context_.mesh;
  const std::span<const double> viscosity = sweep.viscosity;
  const bool axisymmetric = m.axisymmetric();
  const auto dilatation = [&](int cell) {
    const double* g = &velocityGradient_[4 * cell];
    return g[0] + g[3] + (axisymmetric ? sweep.mean.velocity[2 * cell] / m.centre[cell][0] : 0.0);
  };
  const auto between = [&](int face, int axis, int i) {
    const double w = m.lowWeight[face];
    return w * velocityGradient_[4 * m.low[face] + 2 * axis + i] +
           (1.0 - w) * velocityGradient_[4 * m.high[face] + 2 * axis + i];
  };
  // The normal velocity's slope along an opening: on the line from the face on the cell's other side through its
  // centre. With the cell's own the force on it would be half of what it is.
  const auto transposedAt = [&](int face, int axis, int i) {
    if (m.high[face] >= 0) return between(face, axis, i);
    const double own = velocityGradient_[4 * m.low[face] + 2 * axis + i];
    const int opposite = opposite_[face - m.interiorFaces];
    return opposite < 0 || i == axis ? own : 2.0 * own - between(opposite, axis, i);
  };
  for (int face = 0; face < m.faces; ++face) {
    const int low = m.low[face];
    const int high = m.high[face] >= 0 ? m.high[face] : low;
    const double w = m.high[face] >= 0 ? m.lowWeight[face] : 1.0;
    const double mu = m.high[face] >= 0 ? w * viscosity[low] + (1.0 - w) * viscosity[high]
                                        : sweep.boundaryViscosity[face - m.interiorFaces];
    const int axis = m.normalAxis[face];
    const double divergence = w * dilatation(low) + (1.0 - w) * dilatation(high);
    // Along walls and symmetries the normal velocity stays zero.
    const bool isTight = m.high[face] < 0 && (context_.boundaryOf(face).kind == BoundaryKind::Wall ||
                                              context_.boundaryOf(face).kind == BoundaryKind::Symmetry);
    for (int i = 0; i < 2; ++i) {
      if (isTight && i != axis) continue;
      // velocityGradient_[4 c + 2 j + i] is du_j/dx_i; the transposed part needs du_normal/dx_i.
      const double transposed = transposedAt(face, axis, i);
      const double traction =
          m.normalSign[face] * mu * m.area[face] * (transposed - (i == axis ? 2.0 / 3.0 * divergence : 0.0));
      if (low < m.owned) source_[2 * low + i] += traction;
      if (m.high[face] >= 0 && m.high[face] < m.owned) source_[2 * m.high[face] + i] -= traction;
    }
  }
  if (!axisymmetric) return;
  for (int c = 0; c < m.owned; ++c) source_[2 * c] += 2.0 / 3.0 * viscosity[c] * dilatation(c) * m.planarArea[c];
}

void Momentum::predict(const State& state, const MomentumSweep& sweep) {
  const Mesh& m = context_.mesh;
  const std::vector<double>& density = sweep.start.density;
  const std::vector<double>& velocity = sweep.mean.velocity;
  const std::span<const double> viscosity = sweep.viscosity;
  boundaryVelocities(sweep.mean);
  outletPressures(sweep.mean);
  gradient_.compute(velocity, boundaryVelocity_, 2, velocityGradient_, velocityKnown_);
  context_.halo.update(velocityGradient_, 4);
  gradient_.compute(state.pressure, boundaryPressure_, 1, pressureGradient_, pressureKnown_);
  if (swirl_) swirl_->completeOuterSlopes(density, pressureGradient_);

  std::fill(relaxation_.begin(), relaxation_.end(), 0.0);
  diagonal_.assign(2 * m.owned, 0.0);
  source_.assign(2 * m.owned, 0.0);
  conductance_.assign(static_cast<std::size_t>(m.interiorFaces) * 2, 0.0);
  for (int c = 0; c < m.owned; ++c) {
    for (int i = 0; i < 2; ++i)
      source_[2 * c + i] = m.volume[c] * (context_.bodyForce(density[c], i) - pressureGradient_[2 * c + i]);
    if (swirl_) source_[2 * c] += m.volume[c] * density[c] * swirl_->centrifugal(c);
    // Hoop stress 2 mu v_r / r^2 (its dilatation part is explicit).
    if (m.axisymmetric()) diagonal_[2 * c] += 2.0 * viscosity[c] * m.planarArea[c] / m.centre[c][0];
  }
  for (int face = 0; face < m.faces; ++face) {
    const int low = m.low[face];
    const int high = m.high[face];
    const int axis = m.normalAxis[face];
    const double flux = sweep.mean.massFlux[face];
    if (high >= 0) {
      const double mu = m.lowWeight[face] * viscosity[low] + (1.0 - m.lowWeight[face]) * viscosity[high];
      for (int i = 0; i < 2; ++i) {
        const Upwind u = upwind_[i].of(face, flux);
        const double value = smoothFaceValue(velocity[2 * u.up + i], velocity[2 * u.down + i],
                                             velocityGradient_[4 * u.up + 2 * i + axis] * u.sign,
                                             velocityGradient_[4 * u.down + 2 * i + axis] * u.sign, u);
        // Advective form: convection of the difference to the cell's own velocity.
        if (low < m.owned) source_[2 * low + i] -= flux * (value - velocity[2 * low + i]);
        if (high < m.owned) source_[2 * high + i] += flux * (value - velocity[2 * high + i]);
        conductance_[2 * face + i] = mu * m.area[face] / m.distance[face];
      }
      for (const int cell : {low, high})
        if (cell < m.owned) relaxation_[cell] += conductance_[2 * face] + 0.5 * std::abs(flux);
      continue;
    }
    const BoundaryCondition& boundary = context_.boundaryOf(face);
    relaxation_[low] += 0.5 * std::abs(flux);
    for (int i = 0; i < 2; ++i) {
      if (!isGiven(boundary, i == axis)) continue;
      const double value = boundaryVelocity_[2 * (face - m.interiorFaces) + i];
      const double conductance = sweep.boundaryViscosity[face - m.interiorFaces] * m.area[face] / m.distance[face];
      diagonal_[2 * low + i] += conductance;
      relaxation_[low] += 0.5 * conductance;
      source_[2 * low + i] += conductance * value - flux * (value - velocity[2 * low + i]);
    }
  }
  for (int c = 0; c < m.owned; ++c) relaxation_[c] /= density[c] * m.volume[c];
  addLastSweepsViscosity(state, sweep);
  explicitStress(sweep);
  outletStress(sweep);
  for (int c = 0; c < m.owned; ++c) {
    const double inertia = density[c] * m.volume[c] / sweep.dt;
    for (int i = 0; i < 2; ++i) {
      diagonal_[2 * c + i] += inertia;
      source_[2 * c + i] += inertia * sweep.start.velocity[2 * c + i];
    }
  }
  predicted_.assign(state.velocity.begin(), state.velocity.end());
  diffusion_.solve(2, diagonal_, conductance_, source_, predicted_);
}

// What the implicit viscosity is corrected by, that the step's is the mean of its start and its end: half of the
// difference between the start and what the last sweep found as the end, none in the first sweep.
void Momentum::addLastSweepsViscosity(const State& state, const MomentumSweep& sweep) {
  excess_.resize(state.velocity.size());
  for (std::size_t i = 0; i < excess_.size(); ++i) excess_[i] = 0.5 * (sweep.start.velocity[i] - state.velocity[i]);
  diffusion_.subtract(2, diagonal_, conductance_, excess_, source_);
}

// At outlets the Laplacian part of the stress is that of the cell's own slope, and the gas that leaves has the velocity
// along it.
void Momentum::outletStress(const MomentumSweep& sweep) {
  const Mesh& m = context_.mesh;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    if (context_.boundaryOf(face).kind != BoundaryKind::Outlet) continue;
    const int c = m.low[face];
    for (int i = 0; i < 2; ++i) {
      const double slope = m.normalSign[face] * velocityGradient_[4 * c + 2 * i + m.normalAxis[face]];
      source_[2 * c + i] += sweep.viscosity[c] * m.area[face] * slope -
                            std::max(sweep.mean.massFlux[face], 0.0) * m.distance[face] * slope;
    }
  }
}

void Momentum::setInverseDensity(std::span<const double> density) {
  const Mesh& m = context_.mesh;
  for (int face = 0; face < m.faces; ++face) {
    const double w = m.high[face] >= 0 ? m.lowWeight[face] : 1.0;
    const double beyond = m.high[face] >= 0 ? density[m.high[face]] : 0.0;
    inverseDensity_[face] = 1.0 / (w * density[m.low[face]] + (1.0 - w) * beyond);
  }
}

void Momentum::balanceForces(State& state) {
  const Mesh& m = context_.mesh;
  setInverseDensity(state.density);
  // Velocities after falling for a second, which the pressure has to stop.
  std::vector<double> fall(static_cast<std::size_t>(m.faces), 0.0);
  for (int face = 0; face < m.faces; ++face)
    if (m.high[face] >= 0 || context_.boundaryOf(face).kind == BoundaryKind::Outlet)
      fall[face] = (m.high[face] >= 0 ? 1.0 : m.normalSign[face]) * inverseDensity_[face] *
                   context_.bodyForce(1.0 / inverseDensity_[face], m.normalAxis[face]);
  if (swirl_) {
    swirl_->setCentrifugal(state, state);
    for (int face = 0; face < m.interiorFaces; ++face)
      if (m.normalAxis[face] == 0)
        fall[face] += m.lowWeight[face] * swirl_->centrifugal(m.low[face]) +
                      (1.0 - m.lowWeight[face]) * swirl_->centrifugal(m.high[face]);
  }
  const std::vector<double> divergence(static_cast<std::size_t>(m.owned), 0.0);
  std::ranges::fill(state.pressure, 0.0);
  projection_.solve(1.0, inverseDensity_, divergence, fall, state.pressure);
}

Projection::Result Momentum::advance(State& state, const MomentumSweep& sweep, std::span<double> faceVelocity) {
  const Mesh& m = context_.mesh;
  const std::vector<double>& density = sweep.start.density;
  if (swirl_) swirl_->advance(state, sweep);
  predict(state, sweep);
  for (int c = 0; c < m.owned; ++c)
    for (int i = 0; i < 2; ++i)
      acceleration_[2 * c + i] = (pressureGradient_[2 * c + i] - context_.bodyForce(density[c], i)) / density[c];
  gradient_.compute(predicted_, boundaryVelocity_, 2, velocityGradient_, velocityKnown_);
  const FieldView known[] = {{predicted_, 2}, {acceleration_, 2}, {relaxation_, 1}};
  context_.halo.update(known);
  setInverseDensity(density);
  faceVelocity_.predict({predicted_, acceleration_, relaxation_, state.pressure, velocityGradient_}, inverseDensity_,
                        sweep.dt, faceVelocity);

  pressureChange_.assign(static_cast<std::size_t>(m.cells), 0.0);
  // A millionth of the velocity with which viscosity crosses a cell.
  double slowFlow = 0.0;
  for (int face = 0; face < m.interiorFaces; ++face)
    slowFlow = std::max(slowFlow, 1e-6 * conductance_[2 * face] * inverseDensity_[face]);
  const Projection::Result result =
      projection_.solve(sweep.dt, inverseDensity_, sweep.divergence, faceVelocity, pressureChange_, slowFlow);
  const std::vector<double> unchanged(boundaryPressure_.size(), 0.0);
  gradient_.compute(pressureChange_, unchanged, 1, pressureGradient_, pressureKnown_);
  for (int c = 0; c < m.owned; ++c)
    for (int i = 0; i < 2; ++i)
      state.velocity[2 * c + i] = predicted_[2 * c + i] - sweep.dt / density[c] * pressureGradient_[2 * c + i];
  for (int c = 0; c < m.cells; ++c) state.pressure[c] += pressureChange_[c];
  context_.halo.update(state.velocity, 2);
  faceVelocity_.take(state.velocity, faceVelocity);
  return result;
}

}  // namespace lampblack::flow
