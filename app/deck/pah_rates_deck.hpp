// The processes of molecules, and the table of their rate constants: keys of a section, or of a file of its own with
// the same names.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "io/deck.hpp"
#include "particles/pah/pah_rates.hpp"

namespace lampblack::app {

void addPahRateKeys(DeckSchema& schema, const std::string& section = "rates");
// The published numbers, but for those of the file, but for those of the deck. InputError.
[[nodiscard]] PahRateConstants readPahRates(const Deck& deck, const std::string& section = "rates");
[[nodiscard]] std::vector<std::string> pahProcessNames();
// The processes that a key lists; all without it.
[[nodiscard]] std::array<bool, pahProcessCount> readPahProcesses(const Deck& deck, const std::string& key);

}  // namespace lampblack::app
