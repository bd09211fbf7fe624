#include "app/problems/reactor/reactor_ensemble_gas.hpp"

#include <cmath>
#include <utility>

#include "app/problems/reactor/reactor_ensemble_columns.hpp"
#include "coupling/split_gas.hpp"

namespace lampblack::app {

EnsembleGas::EnsembleGas(const ReactorCase& reactorCase, const std::optional<GasState>& inlet) : case_(reactorCase) {
  const ReactorPopulations& populations = *case_.ensemble;
  ExchangeInGas* expected = nullptr;
  if (populations.predicted) {
    auto exchange = std::make_unique<ExchangeInGas>(*case_.mechanism, populations.elements, populations.species);
    expected = exchange.get();
    particles_ = std::move(exchange);
  } else {
    particles_ = std::make_unique<ParticlesAtRest>(numReactors(case_), populations.elements);
  }
  if (case_.type == ReactorType::PlugFlow)
    carryByPlugFlow(inlet ? *inlet : case_.inlet);
  else if (case_.type == ReactorType::Stirred || case_.type == ReactorType::Network)
    carryByNetwork();
  else if (case_.type == ReactorType::GivenGas)
    carryByGivenGas();
  else
    carryByClosedReactor();
  gas_.expected = expected;
  if (!case_.profile) return;
  gas_.kept = {SplitReactor::Gas::Kept::temperature};
  gas_.nextStop = [this](double x) { return case_.profile->nextKink(x).value_or(INFINITY); };
}

void EnsembleGas::carryByPlugFlow(const GasState& inlet) {
  plugFlow_.emplace(*case_.mechanism, inlet, case_.massFlux, case_.length, case_.profile, particles_.get());
  start_ = plugFlow_->initialState();
  gas_ = splitGas(*plugFlow_, inlet.pressure);
}

void EnsembleGas::carryByNetwork() {
  network_.emplace(*case_.mechanism, case_.network, particles_.get());
  start_ = startUnknowns(*case_.mechanism, case_.network, case_.start, particles_->size());
  gas_ = splitGas(*network_);
}

void EnsembleGas::carryByGivenGas() {
  along_.emplace(*case_.mechanism, *case_.history, case_.depleted, particles_.get());
  start_ = along_->initialState();
  gas_ = splitGas(*along_);
}

void EnsembleGas::carryByClosedReactor() {
  const auto held =
      case_.type == ReactorType::ConstantPressure ? ReactorSystem::Held::Pressure : ReactorSystem::Held::Density;
  closed_.emplace(*case_.mechanism, case_.initial, held, case_.profile, particles_.get());
  start_ = closed_->initialState();
  gas_ = splitGas(*closed_, held);
}

}  // namespace lampblack::app
