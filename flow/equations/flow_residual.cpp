#include "flow/equations/flow_residual.hpp"

#include <algorithm>
#include <utility>

#include "core/errors.hpp"
#include "flow/discretisation/face_fluxes.hpp"
#include "flow/equations/momentum.hpp"

namespace lampblack::flow {

FlowResidual::FlowResidual(const FlowContext& context, const State& state, VelocityScheme scheme,
                           std::vector<Operator*> operators)
    : context_(context),
      operators_(std::move(operators)),
      faces_(context, state),
      diffusion_(context.mesh, context.halo),
      speciesDiffusion_(context, diffusion_),
      heatConduction_(context, diffusion_),
      fluxes_(context, faces_, speciesDiffusion_),
      carried_(context, state, diffusion_),
      forces_(context, state.swirls, scheme),
      faceVelocity_(context),
      conducted_(static_cast<std::size_t>(context.mesh.faces)),
      acceleration_(state.velocity.size()),
      velocityOfFaces_(conducted_.size()),
      row_(static_cast<std::size_t>(state.species)),
      direction_(conducted_.size()) {
  const auto owned = static_cast<std::size_t>(context.mesh.owned);
  const auto n = static_cast<std::size_t>(state.species), scalars = state.scalars.size();
  rates_.mass.resize(owned);
  rates_.species.resize(owned * n);
  rates_.enthalpy.resize(owned);
  rates_.carried.resize(owned * scalars);
  rates_.momentum.resize(owned * static_cast<std::size_t>(state.dimension));
  if (state.swirls) rates_.angularMomentum.resize(owned);
  rates_.massFlux.resize(conducted_.size());
  rates_.made = {std::vector<double>(owned * n), {}, {}, std::vector<double>(owned), rates_.carried, rates_.carried};
  if (scalars > 0) carriedMade_ = rates_.made;
}

const FlowResidual::Rates& FlowResidual::evaluate(const State& state) {
  collectively(context_.mesh.comm, [&] { properties_.update(context_, state); });
  speciesDiffusion_.prepare(state, properties_);
  heatConduction_.prepare(state, properties_);
  faces_.prepare(state, state.Y);
  for (std::vector<double>* all : {&rates_.mass, &rates_.species, &rates_.enthalpy, &rates_.carried})
    std::ranges::fill(*all, 0.0);
  addGas(state);
  addMade(state);
  addCarried(state);
  findForces(state);
  return rates_;
}

// What comes in from beyond a boundary has a say in the slopes beside it.
bool FlowResidual::turnsAtBoundary(const State& state) const {
  int turns = 0;
  for (int face = context_.mesh.interiorFaces; face < context_.mesh.faces && !turns; ++face)
    turns = directionOf(state.massFlux[face]) != direction_[face];
  MPI_Allreduce(MPI_IN_PLACE, &turns, 1, MPI_INT, MPI_MAX, context_.mesh.comm);
  return turns != 0;
}

const FlowResidual::Rates& FlowResidual::evaluateFlow(const State& state, Gas gas) {
  const Mesh& m = context_.mesh;
  const bool isAnew = gas == Gas::Changed || turnsAtBoundary(state);
  if (isAnew) faces_.prepare(state, state.Y);
  std::ranges::fill(rates_.mass, 0.0);
  for (int face = 0; face < m.faces; ++face) {
    const char direction = directionOf(state.massFlux[face]);
    if (isAnew || direction != direction_[face]) faces_.interpolate(state, face, state.massFlux[face], row_);
    direction_[face] = direction;
    addFaceFlux(m, face, state.massFlux[face], 1.0, rates_.mass);
  }
  for (int c = 0; c < m.owned; ++c) {
    rates_.made.ofSpecies(static_cast<std::size_t>(c), row_);
    for (const double made : row_) rates_.mass[c] += m.volume[c] * made;
  }
  findForces(state);
  return rates_;
}

const FlowResidual::Rates& FlowResidual::evaluateCarried(const State& state, Gas gas) {
  if (gas == Gas::Changed)
    faces_.prepare(state, state.Y);
  else
    faces_.prepareCarried(state);
  std::ranges::fill(rates_.carried, 0.0);
  carriedMade_.clear();
  for (Operator* op : operators_)
    if (op->actsOnCarried()) op->addRates(state, carriedMade_);
  std::swap(rates_.made.carried, carriedMade_.carried);
  std::swap(rates_.made.carriedSink, carriedMade_.carriedSink);
  addMadeOfCarried(state);
  addCarried(state);
  return rates_;
}

void FlowResidual::addGas(const State& state) {
  const Mesh& m = context_.mesh;
  heatConduction_.presentFlux(state, conducted_);
  for (int face = 0; face < m.faces; ++face) {
    const double flux = state.massFlux[face];
    direction_[face] = directionOf(flux);
    const double enthalpy = fluxes_.through(state, face, flux, row_) + conducted_[face];
    addFaceFlux(m, face, row_, 1.0, rates_.species);
    addFaceFlux(m, face, enthalpy, 1.0, rates_.enthalpy);
    addFaceFlux(m, face, flux, 1.0, rates_.mass);
  }
}

void FlowResidual::addMade(const State& state) {
  const Mesh& m = context_.mesh;
  const std::size_t n = row_.size();
  std::ranges::fill(rates_.made.reactions, 0.0);
  rates_.made.clear();
  for (Operator* op : operators_) op->addRates(state, rates_.made);
  for (int c = 0; c < m.owned; ++c) {
    const auto cell = static_cast<std::size_t>(c);
    rates_.made.ofSpecies(cell, row_);
    for (std::size_t k = 0; k < n; ++k) {
      rates_.species[cell * n + k] += m.volume[c] * row_[k];
      rates_.mass[cell] += m.volume[c] * row_[k];
    }
    rates_.enthalpy[cell] += m.volume[c] * rates_.made.enthalpy[cell];
  }
  addMadeOfCarried(state);
}

void FlowResidual::addMadeOfCarried(const State& state) {
  const Mesh& m = context_.mesh;
  const std::size_t scalars = state.scalars.size();
  for (std::size_t i = 0; i < rates_.carried.size(); ++i)
    if (state.scalars[i % scalars].isTransported)
      rates_.carried[i] += m.volume[i / scalars] * rates_.made.netOfCarried(i, state.carried);
}

void FlowResidual::addCarried(const State& state) {
  if (std::ranges::none_of(state.scalars, &CarriedScalar::isTransported)) return;
  const Mesh& m = context_.mesh;
  const std::size_t scalars = state.scalars.size();
  for (int face = 0; face < m.faces; ++face)
    velocityOfFaces_[face] = m.area[face] > 0.0 ? state.massFlux[face] / (faces_.density[face] * m.area[face]) : 0.0;
  std::vector<double> flux(static_cast<std::size_t>(m.faces) * scalars);
  carried_.presentFlux(
      state, {state, state, properties_.viscosity, faces_, velocityOfFaces_, {}, properties_, conducted_}, flux);
  addFaceFluxes(m, flux, static_cast<int>(scalars), 1.0, rates_.carried);
}

void FlowResidual::findForces(const State& state) {
  const Mesh& m = context_.mesh;
  const int d = state.dimension;
  forces_.rates(state,
                {state, state, properties_.effectiveViscosity(), properties_.effectiveBoundaryViscosity(), {}, 0.0},
                rates_.momentum, rates_.angularMomentum);
  forces_.acceleration(state.density, acceleration_);
  std::vector<FieldView> known{{acceleration_, d}, {forces_.relaxation(), 1}};
  context_.halo.update(known);
  faceVelocity_.settled(
      {state.velocity, acceleration_, forces_.relaxation(), state.pressure, forces_.gradient().values()},
      inverseFaceDensity(m, state.density), velocityOfFaces_);
  for (int face = 0; face < m.faces; ++face)
    rates_.massFlux[face] = faces_.density[face] * velocityOfFaces_[face] * m.area[face] - state.massFlux[face];
}

}  // namespace lampblack::flow
