// Populations of a reactor or along a given gas: trees of the section `particles`, ensembles of the section
// `stochastic`.
#include <fmt/format.h>

#include "app/deck/soot_deck.hpp"
#include "app/deck/trees_deck.hpp"
#include "app/reactor/reactor_case_parts.hpp"
#include "core/errors.hpp"
#include "coupling/reactor_ensemble.hpp"
#include "coupling/reactor_trees.hpp"
#include "particles/models/element_enthalpies.hpp"

namespace lampblack::app::reactorcase {
namespace {

// One, to find what it lacks.
void tryPopulation(const Deck& deck, const std::string& section, ReactorCase& reactorCase) {
  try {
    const auto trial = reactorCase.ensemble->make(0);
    const ReactorGas gas(*reactorCase.mechanism, trial->species(), trial->viscosity());
    reactorCase.ensemble->material = trial->material();
    reactorCase.ensemble->elements = trial->elements();
    reactorCase.ensemble->species = trial->species();
  } catch (const InputError& error) {
    throw deck.error(section, error.what());
  }
}

// What a population of any kind cannot have.
void refuseWithPopulation(const Deck& deck, const std::string& section, ReactorCase& reactorCase) {
  if (reactorCase.type == ReactorType::GivenGas) return;
  if (deck.has("sensitivity") || (deck.isGiven("ignition") && !reactorCase.ignition.empty()))
    throw deck.error(deck.has("sensitivity") ? "sensitivity" : "ignition",
                     "ignition delays of a gas with an ensemble are not computed; leave this section out");
  reactorCase.ignition.clear();
  if ((reactorCase.type == ReactorType::Stirred || reactorCase.type == ReactorType::Network) && reactorCase.end == 0)
    throw deck.error(section,
                     "the steady state of an ensemble is a mean over time: give time.end, of many residence times; the "
                     "second half is averaged");
}

bool readPredicted(const Deck& deck, const std::string& section, const ReactorCase& reactorCase) {
  const bool predicted = deck.choice(section + ".coupling") == "predictor_corrector";
  if (predicted && reactorCase.type == ReactorType::Network)
    throw deck.error(section + ".coupling", "in a network gas and particles are coupled by splitting alone");
  return predicted;
}

}  // namespace

void readTreePopulations(const Deck& deck, ReactorCase& reactorCase) {
  if (deck.has("stochastic"))
    throw deck.error("stochastic",
                     "particles of the section 'particles' take the place of ensembles; leave out one of the two");
  refuseWithPopulation(deck, "particles", reactorCase);
  if (reactorCase.type == ReactorType::Network)
    throw deck.error("reactor.type", "particles of the section 'particles' do not go from one reactor to another");
  TreeRequest request = readTrees(deck, *reactorCase.mechanism);
  const bool isGiven = reactorCase.profile || reactorCase.type == ReactorType::GivenGas ||
                       (reactorCase.type == ReactorType::Stirred && reactorCase.network.reactors[0].temperature);
  reactorCase.couplingChange = deck.number("particles.coupling_change");
  reactorCase.ensemble = {request.repeats,
                          request.bins,
                          {},
                          {},
                          {},
                          readPredicted(deck, "particles", reactorCase),
                          [mechanism = reactorCase.mechanism, request](std::uint64_t owner) {
                            TreeOptions own = request.options;
                            own.owner = owner;
                            return std::make_unique<ReactorTrees>(*mechanism, own, request.viscosity, request.start);
                          },
                          request.tablesAt,
                          {}};
  if (!request.classesByDiameter.empty()) reactorCase.ensemble->classes.push_back({0, request.classesByDiameter});
  if (!request.classesByPrimaries.empty()) reactorCase.ensemble->classes.push_back({1, request.classesByPrimaries});
  tryPopulation(deck, "particles", reactorCase);
  if (!isGiven && !elementEnthalpies(reactorCase.ensemble->elements))
    throw deck.error("reactor.energy",
                     fmt::format("the heat of particles of {} is not known: give the temperature, 'isothermal' or "
                                 "'profile'",
                                 reactorCase.ensemble->material));
}

void readEnsemblePopulations(const Deck& deck, ReactorCase& reactorCase) {
  if (!deck.has("soot")) throw deck.error("stochastic", "ensembles need the section 'soot': PAH, surface, switches");
  if (deck.isGiven("soot.model") && deck.choice("soot.model") != "none")
    throw deck.error("soot.model",
                     "an ensemble takes the place of a model: leave this out, or the section 'stochastic'");
  refuseWithPopulation(deck, "stochastic", reactorCase);
  for (const StirredReactor& reactor : reactorCase.network.reactors)
    if (reactor.name.find('/') != std::string::npos)
      throw deck.error("network.reactors." + reactor.name,
                       "results of ensembles bear the name of the reactor, which may have no '/'");
  const EnsembleRequest request = readEnsemble(deck, readSootModelOptions(deck, *reactorCase.mechanism));
  reactorCase.couplingChange = deck.number("stochastic.coupling_change");
  reactorCase.ensemble = {request.repeats,
                          request.bins,
                          {},
                          {},
                          {},
                          readPredicted(deck, "stochastic", reactorCase),
                          [mechanism = reactorCase.mechanism, options = request.soot](std::uint64_t owner) {
                            EnsembleOptions own = options;
                            own.owner = owner;
                            return std::make_unique<ReactorEnsemble>(*mechanism, own);
                          },
                          {},
                          {}};
  tryPopulation(deck, "stochastic", reactorCase);
}

}  // namespace lampblack::app::reactorcase
