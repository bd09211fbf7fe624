#include "flow/properties/gas_properties.hpp"

#include <algorithm>
#include <array>

#include "flow/boundaries/wall_law.hpp"

namespace lampblack::flow {

GasProperties::Coefficients GasProperties::evaluate(const FlowContext& context, double T, double p,
                                                    std::span<const double> Y, std::span<double> D) {
  const TransportModel& model = context.transportModel;
  const auto molecularWeights = context.mechanism.molecularWeights();
  double moles = 0.0;
  for (std::size_t k = 0; k < X_.size(); ++k) moles += X_[k] = std::max(Y[k], 0.0) / molecularWeights[k];
  for (double& x : X_) x /= moles;
  const auto mixture = context.transport.mixture(T, p, X_, D);
  Coefficients result{mixture.viscosity, mixture.conductivity};
  if (multicomponent_)
    result.conductivity = multicomponent_->mixture(T, p, X_, DT_).conductivity;
  else if (model.soret)
    context.transport.thermalDiffusion(T, p, X_, DT_);
  return result;
}

void GasProperties::update(const FlowContext& context, const State& state) {
  const auto cells = static_cast<std::size_t>(context.mesh.cells);
  const auto n = static_cast<std::size_t>(state.species);
  for (auto* ofCells : {&viscosity, &conductivity, &heatCapacity, &molecularWeight}) ofCells->resize(cells);
  massDiffusivity.resize(cells * n);
  for (auto* work : {&X_, &D_, &DT_}) work->resize(n);
  const TransportModel& model = context.transportModel;
  if (model.isMulticomponent() && !multicomponent_) multicomponent_.emplace(context.mechanism, model.integrals);
  if (model.soret) thermalDiffusion.resize(massDiffusivity.size());
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const std::span<const double> Y{&state.Y[cell * n], n};
    const std::span<double> D{&massDiffusivity[cell * n], n};
    const Coefficients found = evaluate(context, state.temperature[cell], state.thermodynamicPressure, Y, D);
    for (double& d : D) d *= state.density[cell];
    viscosity[cell] = found.viscosity;
    conductivity[cell] = found.conductivity;
    if (model.soret) std::ranges::copy(DT_, &thermalDiffusion[cell * n]);
    heatCapacity[cell] = context.thermo.cpMass(state.temperature[cell], Y);
    molecularWeight[cell] = context.thermo.meanMolecularWeight(Y);
  }
  updateBoundary(context, state);
  if (!state.eddyViscosity.empty()) addEddies(context, state);
}

void GasProperties::resize(const FlowContext& context, const State& state) {
  for (auto* ofCells : {&viscosity, &conductivity, &molecularWeight})
    ofCells->resize(static_cast<std::size_t>(context.mesh.cells));
  boundaryViscosity.resize(static_cast<std::size_t>(context.mesh.boundaryFaces()));
  if (state.hasEddies) effectiveBoundaryViscosity_.resize(boundaryViscosity.size());
}

void GasProperties::saveOrLoad(const FlowContext& context, StateArchive& archive, std::span<double> heat) {
  constexpr std::size_t width = 3;
  const Mesh& m = context.mesh;
  archive.cells("viscosity", viscosity, 1);
  archive.cells("conductivity", conductivity, 1);
  std::vector<double>& effective =
      effectiveBoundaryViscosity_.empty() ? boundaryViscosity : effectiveBoundaryViscosity_;
  std::vector<double> atBoundaries(static_cast<std::size_t>(m.faces) * width);
  const auto each = [&](auto move) {
    for (int face = m.interiorFaces; face < m.faces; ++face) {
      const auto f = static_cast<std::size_t>(face), b = static_cast<std::size_t>(face - m.interiorFaces);
      const std::array<double*, width> values{&boundaryViscosity[b], &effective[b], &heat[f]};
      for (std::size_t i = 0; i < width; ++i) move(atBoundaries[f * width + i], *values[i]);
    }
  };
  each([](double& kept, const double& value) { kept = value; });
  archive.faces("at_boundaries", atBoundaries, static_cast<int>(width));
  if (archive.loading()) each([](const double& kept, double& value) { value = kept; });
}

// Heat goes as enthalpy would through gases of one composition, species along the gradients of their mass fractions.
void GasProperties::addEddies(const FlowContext& context, const State& state) {
  const Mesh& m = context.mesh;
  const auto cells = static_cast<std::size_t>(m.cells);
  for (auto* ofCells : {&effectiveViscosity_, &effectiveConductivity_, &eddyDiffusivity}) ofCells->resize(cells);
  for (std::size_t c = 0; c < cells; ++c) {
    const double eddies = state.eddyViscosity[c];
    effectiveViscosity_[c] = viscosity[c] + eddies;
    effectiveConductivity_[c] = conductivity[c] + heatCapacity[c] * eddies / context.eddies.prandtl;
    eddyDiffusivity[c] = eddies / context.eddies.schmidt;
  }
  effectiveBoundaryViscosity_ = boundaryViscosity;
  effectiveBoundaryConductivity_ = boundaryConductivity;
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const BoundaryCondition& boundary = context.boundaryOf(face);
    const bool isSticky = boundary.isNoSlipWall();
    const auto b = static_cast<std::size_t>(face - m.interiorFaces);
    const auto cell = static_cast<std::size_t>(m.low[face]);
    if (isSticky && state.wallEnergy >= 0) addWallLaw(context, state, face);
    if (isSticky) continue;
    const double eddies = state.eddyViscosity[cell];
    effectiveBoundaryViscosity_[b] += eddies;
    effectiveBoundaryConductivity_[b] += heatCapacity[cell] * eddies / context.eddies.prandtl;
  }
}

// Viscosity and conductivity with which a slope over the distance to the wall is the law's friction and heat. Where
// the viscous layers reach to the cell's centre they are those of the molecules.
void GasProperties::addWallLaw(const FlowContext& context, const State& state, int face) {
  const Mesh& m = context.mesh;
  const auto b = static_cast<std::size_t>(face - m.interiorFaces);
  const auto cell = static_cast<std::size_t>(m.low[face]);
  const double exchange = walllaw::exchange(state, cell, m.distance[face]);
  const double yStar = exchange / boundaryViscosity[b];
  const double prandtl = boundaryViscosity[b] * heatCapacity[cell] / boundaryConductivity[b];
  if (state.wallLaw == WallLaw::Blended)
    effectiveBoundaryViscosity_[b] *= walllaw::blended(yStar).friction;
  else if (walllaw::isLogarithmic(yStar))
    effectiveBoundaryViscosity_[b] = exchange / walllaw::velocity(yStar);
  if (yStar > 0.0)
    effectiveBoundaryConductivity_[b] =
        exchange * heatCapacity[cell] / walllaw::scalar(yStar, prandtl, context.eddies.prandtl);
}

void GasProperties::updateBoundary(const FlowContext& context, const State& state) {
  const Mesh& m = context.mesh;
  const auto n = static_cast<std::size_t>(state.species);
  boundaryViscosity.resize(static_cast<std::size_t>(m.boundaryFaces()));
  boundaryConductivity.resize(boundaryViscosity.size());
  for (int face = m.interiorFaces; face < m.faces; ++face) {
    const auto cell = static_cast<std::size_t>(m.low[face]);
    const auto b = static_cast<std::size_t>(face - m.interiorFaces);
    boundaryViscosity[b] = viscosity[cell];
    boundaryConductivity[b] = conductivity[cell];
    if (!context.isTemperatureGiven(face)) continue;
    const std::span<const double> Y = context.isCompositionGiven(face)
                                          ? std::span<const double>(context.boundaryY(face))
                                          : std::span{&state.Y[cell * n], n};
    const Coefficients there = evaluate(context, context.boundaryTemperature(face), state.thermodynamicPressure, Y, D_);
    boundaryViscosity[b] = 0.5 * (boundaryViscosity[b] + there.viscosity);
    boundaryConductivity[b] = 0.5 * (boundaryConductivity[b] + there.conductivity);
  }
}

}  // namespace lampblack::flow
