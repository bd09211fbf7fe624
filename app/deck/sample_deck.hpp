// Keys that all stochastic particles have, whatever these are made of: how many numerical particles, how
// finely they are split from their gas, how often a run is repeated, and the bins of their size distributions.
#pragma once

#include <cstddef>
#include <string>

#include "core/modules.hpp"
#include "io/deck.hpp"
#include "particles/stochastic/size_bins.hpp"

namespace lampblack::app {

// `number` of `section`, with its default.
[[nodiscard]] DeckKey sampleNumberKey(const std::string& section, const std::string& number);
[[nodiscard]] DeckKey splitToleranceKey(const std::string& section, const std::string& splitTolerance);
// Of problems whose populations are repeated: how often, and with which random numbers.
void addRepeatKeys(DeckSchema& schema);
// How the particles and their gas go on together.
void addCouplingKeys(DeckSchema& schema);
// The bins of size distributions, with their default largest diameter.
void addSizeBinKeys(DeckSchema& schema, const std::string& section, const std::string& largest = "500 nm");

// The number of numerical particles, of which each takes so many bytes. InputError for more than the memory holds.
[[nodiscard]] std::size_t readSampleNumber(const Deck& deck, const std::string& section, double bytes);
// InputError where the largest diameter is not above the smallest.
[[nodiscard]] SizeBins readSizeBins(const Deck& deck, const std::string& section);

}  // namespace lampblack::app
