#include "flow/transport_operator.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/flush_denormals.hpp"
#include "flow/face_fluxes.hpp"
#include "flow/time_step.hpp"

namespace lampblack::flow {

TransportOperator::TransportOperator(const FlowContext& context, const State& state, Options options)
    : context_(context),
      options_(options),
      faces_(context, state.species, state.carriedCount()),
      speciesDiffusion_(context),
      heatDiffusion_(context.mesh, context.halo),
      momentum_(context),
      carried_(context, state.carriedCount()) {
  const auto faces = static_cast<std::size_t>(context.mesh.faces);
  const auto owned = static_cast<std::size_t>(context.mesh.owned);
  const auto cells = static_cast<std::size_t>(context.mesh.cells);
  content_.resize(owned * state.species);
  heatContent_.resize(owned);
  newMass_.resize(owned);
  newDensity_.resize(cells);
  speciesFlux_.assign(faces * state.species, 0.0);
  enthalpyFlux_.assign(faces, 0.0);
  heatFlux_.assign(faces, 0.0);
  divergence_.assign(owned, 0.0);
  faceVelocity_.assign(faces, 0.0);
  temperature_.resize(cells);
}

void TransportOperator::initialise(State& state, double dt) {
  const Mesh& m = context_.mesh;
  state.updateHalo(context_.halo);
  collectively(m.comm, [&] { properties_.update(context_, state); });
  std::fill(state.massFlux.begin(), state.massFlux.end(), 0.0);
  std::copy(state.density.begin(), state.density.end(), newDensity_.begin());
  std::fill(divergence_.begin(), divergence_.end(), 0.0);
  momentum_.advance(state, properties_, newDensity_, divergence_, dt, faceVelocity_);
  std::fill(state.pressure.begin(), state.pressure.end(), 0.0);  // what it found was the blow that changed the velocity
  faces_.prepare(state);
  updateFluxes(state);
}

// Content of the owned cells after convection and the balance alone.
void TransportOperator::addConvection(const State& state, double dt) {
  const Mesh& m = context_.mesh;
  const int n = state.species;
  for (int c = 0; c < m.owned; ++c) {
    double gained = 0.0;
    for (int k = 0; k < n; ++k) {
      const std::size_t i = static_cast<std::size_t>(c) * n + k;
      content_[i] = m.volume[c] * (state.density[c] * state.Y[i] + dt * state.balance.species[i]);
      gained += state.balance.species[i];
    }
    heatContent_[c] = m.volume[c] * (state.density[c] * state.enthalpy[c] + dt * state.balance.enthalpy[c]);
    newMass_[c] = m.volume[c] * (state.density[c] + dt * gained);
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

// Enthalpy carried by diffusing species, then implicit conduction of what temperature that leaves.
void TransportOperator::computeHeatFlux(const State& state, double dt) {
  const Mesh& m = context_.mesh;
  const int n = state.species;
  std::vector<double> speciesEnthalpy(n);
  for (int face = 0; face < m.faces; ++face) {
    const double* flux = &speciesFlux_[static_cast<std::size_t>(face) * n];
    const int low = m.low[face];
    const double T = m.high[face] >= 0 ? m.lowWeight[face] * state.temperature[low] +
                                             (1.0 - m.lowWeight[face]) * state.temperature[m.high[face]]
                                       : faces_.boundaryTemperature()[face - m.interiorFaces];
    context_.thermo.speciesEnthalpies(T, speciesEnthalpy);
    double sum = 0.0;
    for (int k = 0; k < n; ++k) sum += flux[k] * speciesEnthalpy[k];
    enthalpyFlux_[face] = sum;
  }

  std::vector<double> content = content_;
  std::vector<double> heat = heatContent_;
  addFaceFluxes(m, speciesFlux_, n, dt, content);
  addFaceFluxes(m, enthalpyFlux_, 1, dt, heat);
  std::vector<double> diagonal(m.owned);
  std::vector<double> source(m.owned);
  std::vector<double> conductance(m.faces);
  collectively(m.comm, [&] {
    for (int c = 0; c < m.owned; ++c) {
      double* y = &content[static_cast<std::size_t>(c) * n];
      for (int k = 0; k < n; ++k) y[k] /= newMass_[c];
      const double T = context_.thermo.temperatureFromEnthalpy(heat[c] / newMass_[c], {y, static_cast<std::size_t>(n)},
                                                               state.temperature[c]);
      diagonal[c] = newMass_[c] * properties_.heatCapacity[c] / dt;
      source[c] = diagonal[c] * T;
    }
  });
  for (int face = 0; face < m.faces; ++face) {
    const int low = m.low[face];
    const double metric = m.area[face] / m.distance[face];
    if (m.high[face] >= 0) {
      const double w = m.lowWeight[face];
      conductance[face] =
          metric * (w * properties_.conductivity[low] + (1.0 - w) * properties_.conductivity[m.high[face]]);
      continue;
    }
    const BoundaryCondition& boundary = context_.boundaryOf(face);
    const bool given =
        boundary.kind == BoundaryKind::Inlet || (boundary.kind == BoundaryKind::Wall && boundary.isothermal);
    conductance[face] = given ? metric * properties_.conductivity[low] : 0.0;
    diagonal[low] += conductance[face];
    source[low] += conductance[face] * boundary.temperature;
  }
  temperature_ = state.temperature;
  heatDiffusion_.solve(1, diagonal, conductance, source, temperature_);
  for (int face = 0; face < m.faces; ++face) {
    const double beyond = m.high[face] >= 0 ? temperature_[m.high[face]] : context_.boundaryOf(face).temperature;
    heatFlux_[face] = conductance[face] * (temperature_[m.low[face]] - beyond);
  }
}

void TransportOperator::computeDivergence(const State& state, double dt) {
  const Mesh& m = context_.mesh;
  const int n = state.species;
  const auto molecularWeights = context_.mechanism.molecularWeights();
  // Mass and enthalpy that diffusion and the balance bring in, kg/s and W.
  std::vector<double> species(static_cast<std::size_t>(m.owned) * n);
  std::vector<double> heat(m.owned);
  for (int c = 0; c < m.owned; ++c) {
    heat[c] = m.volume[c] * state.balance.enthalpy[c];
    for (int k = 0; k < n; ++k) {
      const std::size_t i = static_cast<std::size_t>(c) * n + k;
      species[i] = m.volume[c] * state.balance.species[i];
    }
  }
  addFaceFluxes(m, speciesFlux_, n, 1.0, species);
  addFaceFluxes(m, enthalpyFlux_, 1, 1.0, heat);
  addFaceFluxes(m, heatFlux_, 1, 1.0, heat);
  std::vector<double> h(n);
  for (int c = 0; c < m.owned; ++c) {
    context_.thermo.speciesEnthalpies(state.temperature[c], h);
    const double* brought = &species[static_cast<std::size_t>(c) * n];
    double sensible = heat[c];
    double moles = 0.0;
    for (int k = 0; k < n; ++k) {
      sensible -= h[k] * brought[k];
      moles += brought[k] / molecularWeights[k];
    }
    const double mass = state.density[c] * m.volume[c];
    const double W = properties_.molecularWeight[c];
    const double equationOfState = state.density[c] * constants::gasConstant * state.temperature[c] / W;
    divergence_[c] = sensible / (mass * properties_.heatCapacity[c] * state.temperature[c]) + W * moles / mass +
                     (equationOfState / state.thermodynamicPressure - 1.0) / std::max(dt, options_.driftTime);
  }
}

void TransportOperator::updateFluxes(State& state) {
  const Mesh& m = context_.mesh;
  faces_.interpolate(state, faceVelocity_);
  for (int face = 0; face < m.faces; ++face)
    state.massFlux[face] = faces_.density[face] * faceVelocity_[face] * m.area[face];
}

void TransportOperator::finish(State& state, double dt) {
  const Mesh& m = context_.mesh;
  const int n = state.species;
  addFaceFluxes(m, speciesFlux_, n, dt, content_);
  addFaceFluxes(m, enthalpyFlux_, 1, dt, heatContent_);
  addFaceFluxes(m, heatFlux_, 1, dt, heatContent_);
  diagnostics_.pressureDrift = 0.0;
  for (int c = 0; c < m.owned; ++c) {
    const double* content = &content_[static_cast<std::size_t>(c) * n];
    double mass = 0.0;
    for (int k = 0; k < n; ++k) mass += content[k];
    double* y = &state.Y[static_cast<std::size_t>(c) * n];
    for (int k = 0; k < n; ++k) y[k] = content[k] / mass;
    state.density[c] = mass / m.volume[c];
    state.enthalpy[c] = heatContent_[c] / mass;
    const std::span<const double> mixture{y, static_cast<std::size_t>(n)};
    state.temperature[c] = context_.thermo.temperatureFromEnthalpy(state.enthalpy[c], mixture, temperature_[c]);
    const double equationOfState =
        state.density[c] * constants::gasConstant * state.temperature[c] / context_.thermo.meanMolecularWeight(mixture);
    diagnostics_.pressureDrift =
        std::max(diagnostics_.pressureDrift, std::abs(equationOfState / state.thermodynamicPressure - 1.0));
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
      book(state.massFlux[face] * faces_.Y[i] + speciesFlux_[i], boundary_.speciesIn[k], boundary_.speciesOut[k]);
    }
    for (int s = 0; s < scalars; ++s)
      book(carried_.flux()[static_cast<std::size_t>(face) * scalars + s], boundary_.carriedIn[s],
           boundary_.carriedOut[s]);
    book(state.massFlux[face] * faces_.enthalpy[face] + enthalpyFlux_[face] + heatFlux_[face], boundary_.enthalpyIn,
         boundary_.enthalpyOut);
  }
}

void TransportOperator::saveOrLoad(StateArchive& archive) {
  // What others look at between two steps; the rest of the properties is evaluated where a step begins.
  archive.cells("viscosity", properties_.viscosity, 1);
  std::vector<double> seen{diagnostics_.continuityError, diagnostics_.pressureDrift,
                           static_cast<double>(diagnostics_.pressureIterations),
                           static_cast<double>(diagnostics_.speciesIterations)};
  archive.shared("transport_diagnostics", seen);
  diagnostics_ = {seen.at(0), seen.at(1), static_cast<int>(seen.at(2)), static_cast<int>(seen.at(3))};
  momentum_.saveOrLoad(archive);
}

void TransportOperator::advance(State& state, double, double dt) {
  const FlushDenormals flush;
  const Mesh& m = context_.mesh;
  // A temperature out of range on one rank must stop all of them.
  collectively(m.comm, [&] { properties_.update(context_, state); });
  faces_.prepare(state);
  faces_.interpolate(state, state.massFlux);

  // Diffusion with the last step's mass flux.
  addConvection(state, dt);
  for (int c = 0; c < m.owned; ++c) newDensity_[c] = newMass_[c] / m.volume[c];
  context_.halo.update(newDensity_, 1);
  diagnostics_.speciesIterations =
      speciesDiffusion_.computeFlux(state, properties_, content_, newMass_, dt, speciesFlux_).iterations;
  computeHeatFlux(state, dt);

  // Velocity, pressure and mass flux for exactly this diffusion.
  computeDivergence(state, dt);
  const auto projected = momentum_.advance(state, properties_, newDensity_, divergence_, dt, faceVelocity_);
  diagnostics_.continuityError = projected.continuityError;
  diagnostics_.pressureIterations = projected.iterations;
  updateFluxes(state);

  addConvection(state, dt);
  carried_.advance(state, properties_, faces_, faceVelocity_, newMass_, dt);
  collectively(m.comm, [&] { finish(state, dt); });
  recordBoundary(state, dt);
  MPI_Allreduce(MPI_IN_PLACE, &diagnostics_.pressureDrift, 1, MPI_DOUBLE, MPI_MAX, m.comm);
  for (const auto& watcher : watchers_) watcher(boundary_);
  state.updateHalo(context_.halo);
}

double TransportOperator::largestStep(const State& state) {
  return convectiveTimeStep(context_.mesh, state, options_.courant);
}

std::vector<Quantity> TransportOperator::historyColumns() const {
  return {{"pressure_drift", "1", "largest |p_eos - p0| / p0 after the last transport step"},
          {"continuity_error", "1/s", "largest error of the projected velocity's divergence"},
          {"pressure_iterations", "1", "of the pressure solve"},
          {"species_iterations", "1", "of the implicit species diffusion"}};
}

std::vector<double> TransportOperator::historyValues(const State&) {
  return {diagnostics_.pressureDrift, diagnostics_.continuityError,
          static_cast<double>(diagnostics_.pressureIterations), static_cast<double>(diagnostics_.speciesIterations)};
}

void TransportOperator::fields(const State&, const FieldSink& sink) const {
  sink({"viscosity", "Pa s", "dynamic viscosity"},
       {properties_.viscosity.data(), static_cast<std::size_t>(context_.mesh.owned)});
}

}  // namespace lampblack::flow
