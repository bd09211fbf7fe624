#include "app/reactor/reactor_ensemble_gas.hpp"

#include <cmath>
#include <utility>

#include "app/reactor/reactor_ensemble_columns.hpp"

namespace lampblack::app {

EnsembleGas::EnsembleGas(const ReactorCase& reactorCase, const std::optional<GasState>& inlet) : case_(reactorCase) {
  const ReactorPopulations& populations = *case_.ensemble;
  if (populations.predicted) {
    auto exchange = std::make_unique<ExchangeInGas>(*case_.mechanism, populations.elements, populations.species);
    gas_.expected = exchange.get();
    particles_ = std::move(exchange);
  } else {
    particles_ = std::make_unique<ParticlesAtRest>(numReactors(case_), populations.elements);
  }
  gas_.timePerUnit = [](const double*) { return 1.0; };
  if (case_.type == ReactorType::PlugFlow)
    carryByPlugFlow(inlet ? *inlet : case_.inlet);
  else if (case_.type == ReactorType::Stirred || case_.type == ReactorType::Network)
    carryByNetwork();
  else if (case_.type == ReactorType::GivenGas)
    carryByGivenGas();
  else
    carryByClosedReactor();
  if (!case_.profile) return;
  gas_.kept = {SplitReactor::Gas::Kept::temperature};
  gas_.nextStop = [this](double x) { return case_.profile->nextKink(x).value_or(INFINITY); };
}

void EnsembleGas::carryByPlugFlow(const GasState& inlet) {
  plugFlow_.emplace(*case_.mechanism, inlet, case_.massFlux, case_.length, case_.profile, particles_.get());
  start_ = plugFlow_->initialState();
  gas_.system = &*plugFlow_;
  gas_.pressure = [p = inlet.pressure](double, const double*) { return p; };
  gas_.density = [this](double, const double* y) { return plugFlow_->density(y); };
  gas_.timePerUnit = [this](const double* y) { return 1 / plugFlow_->velocity(y); };
}

void EnsembleGas::carryByNetwork() {
  network_.emplace(*case_.mechanism, case_.network, particles_.get());
  start_ = startUnknowns(*case_.mechanism, case_.network, case_.start, particles_->size());
  gas_.system = &*network_;
  gas_.pressure = [p = case_.network.pressure](double, const double*) { return p; };
  gas_.density = [this](double, const double* block) { return network_->density(block); };
  gas_.kept.clear();
  using Kept = SplitReactor::Gas::Kept;
  for (const StirredReactor& reactor : case_.network.reactors)
    gas_.kept.push_back(reactor.temperature ? Kept::temperature : Kept::enthalpy);
}

void EnsembleGas::carryByGivenGas() {
  along_.emplace(*case_.mechanism, *case_.history, case_.depleted, particles_.get());
  start_ = along_->initialState();
  gas_.system = &*along_;
  gas_.pressure = [this](double t, const double*) { return along_->pressure(t); };
  gas_.density = [this](double t, const double* y) { return along_->density(t, y); };
  gas_.kept = {SplitReactor::Gas::Kept::temperature};
  gas_.nextStop = [this](double t) { return along_->nextRow(t); };
  gas_.held = along_->held();
}

void EnsembleGas::carryByClosedReactor() {
  const bool pressure = case_.type == ReactorType::ConstantPressure;
  closed_.emplace(*case_.mechanism, case_.initial,
                  pressure ? ReactorSystem::Held::Pressure : ReactorSystem::Held::Density, case_.profile,
                  particles_.get());
  start_ = closed_->initialState();
  gas_.system = &*closed_;
  gas_.pressure = [this](double, const double* y) { return closed_->pressure(y); };
  gas_.density = [this](double, const double* y) { return closed_->density(y); };
  if (!pressure) gas_.kept = {SplitReactor::Gas::Kept::internalEnergy};
}

}  // namespace lampblack::app
