// The section `stochastic` of a flame's deck: ensembles along its paths, and how they are coupled with it.
#pragma once

#include <optional>
#include <vector>

#include "core/modules.hpp"
#include "coupling/flame_coupling.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

struct StochasticRequest {
  FlameCouplingOptions coupling;  // its ensemble's options are those of the decoupled solution
  bool twoWay = false;
  std::vector<double> heights;  // m, of size distributions
};

void addStochasticKeys(DeckSchema& schema);

// Empty for a deck without the section. `soot`: what the section `soot` says of PAH, surface and switches. `length`: of
// the flame, m; `bothSides`: particles come from both ends (counterflow). InputError, pointing into the deck.
[[nodiscard]] std::optional<StochasticRequest> readStochastic(const Deck& deck, const SootModelOptions& soot,
                                                              double length, bool bothSides);

}  // namespace lampblack::app
