#include "app/problems/reactor/reactor_ensemble_gas.hpp"

#include <cmath>
#include <utility>

namespace lampblack::app {

SplitReactor::Options splitOptions(const ReactorCase& reactorCase) {
  SplitReactor::Options split;
  split.integrator = reactorCase.integrator;
  split.change = reactorCase.couplingChange;
  return split;
}

EnsembleGas::EnsembleGas(const ReactorCase& reactorCase, SplitParticles* population) : case_(reactorCase) {
  const ReactorPopulations& populations = *case_.ensemble;
  ExchangeInGas* expected = nullptr;
  if (populations.predicted) {
    auto exchange = std::make_unique<ExchangeInGas>(*case_.mechanism, populations.elements, populations.species);
    expected = exchange.get();
    particles_ = std::move(exchange);
  } else {
    particles_ = std::make_unique<ParticlesAtRest>(case_.kind->reactors(), populations.elements);
  }
  made_ = case_.kind->repeatGas(case_, *particles_, population);
  made_.gas.expected = expected;
  if (!case_.profile) return;
  made_.gas.kept = {SplitReactor::Gas::Kept::temperature};
  made_.gas.nextStop = [this](double x) { return case_.profile->nextKink(x).value_or(INFINITY); };
}

}  // namespace lampblack::app
