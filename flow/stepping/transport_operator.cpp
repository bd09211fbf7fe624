#include "flow/stepping/transport_operator.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/flush_denormals.hpp"
#include "flow/cell_errors.hpp"
#include "flow/discretisation/face_fluxes.hpp"
#include "flow/field_registry.hpp"

namespace lampblack::flow {

TransportOperator::TransportOperator(const FlowContext& context, const State& state, Options options)
    : context_(context),
      options_(options),
      faces_(context, state),
      diffusion_(context.mesh, context.halo),
      speciesDiffusion_(context, diffusion_),
      heatConduction_(context, diffusion_),
      fluxes_(context, faces_, speciesDiffusion_),
      expansion_(context),
      momentum_(context, state.swirls, options.velocityScheme),
      carried_(context, state, diffusion_),
      movesForOthers_(std::ranges::any_of(state.scalars, [](const auto& scalar) { return !scalar.isTransported; })) {
  const auto faces = static_cast<std::size_t>(context.mesh.faces);
  const auto owned = static_cast<std::size_t>(context.mesh.owned);
  const auto n = static_cast<std::size_t>(state.species);
  properties_.resize(context, state);
  content_.resize(owned * n);
  heatContent_.resize(owned);
  newMass_.resize(owned);
  heat_ = {std::vector<double>(faces, 0.0), std::vector<double>(faces, 0.0)};
  boundaryFlux_.assign(static_cast<std::size_t>(context.mesh.boundaryFaces()) * n, 0.0);
  faceVelocity_.assign(faces, 0.0);
  boundaryFlows_.assign(3 * context.boundaries.size(), 0.0);
  row_.resize(n);
}

// What diffusion takes through the faces: `content_` has what it brings to the cells.
void TransportOperator::evaluateDiffusion(const State& state) {
  const Mesh& m = context_.mesh;
  collectively(m.comm, [&] { properties_.update(context_, state); });
  faces_.prepare(state, state.Y);
  speciesDiffusion_.prepare(state, properties_);
  std::ranges::fill(content_, 0.0);
  for (int face = 0; face < m.faces; ++face) {
    speciesDiffusion_.flux(face, state.Y, row_);
    heat_.enthalpy[face] = fluxes_.ofDiffusion(state, face, row_);
    addFaceFlux(m, face, row_, 1.0, content_);
    keepBoundaryFlux(face, row_);
  }
  heatConduction_.prepare(state, properties_);
  heatConduction_.presentFlux(state, heat_.heat);
}

void TransportOperator::keepBoundaryFlux(int face, std::span<const double> row) {
  const int b = face - context_.mesh.interiorFaces;
  if (b >= 0) std::ranges::copy(row, boundaryFlux_.begin() + b * static_cast<std::ptrdiff_t>(row.size()));
}

void TransportOperator::adopt(const State& state) {
  const Mesh& m = context_.mesh;
  evaluateDiffusion(state);
  for (int face = 0; face < m.faces; ++face) {
    faces_.interpolate(state, face, state.massFlux[face], row_);
    faceVelocity_[face] = m.area[face] > 0.0 ? state.massFlux[face] / (faces_.density[face] * m.area[face]) : 0.0;
  }
  findCarriedFlux(state);
  recordBoundary(state, 0.0);
}

void TransportOperator::findCarriedFlux(const State& state) {
  if (state.scalars.empty()) return;
  std::vector<double> flux(carried_.flux().size());
  carried_.presentFlux(state, {state, state, properties_.viscosity, faces_, faceVelocity_, {}, properties_, heat_.heat},
                       flux);
}

void TransportOperator::initialise(State& state, double dt) {
  const Mesh& m = context_.mesh;
  if (context_.varying) context_.varying->set(0.0, 0.0);
  state.updateHalo(context_.halo);
  std::fill(state.massFlux.begin(), state.massFlux.end(), 0.0);
  evaluateDiffusion(state);
  const auto divergence = expansion_.initial(state, properties_, content_, heat_);
  momentum_.balanceForces(state);
  const std::vector<double> weight = state.pressure;
  // So short that nothing but the pressure changes the velocity; that of the blow is not kept.
  momentum_.advance(
      state,
      {state, state, properties_.effectiveViscosity(), properties_.effectiveBoundaryViscosity(), divergence, 1e-6 * dt},
      faceVelocity_);
  momentum_.endStep();
  state.pressure = weight;
  for (int face = 0; face < m.faces; ++face) {
    faces_.interpolate(state, face, faceVelocity_[face], row_);
    state.massFlux[face] = faces_.density[face] * faceVelocity_[face] * m.area[face];
  }
  findCarriedFlux(state);
}

void TransportOperator::keepStart(const State& state) {
  start_ = state;
  // The widest: State::start has the mass fractions, and nobody asks for the rates.
  start_->start = {};
  for (const FieldDeclaration& field : fieldRegistry())
    if (field.kind == FieldDeclaration::Kind::Rate || field.width == FieldDeclaration::Width::Species)
      field.of(*start_) = {};
  mean_ = start_;
  startViscosity_ = properties_.viscosity;
  startEffectiveViscosity_ = properties_.effectiveViscosity();
  startBoundaryViscosity_ = properties_.effectiveBoundaryViscosity();
  startHeatFlux_.resize(heat_.heat.size());
  speciesDiffusion_.keepStart();
  heatConduction_.presentFlux(state, startHeatFlux_);
}

void TransportOperator::average(const State& state) {
  const auto mean = [](std::span<const double> start, std::span<const double> latest, std::span<double> result) {
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = 0.5 * (start[i] + latest[i]);
  };
  for (const FieldDeclaration& field : fieldRegistry()) {
    if (!field.isAveraged) continue;
    const std::vector<double>&start = field.start ? state.start.*field.start : field.of(*start_),
          &latest = field.of(state);
    field.of(*mean_).resize(latest.size());
    mean(start, latest, field.of(*mean_));
  }
  mean_->thermodynamicPressure = 0.5 * (start_->thermodynamicPressure + state.thermodynamicPressure);
  meanViscosity_.resize(startViscosity_.size());
  mean(startViscosity_, properties_.viscosity, meanViscosity_);
}

// Content of the owned cells at the step's end after the balance and convection by the mass flux of the last sweep or
// step.
void TransportOperator::predictContents(const State& start, const State& mean, const State& state, double dt) {
  const Mesh& m = context_.mesh;
  const int n = state.species;
  for (int c = 0; c < m.owned; ++c) {
    double gained = 0.0;
    state.balance.ofSpecies(static_cast<std::size_t>(c), row_);
    for (int k = 0; k < n; ++k) {
      const std::size_t i = static_cast<std::size_t>(c) * n + k;
      content_[i] = m.volume[c] * (start.density[c] * state.start.Y[i] + dt * row_[k]);
      gained += row_[k];
    }
    heatContent_[c] = m.volume[c] * (start.density[c] * start.enthalpy[c] + dt * state.balance.enthalpy[c]);
    newMass_[c] = m.volume[c] * (start.density[c] + dt * gained);
  }
  compression_ = 0.0;
  for (int face = 0; face < m.faces; ++face) {
    const double flux = state.massFlux[face];
    faces_.interpolate(mean, face, flux, row_);
    addFaceFlux(m, face, row_, dt * flux, content_);
    addFaceFlux(m, face, flux * faces_.enthalpy[face], dt, heatContent_);
    addFaceFlux(m, face, flux, dt, newMass_);
  }
}

// The mass flux of the projected velocities takes the place of that which the contents were predicted with.
void TransportOperator::correctContents(const State& mean, State& state, double dt) {
  const Mesh& m = context_.mesh;
  for (int face = 0; face < m.faces; ++face) {
    double& flux = state.massFlux[face];
    const double velocity = faceVelocity_[face];
    double heat = -flux * faces_.enthalpy[face];
    double excess = -flux;  // of what the new direction's upwind gas carries
    if ((velocity >= 0.0) != (flux >= 0.0)) {
      faces_.massFractions(face, flux, row_);
      addFaceFlux(m, face, row_, -dt * flux, content_);
      addFaceFlux(m, face, -flux, dt, newMass_);
      faces_.interpolate(mean, face, velocity, row_);
      excess = 0.0;
    } else {
      faces_.massFractions(face, velocity, row_);
    }
    flux = faces_.density[face] * velocity * m.area[face];
    excess += flux;
    addFaceFlux(m, face, row_, dt * excess, content_);
    addFaceFlux(m, face, excess, dt, newMass_);
    addFaceFlux(m, face, heat + flux * faces_.enthalpy[face], dt, heatContent_);
  }
}

// Work of the rising thermodynamic pressure on the gas of a closed vessel.
void TransportOperator::addCompression() {
  for (std::size_t c = 0; c < heatContent_.size(); ++c)
    heatContent_[c] += context_.mesh.volume[c] * (expansion_.pressureRise() - compression_);
  compression_ = expansion_.pressureRise();
}

// Diffusion and conduction of the sweep; from the second on corrected so that they become the mean of those at both
// ends.
void TransportOperator::advanceDiffusion(const State& mean, State& state, double dt) {
  const Mesh& m = context_.mesh;
  const bool several = options_.sweeps > 1, corrected = sweep_ > 1;
  if (corrected) expansion_.withdraw(state, properties_, diffused_, heat_);
  expansion_.beforeDiffusion(state, properties_, content_);
  if (several) diffused_ = content_;
  std::ranges::fill(heat_.enthalpy, 0.0);
  // In the first sweep the guess is the start, and the state has room for the solution.
  if (corrected) solution_.resize(state.Y.size());
  SpeciesDiffusion::Gas gas{state.start.Y, state.Y, newMass_, content_};
  if (corrected) gas = {state.Y, solution_, newMass_, content_, state.start.Y};
  diagnostics_.speciesIterations = speciesDiffusion_.advance(gas, dt, [&](int face, std::span<const double> row) {
    heat_.enthalpy[face] = fluxes_.ofDiffusion(mean, face, row);
    keepBoundaryFlux(face, row);
  });
  if (several)
    for (std::size_t i = 0; i < diffused_.size(); ++i) diffused_[i] = (content_[i] - diffused_[i]) / dt;
  addFaceFluxes(m, heat_.enthalpy, 1, dt, heatContent_);

  std::vector<double> extra;
  if (corrected) {
    extra = startHeatFlux_;
    heatConduction_.presentFlux(state, heat_.heat);
    for (std::size_t i = 0; i < extra.size(); ++i) extra[i] = 0.5 * (extra[i] - heat_.heat[i]);
    addFaceFluxes(m, extra, 1, dt, heatContent_);
  }
  std::function<bool(int)> isCoupled;
  if (couples_) isCoupled = [this](int c) { return takesCoupled(c); };
  heatConduction_.implicitFlux(state, {newMass_, content_, heatContent_}, dt, heat_.heat, isCoupled);
  addFaceFluxes(m, heat_.heat, 1, dt, heatContent_);
  for (std::size_t i = 0; i < extra.size(); ++i) heat_.heat[i] += extra[i];
}

void TransportOperator::finish(State& state) {
  const Mesh& m = context_.mesh;
  const int n = state.species;
  // A temperature out of range on one rank must stop all of them.
  inEachCell(m, [&](int c) {
    const double* content = &content_[static_cast<std::size_t>(c) * n];
    double mass = 0.0;
    for (int k = 0; k < n; ++k) mass += content[k];
    double* y = &state.Y[static_cast<std::size_t>(c) * n];
    for (int k = 0; k < n; ++k) y[k] = content[k] / mass;
    state.density[c] = mass / m.volume[c];
    state.enthalpy[c] = heatContent_[c] / mass;
    state.temperature[c] = context_.thermo.temperatureFromEnthalpy(state.enthalpy[c], {y, static_cast<std::size_t>(n)},
                                                                   state.temperature[c]);
  });
}

void TransportOperator::advance(State& state, double time, double dt) {
  const FlushDenormals flush;
  const Mesh& m = context_.mesh;
  const bool first = ++sweep_ == 1;
  const bool several = options_.sweeps > 1;
  // The gas's boundaries at the middle of its step, those of the velocities at the middle of theirs.
  if (first && context_.varying) context_.varying->set(time + 0.5 * dt, time + 0.25 * (dt - lastStep_));
  collectively(m.comm, [&] { properties_.update(context_, state); });
  using Sweep = Expansion::Sweep;
  expansion_.begin(state, properties_, !first ? Sweep::Later : several ? Sweep::First : Sweep::Only, dt, lastStep_);
  speciesDiffusion_.prepare(state, properties_);
  heatConduction_.prepare(state, properties_);
  if (first) state.keepStart();
  if (several && first) keepStart(state);
  if (several) average(state);
  const State& start = several ? *start_ : state;
  const State& mean = several ? *mean_ : state;
  // The state's own mass fractions are written over before the step is done with them.
  faces_.prepare(mean, several ? mean.Y : state.start.Y);

  coupleReactions(mean, state, time, dt);
  predictContents(start, mean, state, dt);
  if (!first) addCompression();
  advanceDiffusion(mean, state, dt);

  // Velocity, pressure and mass flux for exactly this diffusion.
  const auto divergence = expansion_.complete(state, properties_, content_, heat_, first);
  const std::vector<double>& startViscosity = several ? startEffectiveViscosity_ : properties_.effectiveViscosity();
  const std::vector<double>& boundaryViscosity =
      several ? startBoundaryViscosity_ : properties_.effectiveBoundaryViscosity();
  const auto projected = momentum_.advance(
      state, {start, mean, startViscosity, boundaryViscosity, divergence, 0.5 * (lastStep_ + dt)}, faceVelocity_);
  diagnostics_.continuityError = projected.continuityError;
  diagnostics_.pressureIterations = projected.iterations;

  correctContents(mean, state, dt);
  addCompression();
  const std::vector<double>& meanViscosity = several ? meanViscosity_ : properties_.viscosity;
  carried_.advance(state, {start, mean, meanViscosity, faces_, faceVelocity_, newMass_, properties_, heat_.heat}, dt);
  if (sweep_ == options_.sweeps) recordBoundary(state, dt);
  finish(state);
  state.thermodynamicPressure = state.start.thermodynamicPressure + expansion_.pressureRise();
  state.updateHalo(context_.halo);
  if (sweep_ < options_.sweeps) return;
  sweep_ = 0;
  lastStep_ = dt;
  momentum_.endStep();
  for (const auto& watcher : watchers_) watcher(boundary_);
}

}  // namespace lampblack::flow
