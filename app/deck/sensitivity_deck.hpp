// Sensitivities of a result to the rate constants: the section `sensitivity` of a deck, and what is left of them in the
// files and on the console.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"
#include "io/results_writer.hpp"

namespace lampblack::app {

// The section: what it computes in words, its only choice of sensitivity.of, and which decks have it.
void addSensitivityKeys(DeckSchema& schema, const std::string& doc, const std::string& of,
                        std::vector<DeckCondition> onlyWith);

// The reactions of sensitivity.reactions, by their number from 0. InputError.
std::vector<std::size_t> readSensitivityReactions(const Deck& deck, const Mechanism& mechanism);

// d ln(result) / d ln k of the reactions in their order; empty where there is no result.
struct Sensitivities {
  std::string name;
  std::vector<double> values;
};

// sensitivities.csv: a row for each reaction, a column for each result that is there.
std::string sensitivityTable(const Mechanism& mechanism, std::span<const std::size_t> reactions,
                             std::span<const Sensitivities> results);

// Collective, rank 0 has the values: the group /sensitivity; NaN where there is no result.
void writeSensitivities(ResultsWriter& file, std::span<const std::size_t> reactions,
                        std::span<const Sensitivities> results, const std::string& doc);

// Lines for the console: the largest, and the sum of all with what theory says of it.
std::string largestSensitivities(const Mechanism& mechanism, std::span<const std::size_t> reactions,
                                 std::span<const double> values, const std::string& sum);

}  // namespace lampblack::app
