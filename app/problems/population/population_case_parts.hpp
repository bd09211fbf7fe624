// The parts of reading a population balance deck; see population_case.hpp.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "app/problems/population/population_case.hpp"
#include "core/modules.hpp"
#include "io/units.hpp"

namespace lampblack::app::populationcase {

// A quantity that this choice needs.
inline double needed(const Deck& deck, const std::string& section, const std::string& key, const std::string& who) {
  if (const auto value = deck.optionalQuantity(section + "." + key)) return *value;
  throw deck.error(section, fmt::format("{} needs the key '{}'", who, key));
}

// The section processes: its keys, and reading it.
void addProcessKeys(DeckSchema& schema);
PopulationModel readModel(const Deck& deck);
// Sintering makes the model's growth active.
PopulationParticles readParticles(const Deck& deck, PopulationModel& model);
// The section methods: its keys, and reading it.
DeckSchema methodKeys();
std::vector<PopulationMethod> readMethods(const Deck& deck, const PopulationCase& populationCase);
// The keys of times, repeats and distributions, which readPopulationCase reads.
DeckSchema outputKeys();
// Refuse what the parts, each in its range, cannot be together. InputError.
void checkProcesses(const Deck& deck, const PopulationCase& populationCase);
void checkMethods(const Deck& deck, const PopulationCase& populationCase);

}  // namespace lampblack::app::populationcase
