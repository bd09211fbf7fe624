// The section `stochastic` of every problem: the ensembles of particles that it asks for.
#pragma once

#include <cstddef>
#include <string>

#include "core/rooms.hpp"
#include "io/deck.hpp"
#include "particles/ensemble/ensemble_path.hpp"

namespace lampblack::app {

struct EnsembleRequest {
  EnsembleOptions soot;
  std::size_t repeats = 0;
  EnsemblePathOptions bins;
};

// The section, described for the problem, with the keys that all problems have.
void addEnsembleKeys(DeckSchema& schema, const std::string& description);

// Of a deck with the section. `soot`: what the section `soot` says of PAH, surface and switches. InputError, pointing
// into the deck.
[[nodiscard]] EnsembleRequest readEnsemble(const Deck& deck, const SootModelOptions& soot);

}  // namespace lampblack::app
