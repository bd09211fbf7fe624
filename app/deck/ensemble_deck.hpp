// Ensembles of soot (`particles.description: ensemble`).
#pragma once

#include <cstddef>
#include <string>

#include "core/modules.hpp"
#include "io/deck.hpp"
#include "particles/ensemble/ensemble.hpp"
#include "particles/stochastic/size_bins.hpp"

namespace lampblack::app {

struct EnsembleRequest {
  EnsembleOptions soot;
  std::size_t repeats = 1;  // where there is the key
  SizeBins bins;
};

// The keys of ensembles of soot; `method`: the default one.
void addEnsembleKeys(DeckSchema& schema, const std::string& method);

// Of a deck with an ensemble of soot. `soot`: what the section says of PAH, surface and switches. InputError, pointing
// into the deck.
[[nodiscard]] EnsembleRequest readEnsemble(const Deck& deck, const SootModelOptions& soot);

}  // namespace lampblack::app
