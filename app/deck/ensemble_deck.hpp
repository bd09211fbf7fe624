// The section `stochastic` of every problem: the ensembles of particles that it asks for.
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

// The section, described for the problem, with the keys that all problems have; `method` and `number`: the default
// method and number of numerical particles.
void addEnsembleKeys(DeckSchema& schema, const std::string& description, const std::string& method = "sammc",
                     const std::string& number = "2000");

// Of a deck with the section. `soot`: what the section `soot` says of PAH, surface and switches. InputError, pointing
// into the deck.
[[nodiscard]] EnsembleRequest readEnsemble(const Deck& deck, const SootModelOptions& soot);

}  // namespace lampblack::app
