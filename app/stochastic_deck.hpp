// The section `stochastic` of a deck: ensembles along the paths of a one-dimensional flame, or in a reactor.
#pragma once

#include <optional>
#include <vector>

#include "app/flame_coupling.hpp"
#include "io/deck.hpp"
#include "particles/soot_gas.hpp"

namespace lampblack {

struct StochasticRequest {
  FlameCouplingOptions coupling;  // its ensemble's options are those of the decoupled solution
  bool twoWay = false;
  std::vector<double> heights;  // m, of size distributions
};

// What flames and reactors are told of ensembles alike.
struct EnsembleRequest {
  StochasticSootOptions soot;
  std::size_t repeats = 0;
  SootPathOptions bins;
};

void addStochasticKeys(DeckSchema& schema);       // of a flame
void addReactorEnsembleKeys(DeckSchema& schema);  // of a reactor

// Of a deck with the section. `soot`: what the section `soot` says of PAH, surface and switches. InputError, pointing
// into the deck.
[[nodiscard]] EnsembleRequest readEnsemble(const Deck& deck, const SootModelOptions& soot);

// Empty for a deck without the section. `soot`: what the section `soot` says of PAH, surface and switches. `length`: of
// the flame, m; `bothSides`: particles come from both ends (counterflow). InputError, pointing into the deck.
[[nodiscard]] std::optional<StochasticRequest> readStochastic(const Deck& deck, const SootModelOptions& soot,
                                                              double length, bool bothSides);

}  // namespace lampblack
