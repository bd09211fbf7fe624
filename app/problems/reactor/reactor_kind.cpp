#include "app/problems/reactor/reactor_kind.hpp"

#include <algorithm>

#include "app/deck/particles_deck.hpp"
#include "app/problems/reactor/reactor_driver.hpp"
#include "app/problems/reactor/reactor_ensemble_gas.hpp"
#include "app/problems/reactor/reactor_upstream.hpp"
#include "chemistry/reactor/plug_flow.hpp"
#include "coupling/split_gas.hpp"

namespace lampblack::app {

std::unique_ptr<ReactorDriver> ClosedKind::driver(const ReactorCase& reactorCase) const {
  return closedReactorDriver(reactorCase, *this);
}

RepeatGas ClosedKind::repeatGas(const ReactorCase& reactorCase, ParticlesAtRest& carried, SplitParticles*) const {
  const auto reactor =
      std::make_shared<ClosedReactor>(*reactorCase.mechanism, initial, held, reactorCase.profile, &carried);
  return {reactor, splitGas(*reactor, held), reactor->initialState()};
}

void ClosedKind::checkPopulation(const Deck& deck) const {
  if (volume)
    throw deck.error("reactor.type",
                     "ensembles and trees are not there in a given volume; expected constant_pressure or "
                     "constant_volume, moments or sections of particles, or problem: prescribed_gas along the "
                     "history of this run");
  if (deck.has("sensitivity") || (deck.isGiven("ignition") && !ignition.empty()))
    throw deck.error(deck.has("sensitivity") ? "sensitivity" : "ignition",
                     "ignition delays of a gas with an ensemble are not computed; leave this section out");
}

std::unique_ptr<ReactorDriver> StirredKind::driver(const ReactorCase& reactorCase) const {
  return duration > 0 ? stirredTransientDriver(reactorCase, *this) : steadyNetworkDriver(reactorCase, *this);
}

RepeatGas StirredKind::repeatGas(const ReactorCase& reactorCase, ParticlesAtRest& carried, SplitParticles*) const {
  const auto system = std::make_shared<NetworkSystem>(*reactorCase.mechanism, vessels, &carried);
  return {system, splitGas(*system), startUnknowns(*reactorCase.mechanism, vessels, start, carried.size())};
}

void StirredKind::checkPopulation(const Deck& deck) const {
  if (duration == 0)
    throw deck.error(particleSection,
                     "the steady state of an ensemble is a mean over time: give time.end, of many residence times; the "
                     "second half is averaged");
  for (const StirredReactor& reactor : vessels.reactors)
    if (reactor.name.find('/') != std::string::npos)
      throw deck.error("network.reactors." + reactor.name,
                       "results of ensembles bear the name of the reactor, which may have no '/'");
  if (isNetwork && deck.choice("particles.coupling") == "predictor_corrector")
    throw deck.error("particles.coupling", "in a network gas and particles are coupled by splitting alone");
}

bool StirredKind::hasGivenTemperature() const {
  return std::ranges::all_of(vessels.reactors, [](const StirredReactor& r) { return bool(r.temperature); });
}

std::unique_ptr<ReactorDriver> PlugFlowKind::driver(const ReactorCase& reactorCase) const {
  return plugFlowDriver(reactorCase, *this);
}

RepeatGas PlugFlowKind::repeatGas(const ReactorCase& reactorCase, ParticlesAtRest& carried,
                                  SplitParticles* population) const {
  const GasState entering =
      upstream && population != nullptr ? upstreamWithPopulation(reactorCase, *this, *population) : inlet;
  const auto flow =
      std::make_shared<PlugFlow>(*reactorCase.mechanism, entering, massFlux, length, reactorCase.profile, &carried);
  return {flow, splitGas(*flow, entering.pressure), flow->initialState(),
          [at = flow.get()](double, std::span<const double> y) { return at->residenceTime(y.data()); }};
}

std::vector<Quantity> PlugFlowKind::placeColumns() const {
  return {{"position", "m", "distance from the inlet"},
          {"time", "s", "residence time since the inlet"},
          {"velocity", "m/s", "velocity of gas and particles"}};
}

}  // namespace lampblack::app
