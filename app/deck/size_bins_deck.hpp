// Bins of size distributions in a deck: the keys bins, smallest and largest of a section.
#pragma once

#include <string>

#include "core/modules.hpp"
#include "io/deck.hpp"
#include "particles/stochastic/size_bins.hpp"

namespace lampblack::app {

// `largest`: the default of that diameter.
void addSizeBinKeys(DeckSchema& schema, const std::string& section, const std::string& largest = "500 nm");
// InputError, pointing into the deck.
[[nodiscard]] SizeBins readSizeBins(const Deck& deck, const std::string& section);

}  // namespace lampblack::app
