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
  H_ = m.speciesIndex("H");
  H2_ = m.speciesIndex("H2");
  OH_ = m.speciesIndex("OH");
  H2O_ = m.speciesIndex("H2O");
  O2_ = m.speciesIndex("O2");
  C2H2_ = m.speciesIndex("C2H2");
  CO_ = m.speciesIndex("CO");
  for (const PahSpecies& pah : model_.options().pah) pah_.push_back(m.speciesIndex(pah.name));
  speciesEnthalpy_.resize(m.numSpecies());
  partialDensity_.resize(m.numSpecies());
  pahConcentration_.resize(pah_.size());
}

TwoEquationSoot::Population SootOperator::populationOf(const State& state, int cell) const {
  const double* values = &state.carried[static_cast<std::size_t>(cell) * state.carriedCount()];
  return {values[number], values[carbon], values[hydrogen]};
}

SootGasState SootOperator::gasOf(const State& state, int cell, double viscosity, std::vector<double>& pah) const {
  const auto n = static_cast<std::size_t>(state.species);
  const double* Y = &state.Y[cell * n];
  const auto W = context_.mechanism.molecularWeights();
  const double rho = state.density[cell];
  const auto concentration = [&](std::size_t k) { return rho * Y[k] / W[k]; };
  pah.resize(pah_.size());
  for (std::size_t i = 0; i < pah_.size(); ++i) pah[i] = concentration(pah_[i]);
  SootGasState gas;
  gas.temperature = state.temperature[cell];
  gas.pressure = state.thermodynamicPressure;
  gas.density = rho;
  gas.viscosity = viscosity;
  gas.meanMolecularWeight = context_.thermo.meanMolecularWeight({Y, n});
  gas.H = concentration(H_);
  gas.H2 = concentration(H2_);
  gas.OH = concentration(OH_);
  gas.H2O = concentration(H2O_);
  gas.O2 = concentration(O2_);
  gas.C2H2 = concentration(C2H2_);
  gas.pah = pah;
  return gas;
}

void SootOperator::advanceCell(State& state, int cell, double viscosity, double dt) {
  const auto n = static_cast<std::size_t>(state.species);
  double* Y = &state.Y[cell * n];
  double* scalars = &state.carried[static_cast<std::size_t>(cell) * state.carriedCount()];
  const auto W = context_.mechanism.molecularWeights();
  const double rho = state.density[cell];

  const SootGasState gas = gasOf(state, cell, viscosity, pahState_);
  TwoEquationSoot::Population population = populationOf(state, cell);
  const TwoEquationSoot::Population before = population;
  SootCellGas exchange{gas.H, gas.H2, gas.OH, gas.H2O, gas.O2, gas.C2H2, rho * Y[CO_] / W[CO_], pahConcentration_};
  std::copy(pahState_.begin(), pahState_.end(), pahConcentration_.begin());
  const SootCellGas start = exchange;
  const auto report = model_.advance(gas, dt, population, exchange);
  limitedOxidations_ += report.limitedOxidation;

  // Back to the gas's partial densities; what did not change keeps its bits.
  bool changed = false;
  double mass = 0.0;
  std::vector<double>& partial = partialDensity_;
  for (std::size_t k = 0; k < n; ++k) partial[k] = rho * Y[k];
  const auto put = [&](std::size_t k, double from, double to) {
    if (from == to) return;
    partial[k] += (to - from) * W[k];
    changed = true;
  };
  put(H_, start.H, exchange.H);
  put(H2_, start.H2, exchange.H2);
  put(OH_, start.OH, exchange.OH);
  put(H2O_, start.H2O, exchange.H2O);
  put(O2_, start.O2, exchange.O2);
  put(C2H2_, start.C2H2, exchange.C2H2);
  put(CO_, start.CO, exchange.CO);
  for (std::size_t i = 0; i < pah_.size(); ++i) put(pah_[i], pahState_[i], pahConcentration_[i]);
  scalars[number] = population.number;
  scalars[carbon] = population.carbon;
  scalars[hydrogen] = population.hydrogen;
  if (!changed) return;

  for (std::size_t k = 0; k < n; ++k) mass += partial[k];
  for (std::size_t k = 0; k < n; ++k) Y[k] = partial[k] / mass;
  context_.thermo.speciesEnthalpies(gas.temperature, speciesEnthalpy_);
  const double given = (population.carbon - before.carbon) * sootCarbonEnthalpy(gas.temperature).first +
                       (population.hydrogen - before.hydrogen) * speciesEnthalpy_[H2_];
  state.enthalpy[cell] = (rho * state.enthalpy[cell] - given) / mass;
  state.density[cell] = mass;
  state.temperature[cell] = context_.thermo.temperatureFromEnthalpy(state.enthalpy[cell], {Y, n}, gas.temperature);
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
      for (std::size_t k : pah_) pahMass += std::max(Y[k], 0.0);
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
      const double diffusivity = model_.diffusivity(gasOf(state, c, viscosity, pahState_), populationOf(state, c));
      for (int s = 0; s < 3; ++s)
        state.carriedDiffusivity[static_cast<std::size_t>(c) * state.carriedCount() + s] = diffusivity;
    }
  });
  state.updateHalo(context_.halo);
}

}  // namespace lampblack
