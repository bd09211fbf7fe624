#include "app/problems/reactor/reactor_upstream.hpp"

#include <utility>

#include "app/problems/reactor/reactor_ensemble_gas.hpp"

namespace lampblack::app {

ReactorSteadyState steadyUpstream(const ReactorCase& reactorCase, CarriedPhase* carried) {
  return solveNetwork(*reactorCase.mechanism, *reactorCase.upstream, {}, carried)[0];
}

GasState upstreamWithPopulation(const ReactorCase& reactorCase, SplitParticles& particles,
                                const SplitReactor::Options& options) {
  ReactorCase before = reactorCase;
  before.type = ReactorType::Stirred;
  before.network = *reactorCase.upstream;
  before.start.given = steadyUpstream(reactorCase, nullptr).state;
  before.profile.reset();
  EnsembleGas gas(before);
  SplitReactor reactor(*before.mechanism, gas.gas(), particles, options);
  reactor.start(0, gas.start());
  reactor.advance(reactorCase.upstreamTime);
  const std::span<const double> y = reactor.state();
  const std::size_t n = before.mechanism->numSpecies();
  const auto amounts = y.subspan(n + 1, gas.particles().mark());
  return {y[n],
          before.network.pressure,
          {y.begin(), y.begin() + static_cast<std::ptrdiff_t>(n)},
          {amounts.begin(), amounts.end()}};
}

}  // namespace lampblack::app
