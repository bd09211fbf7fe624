#include "app/problems/reactor/reactor_upstream.hpp"

#include <utility>

#include "app/problems/reactor/reactor_ensemble_gas.hpp"

namespace lampblack::app {

ReactorSteadyState steadyUpstream(const Mechanism& mechanism, const PlugFlowKind& duct, CarriedPhase* carried) {
  return solveNetwork(mechanism, *duct.upstream, {}, carried)[0];
}

GasState upstreamWithPopulation(const ReactorCase& reactorCase, const PlugFlowKind& duct, SplitParticles& particles) {
  const auto stirred = std::make_shared<StirredKind>();
  stirred->vessels = *duct.upstream;
  stirred->start.given = steadyUpstream(*reactorCase.mechanism, duct, nullptr).state;
  ReactorCase before = reactorCase;
  before.kind = stirred;
  before.profile.reset();
  EnsembleGas gas(before);
  SplitReactor reactor(*before.mechanism, gas.gas(), particles, splitOptions(before));
  reactor.start(0, gas.start());
  reactor.advance(duct.upstreamTime);
  const std::span<const double> y = reactor.state();
  const std::size_t n = before.mechanism->numSpecies();
  const auto amounts = y.subspan(n + 1, gas.particles().mark());
  return {y[n],
          stirred->vessels.pressure,
          {y.begin(), y.begin() + static_cast<std::ptrdiff_t>(n)},
          {amounts.begin(), amounts.end()}};
}

}  // namespace lampblack::app
