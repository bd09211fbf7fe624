#include "coupling/engine_soot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/errors.hpp"

namespace lampblack::coupling {
namespace {

// Of a row: whether it changes, factor of the mass, temperature, enthalpy given, steps.
constexpr std::size_t headValues = 5;

// Any gas, until a particle gives its own.
GasState anyGas(std::size_t species) {
  GasState gas{1000, 1e5, std::vector<double>(species, 0)};
  gas.Y[0] = 1;
  return gas;
}

StiffIntegrator::Options integratorOptions(const ConstantPressureReactor::Options& tolerances) {
  return {tolerances.relativeTolerance, tolerances.absoluteTolerance, 0, tolerances.maxSteps};
}

}  // namespace

EngineSoot::EngineSoot(MPI_Comm comm, const Mechanism& mechanism, const Thermo& thermo, CarriedParticles& particles,
                       const ConstantPressureReactor::Options& tolerances)
    : comm_(comm),
      thermo_(thermo),
      particles_(particles),
      phase_(mechanism, particles),
      scalars_(particles.scalars().size()),
      formation_(mechanism.numSpecies()),
      reactor_(mechanism, anyGas(mechanism.numSpecies()), ReactorSystem::Held::Pressure, std::nullopt, &phase_),
      integrator_(reactor_, integratorOptions(tolerances)),
      densities_(scalars_),
      enthalpy_(scalars_),
      slope_(scalars_) {
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &ranks_);
  for (const CarriedModel::Scalar& scalar : particles.scalars()) {
    elements_.push_back(scalar.elements);
    unitMass_.push_back(std::accumulate(scalar.elements.begin(), scalar.elements.end(), 0.0));
  }
  thermo.speciesEnthalpies(formationTemperature, formation_);
}

double EngineSoot::enthalpyOf(double T, std::span<const double> amounts) {
  particles_.enthalpies(T, enthalpy_, slope_);
  return std::inner_product(amounts.begin(), amounts.end(), enthalpy_.begin(), 0.0);
}

// The reactor counts by the kg of gas and soot together, the gas of the engine by the kg of gas.
void EngineSoot::reactOne(double duration, const EngineGas& gas, std::size_t i, std::span<double> row) {
  const std::span<const double> Y = gas.Y(i), amounts = gas.amounts(i);
  const double T = gas.temperature[i], density = thermo_.density(T, gas.pressure, Y);
  for (std::size_t s = 0; s < scalars_; ++s) densities_[s] = density * amounts[s];
  if (particles_.idle(phase_.gas().atComposition(T, gas.pressure, Y), densities_)) return;

  const double gasShare = 1 / (1 + std::inner_product(amounts.begin(), amounts.end(), unitMass_.begin(), 0.0));
  start_.temperature = T;
  start_.pressure = gas.pressure;
  start_.Y.assign(Y.begin(), Y.end());
  for (double& fraction : start_.Y) fraction *= gasShare;
  start_.carried.resize(scalars_);
  phase_.amounts(1 / gasShare, amounts, start_.carried);
  reactor_.startFrom(start_);
  integrator_.start(0, reactor_.initialState(), duration);
  while (integrator_.time() < duration) integrator_.step();

  const std::span<const double> y = integrator_.state();
  const std::span<double> newY = row.subspan(headValues, gas.species),
                          newAmounts = row.subspan(headValues + gas.species);
  std::copy_n(y.begin(), gas.species, newY.begin());
  const double newShare = std::accumulate(newY.begin(), newY.end(), 0.0);
  for (double& fraction : newY) fraction /= newShare;
  phase_.densities(1 / newShare, y.subspan(gas.species + 1, scalars_), newAmounts);
  const double factor = newShare / gasShare;
  const double given = factor * enthalpyOf(y[gas.species], newAmounts) - enthalpyOf(T, amounts);
  row[0] = 1;
  row[1] = factor;
  row[2] = thermo_.temperatureFromEnthalpy((thermo_.enthalpyMass(T, Y) - given) / factor, newY, y[gas.species]);
  row[3] = given;
  row[4] = static_cast<double>(integrator_.statistics().steps);
}

EngineCarried::Work EngineSoot::react(double duration, EngineGas& gas, std::vector<char>& isDone) {
  const std::size_t width = headValues + gas.species + scalars_;
  rows_.assign(gas.count() * width, 0);
  const auto ranks = static_cast<std::size_t>(ranks_);
  collectively(comm_, [&] {
    for (auto i = static_cast<std::size_t>(rank_); i < gas.count(); i += ranks) {
      try {
        reactOne(duration, gas, i, std::span(rows_).subspan(i * width, width));
      } catch (const NumericsError& error) {
        throw NumericsError(fmt::format("particle {} with its {}: {}", i, particles_.material(), error.what()));
      }
    }
  });
  // Each row is of one rank, and zero on the others.
  if (ranks_ > 1) MPI_Allreduce(MPI_IN_PLACE, rows_.data(), static_cast<int>(rows_.size()), MPI_DOUBLE, MPI_SUM, comm_);
  particles_.enthalpies(formationTemperature, enthalpy_, slope_);
  Work work;
  for (std::size_t i = 0; i < gas.count(); ++i) {
    const std::span<const double> row = std::span<const double>(rows_).subspan(i * width, width);
    isDone[i] = row[0] != 0 ? 1 : 0;
    if (isDone[i] == 0) continue;
    const std::span<const double> Y = row.subspan(headValues, gas.species),
                                  amounts = row.subspan(headValues + gas.species);
    const double before = gas.mass[i], after = before * row[1];
    for (std::size_t k = 0; k < gas.species; ++k) work.heat -= formation_[k] * (after * Y[k] - before * gas.Y(i)[k]);
    for (std::size_t s = 0; s < scalars_; ++s)
      work.heat -= enthalpy_[s] * (after * amounts[s] - before * gas.amounts(i)[s]);
    work.given += before * row[3];
    work.steps += row[4];
    gas.mass[i] = after;
    gas.temperature[i] = row[2];
    std::ranges::copy(Y, gas.Y(i).begin());
    std::ranges::copy(amounts, gas.amounts(i).begin());
  }
  return work;
}

}  // namespace lampblack::coupling
