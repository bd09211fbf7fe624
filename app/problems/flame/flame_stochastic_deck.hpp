// The population of a flame's deck, along its paths, and how it is coupled with the flame.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "coupling/flame_coupling.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

struct StochasticRequest {
  FlameCouplingOptions coupling;  // its ensemble's options are those of the decoupled solution
  bool twoWay = false;
  std::vector<std::string> elements;  // of the particles
  std::string watched;                // the species by which changes of the gas are seen
  std::vector<double> heights;        // m, of size distributions
};

void addStochasticKeys(DeckSchema& schema);

// Empty for a deck without a population. `length`: of the flame, m; `bothSides`: particles come from both ends
// (counterflow). InputError, pointing into the deck.
[[nodiscard]] std::optional<StochasticRequest> readStochastic(const Deck& deck,
                                                              const std::shared_ptr<const Mechanism>& mechanism,
                                                              double length, bool bothSides);

}  // namespace lampblack::app
