#include "app/soot_operator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/errors.hpp"
#include "particles/soot/soot_model.hpp"

namespace lampblack {

std::vector<CarriedScalar> SootOperator::carriedScalars() {
  const double drift = sootThermophoresis();
  return {{"soot_number_density", "1/m^3", "number of soot particles per volume", drift},
          {"soot_carbon_density", "kg/m^3", "carbon in soot per volume", drift},
          {"soot_hydrogen_density", "kg/m^3", "hydrogen in soot per volume", drift}};
}

std::vector<std::vector<double>> SootOperator::elementMass(const Mechanism& mechanism) {
  std::vector<std::vector<double>> mass(3, std::vector<double>(mechanism.numElements(), 0.0));
  mass[carbon][mechanism.elementIndex("C")] = 1.0;
  mass[hydrogen][mechanism.elementIndex("H")] = 1.0;
  return mass;
}

SootOperator::SootOperator(const FlowContext& context, SootModelOptions options)
    : context_(context), model_(std::move(options)) {
  const Mechanism& m = context.mechanism;
  for (const std::string& name : sootSpecies(model_.options())) species_.push_back(m.speciesIndex(name));
  speciesEnthalpy_.resize(m.numSpecies());
  partialDensity_.resize(m.numSpecies());
}

TwoEquationSoot::Population SootOperator::populationOf(const State& state, int cell) const {
  const double* values = &state.carried[static_cast<std::size_t>(cell) * state.carriedCount()];
  return {values[number], values[carbon], values[hydrogen]};
}

ParticleGas SootOperator::gasOf(const State& state, int cell, double viscosity,
                                std::vector<double>& concentrations) const {
  const auto n = static_cast<std::size_t>(state.species);
  const double* Y = &state.Y[cell * n];
  const auto W = context_.mechanism.molecularWeights();
  const double rho = state.density[cell];
  concentrations.clear();
  for (const std::size_t k : species_) concentrations.push_back(rho * Y[k] / W[k]);
  return {{state.temperature[cell], state.thermodynamicPressure, rho, viscosity,
           context_.thermo.meanMolecularWeight({Y, n})},
          concentrations};
}

void SootOperator::advanceCell(State& state, int cell, double viscosity, double dt) {
  const auto n = static_cast<std::size_t>(state.species);
  double* Y = &state.Y[cell * n];
  double* scalars = &state.carried[static_cast<std::size_t>(cell) * state.carriedCount()];
  const auto W = context_.mechanism.molecularWeights();
  const double rho = state.density[cell];

  const ParticleGas gas = gasOf(state, cell, viscosity, before_);
  TwoEquationSoot::Population population = populationOf(state, cell);
  const TwoEquationSoot::Population before = population;
  after_ = before_;
  const auto report = model_.advance(gas, dt, population, after_);
  limitedOxidations_ += report.limitedOxidation;

  // Back to the gas's partial densities; what did not change keeps its bits.
  bool changed = false;
  double mass = 0.0;
  std::vector<double>& partial = partialDensity_;
  for (std::size_t k = 0; k < n; ++k) partial[k] = rho * Y[k];
  for (std::size_t i = 0; i < species_.size(); ++i) {
    if (before_[i] == after_[i]) continue;
    partial[species_[i]] += (after_[i] - before_[i]) * W[species_[i]];
    changed = true;
  }
  scalars[number] = population.number;
  scalars[carbon] = population.carbon;
  scalars[hydrogen] = population.hydrogen;
  if (!changed) return;

  for (std::size_t k = 0; k < n; ++k) mass += partial[k];
  for (std::size_t k = 0; k < n; ++k) Y[k] = partial[k] / mass;
  context_.thermo.speciesEnthalpies(gas.temperature, speciesEnthalpy_);
  const double given = (population.carbon - before.carbon) * sootCarbonEnthalpy(gas.temperature).first +
                       (population.hydrogen - before.hydrogen) * speciesEnthalpy_[species_[SootSpecies::H2]];
  state.enthalpy[cell] = (rho * state.enthalpy[cell] - given) / mass;
  state.density[cell] = mass;
  state.temperature[cell] = context_.thermo.temperatureFromEnthalpy(state.enthalpy[cell], {Y, n}, gas.temperature);
}

void SootOperator::saveOrLoad(StateArchive& archive) {
  double limited = static_cast<double>(limitedOxidations_);
  archive.sums("limited_oxidations", {&limited, 1});
  limitedOxidations_ = static_cast<long>(limited);
}

void SootOperator::advance(State& state, double time, double dt) {
  const Mesh& m = context_.mesh;
  collectively(m.comm, [&] {
    const auto n = static_cast<std::size_t>(state.species);
    std::vector<double> X(n);
    std::vector<double> D(n);
    for (int c = 0; c < m.owned; ++c) {
      const std::span<const double> Y{&state.Y[c * n], n};
      double pahMass = 0.0;
      for (std::size_t i = SootSpecies::fixed; i < species_.size(); ++i) pahMass += std::max(Y[species_[i]], 0.0);
      double* scalars = &state.carried[static_cast<std::size_t>(c) * state.carriedCount()];
      const bool empty = scalars[carbon] < TwoEquationSoot::negligibleCarbon && pahMass < 1e-15;
      if (empty) {
        for (int s = 0; s < 3; ++s)
          state.carriedDiffusivity[static_cast<std::size_t>(c) * state.carriedCount() + s] = 0.0;
        continue;
      }
      context_.thermo.massToMole(Y, X);
      const double viscosity =
          context_.transport.mixture(state.temperature[c], state.thermodynamicPressure, X, D).viscosity;
      try {
        advanceCell(state, c, viscosity, dt);
      } catch (const NumericsError& error) {
        throw NumericsError(fmt::format("soot failed in cell {} at ({:.6g}, {:.6g}) m at time {:.6g} s: {}",
                                        m.naturalCell[c], m.centre[c][0], m.centre[c][1], time, error.what()));
      }
      const double diffusivity = model_.diffusivity(gasOf(state, c, viscosity, before_), populationOf(state, c));
      for (int s = 0; s < 3; ++s)
        state.carriedDiffusivity[static_cast<std::size_t>(c) * state.carriedCount() + s] = diffusivity;
    }
  });
  state.updateHalo(context_.halo);
}

}  // namespace lampblack
