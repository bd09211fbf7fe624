// Stochastic populations of a reactor or along a given gas.
#include <fmt/format.h>

#include <utility>

#include "app/deck/particles_deck.hpp"
#include "app/problems/reactor/reactor_case_parts.hpp"
#include "particles/models/element_enthalpies.hpp"

namespace lampblack::app::reactorcase {
void readPopulations(const Deck& deck, ReactorCase& reactorCase) {
  ReactorPopulations populations{readPopulation(deck, reactorCase.mechanism)};
  reactorCase.kind->checkPopulation(deck);
  reactorCase.couplingChange = deck.number("particles.coupling_change");
  populations.predicted = deck.choice("particles.coupling") == "predictor_corrector";
  // To find what it lacks.
  deck.at(particleSection,
          [&] { const ReactorGas gas(*reactorCase.mechanism, populations.species, populations.viscosity); });
  const bool isGiven = reactorCase.profile || reactorCase.kind->isGiven() || reactorCase.kind->hasGivenTemperature();
  if (!isGiven && !elementEnthalpies(populations.elements))
    throw deck.error("reactor.energy",
                     fmt::format("the heat of particles of {} is not known: give the temperature, 'isothermal' or "
                                 "'profile'",
                                 populations.material));
  reactorCase.ensemble = std::move(populations);
}

}  // namespace lampblack::app::reactorcase
