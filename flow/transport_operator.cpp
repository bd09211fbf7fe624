#include "flow/transport_operator.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/flush_denormals.hpp"
#include "flow/face_fluxes.hpp"
#include "flow/time_step.hpp"

namespace lampblack::flow {
namespace {

// flux += (start - latest) / 2
void addHalfDifference(std::span<const double> start, std::span<const double> latest, std::span<double> flux) {
  for (std::size_t i = 0; i < flux.size(); ++i) flux[i] += 0.5 * (start[i] - latest[i]);
}

}  // namespace

TransportOperator::TransportOperator(const FlowContext& context, const State& state, Options options)
    : context_(context),
      options_(options),
      faces_(context, state.species, state.carriedCount()),
      speciesDiffusion_(context),
      heatConduction_(context),
      expansion_(context),
      momentum_(context, state.swirls),
      carried_(context, state.carriedCount()) {
  const auto faces = static_cast<std::size_t>(context.mesh.faces);
  const auto owned = static_cast<std::size_t>(context.mesh.owned);
  content_.resize(owned * state.species);
  heatContent_.resize(owned);
  newMass_.resize(owned);
  diffusion_ = {std::vector<double>(faces * state.species, 0.0), std::vector<double>(faces, 0.0),
                std::vector<double>(faces, 0.0)};
  faceVelocity_.assign(faces, 0.0);
}

void TransportOperator::initialise(State& state, double dt) {
  const Mesh& m = context_.mesh;
  if (context_.varying) context_.varying->set(0.0, 0.0);
  state.updateHalo(context_.halo);
  collectively(m.comm, [&] { properties_.update(context_, state); });
  std::fill(state.massFlux.begin(), state.massFlux.end(), 0.0);
  faces_.prepare(state);
  speciesDiffusion_.prepare(state, properties_);
  speciesDiffusion_.presentFlux(state, diffusion_.species);
  computeEnthalpyFlux(state);
  heatConduction_.prepare(properties_);
  heatConduction_.presentFlux(state, diffusion_.heat);
  const auto divergence = expansion_.initial(state, properties_, diffusion_);
  momentum_.balanceForces(state);
  const std::vector<double> weight = state.pressure;
  // So short that nothing but the pressure changes the velocity; that of the blow is not kept.
  momentum_.advance(state, {state, state, properties_.viscosity, properties_.boundaryViscosity, divergence, 1e-6 * dt},
                    faceVelocity_);
  momentum_.endStep();
  state.pressure = weight;
  updateFluxes(state, state);
}

void TransportOperator::keepStart(const State& state) {
  start_ = state;
  mean_ = state;
  startViscosity_ = properties_.viscosity;
  startBoundaryViscosity_ = properties_.boundaryViscosity;
  startSpeciesFlux_.resize(diffusion_.species.size());
  startHeatFlux_.resize(diffusion_.heat.size());
  speciesDiffusion_.presentFlux(state, startSpeciesFlux_);
  heatConduction_.presentFlux(state, startHeatFlux_);
}

void TransportOperator::average(const State& state) {
  const auto mean = [](std::span<const double> start, std::span<const double> latest, std::span<double> result) {
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = 0.5 * (start[i] + latest[i]);
  };
  for (const auto field : {&State::velocity, &State::swirl, &State::temperature, &State::density, &State::Y,
                           &State::carried, &State::massFlux})
    mean((*start_).*field, state.*field, (*mean_).*field);
  mean_->thermodynamicPressure = 0.5 * (start_->thermodynamicPressure + state.thermodynamicPressure);
  meanViscosity_.resize(startViscosity_.size());
  mean(startViscosity_, properties_.viscosity, meanViscosity_);
}

// Content of the owned cells at the step's end after convection and the balance alone.
void TransportOperator::addConvection(const State& start, const State& state, double dt) {
  const Mesh& m = context_.mesh;
  const int n = state.species;
  for (int c = 0; c < m.owned; ++c) {
    double gained = 0.0;
    for (int k = 0; k < n; ++k) {
      const std::size_t i = static_cast<std::size_t>(c) * n + k;
      content_[i] = m.volume[c] * (start.density[c] * start.Y[i] + dt * state.balance.species[i]);
      gained += state.balance.species[i];
    }
    heatContent_[c] = m.volume[c] * (start.density[c] * start.enthalpy[c] + dt * state.balance.enthalpy[c]);
    newMass_[c] = m.volume[c] * (start.density[c] + dt * gained);
  }
  for (int face = 0; face < m.faces; ++face) {
    const double amount = dt * state.massFlux[face];
    const double heat = amount * faces_.enthalpy[face];
    const double* y = &faces_.Y[static_cast<std::size_t>(face) * n];
    const auto give = [&](int cell, double sign) {
      if (cell < 0 || cell >= m.owned) return;
      double* content = &content_[static_cast<std::size_t>(cell) * n];
      for (int k = 0; k < n; ++k) content[k] += sign * amount * y[k];
      heatContent_[cell] += sign * heat;
      newMass_[cell] += sign * amount;
    };
    give(m.low[face], -1.0);
    give(m.high[face], 1.0);
  }
}

// Work of the rising thermodynamic pressure on the gas of a closed vessel.
void TransportOperator::addCompression() {
  for (std::size_t c = 0; c < heatContent_.size(); ++c)
    heatContent_[c] += context_.mesh.volume[c] * expansion_.pressureRise();
}

// Of the species that diffuse.
void TransportOperator::computeEnthalpyFlux(const State& mean) {
  const Mesh& m = context_.mesh;
  const int n = mean.species;
  std::vector<double> speciesEnthalpy(n);
  for (int face = 0; face < m.faces; ++face) {
    const double* flux = &diffusion_.species[static_cast<std::size_t>(face) * n];
    const int low = m.low[face];
    const double T = m.high[face] >= 0 ? m.lowWeight[face] * mean.temperature[low] +
                                             (1.0 - m.lowWeight[face]) * mean.temperature[m.high[face]]
                                       : faces_.boundaryTemperature()[face - m.interiorFaces];
    context_.thermo.speciesEnthalpies(T, speciesEnthalpy);
    double sum = 0.0;
    for (int k = 0; k < n; ++k) sum += flux[k] * speciesEnthalpy[k];
    diffusion_.enthalpy[face] = sum;
  }
}

// Diffusion and conduction of the sweep: implicit; from the second sweep on corrected so that they become the mean of
// those at both ends.
void TransportOperator::computeDiffusion(const State& mean, const State& state, double dt) {
  const Mesh& m = context_.mesh;
  const int n = state.species;
  const bool corrected = sweep_ > 1;
  std::vector<double> speciesExtra, heatExtra;
  if (corrected) {
    speciesExtra.assign(startSpeciesFlux_.size(), 0.0);
    heatExtra.assign(startHeatFlux_.size(), 0.0);
    speciesDiffusion_.presentFlux(state, diffusion_.species);
    heatConduction_.presentFlux(state, diffusion_.heat);
    addHalfDifference(startSpeciesFlux_, diffusion_.species, speciesExtra);
    addHalfDifference(startHeatFlux_, diffusion_.heat, heatExtra);
  }
  std::vector<double> content = content_;
  if (corrected) addFaceFluxes(m, speciesExtra, n, dt, content);
  diagnostics_.speciesIterations =
      speciesDiffusion_.implicitFlux(state, content, newMass_, dt, diffusion_.species).iterations;
  addFaceFluxes(m, diffusion_.species, n, dt, content);
  for (std::size_t i = 0; i < speciesExtra.size(); ++i) diffusion_.species[i] += speciesExtra[i];
  computeEnthalpyFlux(mean);

  std::vector<double> heat = heatContent_;
  addFaceFluxes(m, diffusion_.enthalpy, 1, dt, heat);
  if (corrected) addFaceFluxes(m, heatExtra, 1, dt, heat);
  heatConduction_.implicitFlux(state, properties_, {newMass_, content, heat}, dt, diffusion_.heat);
  for (std::size_t i = 0; i < heatExtra.size(); ++i) diffusion_.heat[i] += heatExtra[i];
}

void TransportOperator::updateFluxes(State& state, const State& mean) {
  const Mesh& m = context_.mesh;
  faces_.interpolate(mean, faceVelocity_);
  for (int face = 0; face < m.faces; ++face)
    state.massFlux[face] = faces_.density[face] * faceVelocity_[face] * m.area[face];
}

void TransportOperator::finish(State& state, double dt) {
  const Mesh& m = context_.mesh;
  const int n = state.species;
  addFaceFluxes(m, diffusion_.species, n, dt, content_);
  addFaceFluxes(m, diffusion_.enthalpy, 1, dt, heatContent_);
  addFaceFluxes(m, diffusion_.heat, 1, dt, heatContent_);
  for (int c = 0; c < m.owned; ++c) {
    const double* content = &content_[static_cast<std::size_t>(c) * n];
    double mass = 0.0;
    for (int k = 0; k < n; ++k) mass += content[k];
    double* y = &state.Y[static_cast<std::size_t>(c) * n];
    for (int k = 0; k < n; ++k) y[k] = content[k] / mass;
    state.density[c] = mass / m.volume[c];
    state.enthalpy[c] = heatContent_[c] / mass;
    state.temperature[c] = context_.thermo.temperatureFromEnthalpy(state.enthalpy[c], {y, static_cast<std::size_t>(n)},
                                                                   state.temperature[c]);
  }
}

void TransportOperator::recordBoundary(const State& state, double dt) {
  const Mesh& m = context_.mesh;
  const int n = state.species;
  const int scalars = state.carriedCount();
  boundary_ = {std::vector<double>(n, 0.0), std::vector<double>(n, 0.0), std::vector<double>(scalars, 0.0),
               std::vector<double>(scalars, 0.0)};
  const auto book = [dt](double outward, double& in, double& out) {
    (outward < 0.0 ? in : out) += dt * std::abs(outward);
  };
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    for (int k = 0; k < n; ++k) {
      const std::size_t i = static_cast<std::size_t>(face) * n + k;
      book(state.massFlux[face] * faces_.Y[i] + diffusion_.species[i], boundary_.speciesIn[k], boundary_.speciesOut[k]);
    }
    for (int s = 0; s < scalars; ++s)
      book(carried_.flux()[static_cast<std::size_t>(face) * scalars + s], boundary_.carriedIn[s],
           boundary_.carriedOut[s]);
    book(state.massFlux[face] * faces_.enthalpy[face] + diffusion_.enthalpy[face] + diffusion_.heat[face],
         boundary_.enthalpyIn, boundary_.enthalpyOut);
  }
}

void TransportOperator::saveOrLoad(StateArchive& archive) {
  // What others look at between two steps; the rest of the properties is evaluated where a step begins.
  archive.cells("viscosity", properties_.viscosity, 1);
  archive.cells("conductivity", properties_.conductivity, 1);
  std::vector<double> seen{diagnostics_.continuityError, static_cast<double>(diagnostics_.pressureIterations),
                           static_cast<double>(diagnostics_.speciesIterations), lastStep_};
  archive.shared("transport_diagnostics", seen);
  diagnostics_ = {seen.at(0), static_cast<int>(seen.at(1)), static_cast<int>(seen.at(2))};
  lastStep_ = seen.at(3);
  momentum_.saveOrLoad(archive);
  expansion_.saveOrLoad(archive);
}

void TransportOperator::advance(State& state, double time, double dt) {
  const FlushDenormals flush;
  const Mesh& m = context_.mesh;
  const bool first = ++sweep_ == 1;
  const bool several = options_.sweeps > 1;
  // The gas's boundaries at the middle of its step, those of the velocities at the middle of theirs.
  if (first && context_.varying) context_.varying->set(time + 0.5 * dt, time + 0.25 * (dt - lastStep_));
  // A temperature out of range on one rank must stop all of them.
  collectively(m.comm, [&] { properties_.update(context_, state); });
  expansion_.begin(state, properties_, diffusion_, first, dt, lastStep_);
  speciesDiffusion_.prepare(state, properties_);
  heatConduction_.prepare(properties_);
  if (first) startPressure_ = state.thermodynamicPressure;
  if (several && first) keepStart(state);
  if (several) average(state);
  const State& start = several ? *start_ : state;
  const State& mean = several ? *mean_ : state;
  faces_.prepare(mean);
  faces_.interpolate(mean, state.massFlux);

  // Diffusion with the mass flux of the last sweep or step.
  addConvection(start, state, dt);
  if (!first) addCompression();
  computeDiffusion(mean, state, dt);

  // Velocity, pressure and mass flux for exactly this diffusion.
  const auto divergence = expansion_.complete(state, properties_, diffusion_, first);
  const std::vector<double>& startViscosity = several ? startViscosity_ : properties_.viscosity;
  const std::vector<double>& boundaryViscosity = several ? startBoundaryViscosity_ : properties_.boundaryViscosity;
  const auto projected = momentum_.advance(
      state, {start, mean, startViscosity, boundaryViscosity, divergence, 0.5 * (lastStep_ + dt)}, faceVelocity_);
  diagnostics_.continuityError = projected.continuityError;
  diagnostics_.pressureIterations = projected.iterations;
  updateFluxes(state, mean);

  addConvection(start, state, dt);
  addCompression();
  const std::vector<double>& meanViscosity = several ? meanViscosity_ : properties_.viscosity;
  carried_.advance(state, {start, mean, meanViscosity, faces_, faceVelocity_, newMass_}, dt);
  collectively(m.comm, [&] { finish(state, dt); });
  state.thermodynamicPressure = startPressure_ + expansion_.pressureRise();
  state.updateHalo(context_.halo);
  if (sweep_ < options_.sweeps) return;
  sweep_ = 0;
  lastStep_ = dt;
  momentum_.endStep();
  recordBoundary(state, dt);
  for (const auto& watcher : watchers_) watcher(boundary_);
}

double TransportOperator::pressureDrift(const State& state) {
  double largest = 0.0;
  for (const double drift : expansion_.pressureDrift(state)) largest = std::max(largest, std::abs(drift));
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, context_.mesh.comm);
  return largest;
}

double TransportOperator::largestStep(const State& state) {
  return convectiveTimeStep(context_.mesh, state, options_.courant);
}

std::vector<Quantity> TransportOperator::historyColumns() const {
  return {{"pressure_drift", "1", "largest |p_eos - p0| / p0 at the end of the step, reactions and particles included"},
          {"thermodynamic_pressure", "Pa", "uniform part of the pressure, which changes in a closed vessel"},
          {"continuity_error", "1/s", "largest error of the projected velocity's divergence"},
          {"pressure_iterations", "1", "of the pressure solve"},
          {"species_iterations", "1", "of the implicit species diffusion"}};
}

std::vector<double> TransportOperator::historyValues(const State& state) {
  return {pressureDrift(state), state.thermodynamicPressure, diagnostics_.continuityError,
          static_cast<double>(diagnostics_.pressureIterations), static_cast<double>(diagnostics_.speciesIterations)};
}

void TransportOperator::fields(const State& state, const FieldSink& sink) const {
  const auto owned = static_cast<std::size_t>(context_.mesh.owned);
  sink({"viscosity", "Pa s", "dynamic viscosity"}, {properties_.viscosity.data(), owned});
  sink({"conductivity", "W/m/K", "thermal conductivity"}, {properties_.conductivity.data(), owned});
  if (state.swirls) sink({"swirl_velocity", "m/s", "gas velocity about the axis"}, {state.swirl.data(), owned});
}

}  // namespace lampblack::flow
