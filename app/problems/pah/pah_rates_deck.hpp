// The table of rate constants of molecules: keys of the section `rates`, or of a file of its own with the same names.
#pragma once

#include "core/modules.hpp"
#include "io/deck.hpp"
#include "particles/pah/pah_rates.hpp"

namespace lampblack::app {

void addPahRateKeys(DeckSchema& schema);
// The published numbers, but for those of the file, but for those of the deck. InputError.
[[nodiscard]] PahRateConstants readPahRates(const Deck& deck);

}  // namespace lampblack::app
