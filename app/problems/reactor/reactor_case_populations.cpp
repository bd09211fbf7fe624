// Stochastic populations of a reactor or along a given gas.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/deck/particles_deck.hpp"
#include "app/problems/reactor/reactor_case_parts.hpp"
#include "particles/models/element_enthalpies.hpp"

namespace lampblack::app::reactorcase {
namespace {

// What a population of any kind cannot have.
void refuseWithPopulation(const Deck& deck, ReactorCase& reactorCase) {
  if (reactorCase.type == ReactorType::GivenGas) return;
  if (reactorCase.type == ReactorType::GivenVolume)
    throw deck.error("reactor.type",
                     "ensembles and trees are not there in a given volume; expected constant_pressure or "
                     "constant_volume, moments or sections of particles, or problem: prescribed_gas along the "
                     "history of this run");
  if (deck.has("sensitivity") || (deck.isGiven("ignition") && !reactorCase.ignition.empty()))
    throw deck.error(deck.has("sensitivity") ? "sensitivity" : "ignition",
                     "ignition delays of a gas with an ensemble are not computed; leave this section out");
  reactorCase.ignition.clear();
  if ((reactorCase.type == ReactorType::Stirred || reactorCase.type == ReactorType::Network) && reactorCase.end == 0)
    throw deck.error(particleSection,
                     "the steady state of an ensemble is a mean over time: give time.end, of many residence times; the "
                     "second half is averaged");
}

bool readPredicted(const Deck& deck, const ReactorCase& reactorCase) {
  const bool predicted = deck.choice("particles.coupling") == "predictor_corrector";
  if (predicted && reactorCase.type == ReactorType::Network)
    throw deck.error("particles.coupling", "in a network gas and particles are coupled by splitting alone");
  return predicted;
}

}  // namespace

void readPopulations(const Deck& deck, ReactorCase& reactorCase) {
  ReactorPopulations populations{readPopulation(deck, reactorCase.mechanism)};
  refuseWithPopulation(deck, reactorCase);
  for (const StirredReactor& reactor : reactorCase.network.reactors)
    if (reactor.name.find('/') != std::string::npos)
      throw deck.error("network.reactors." + reactor.name,
                       "results of ensembles bear the name of the reactor, which may have no '/'");
  reactorCase.couplingChange = deck.number("particles.coupling_change");
  populations.predicted = readPredicted(deck, reactorCase);
  // To find what it lacks.
  deck.at(particleSection,
          [&] { const ReactorGas gas(*reactorCase.mechanism, populations.species, populations.viscosity); });
  const std::vector<StirredReactor>& stirred = reactorCase.network.reactors;
  const bool isGiven =
      reactorCase.profile || reactorCase.type == ReactorType::GivenGas ||
      (!stirred.empty() && std::ranges::all_of(stirred, [](const StirredReactor& r) { return bool(r.temperature); }));
  if (!isGiven && !elementEnthalpies(populations.elements))
    throw deck.error("reactor.energy",
                     fmt::format("the heat of particles of {} is not known: give the temperature, 'isothermal' or "
                                 "'profile'",
                                 populations.material));
  reactorCase.ensemble = std::move(populations);
}

}  // namespace lampblack::app::reactorcase
