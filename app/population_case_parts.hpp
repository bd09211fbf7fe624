// The parts of reading a population balance deck; see population_case.hpp.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/population_case.hpp"
#include "io/units.hpp"

namespace lampblack::populationcase {

// A key that only some choices of another key have.
struct Belongs {
  const char* key;
  std::vector<std::string> choices;
};

// Refuses the keys of a section that the choice made does not have: "the kernel additive does not have this; ...".
inline void refuseOthers(const Deck& deck, const std::string& section, const std::vector<Belongs>& keys,
                         const std::string& what, const std::string& choice) {
  for (const Belongs& belongs : keys) {
    const std::string path = section + "." + belongs.key;
    const auto& choices = belongs.choices;
    if (deck.isGiven(path) && std::find(choices.begin(), choices.end(), choice) == choices.end())
      throw deck.error(
          path, fmt::format("the {} {} does not have this; it belongs to: {}", what, choice, fmt::join(choices, ", ")));
  }
}

// A quantity that this choice needs.
inline double needed(const Deck& deck, const std::string& section, const std::string& key, const std::string& who) {
  if (const auto value = deck.optionalQuantity(section + "." + key)) return *value;
  throw deck.error(section, fmt::format("{} needs the key '{}'", who, key));
}

// The volume of a particle, given as such or by a diameter.
double readSize(const Deck& deck, const std::string& section, const std::string& who);

PopulationModel readModel(const Deck& deck);
// Sintering makes the model's growth active.
PopulationParticles readParticles(const Deck& deck, PopulationModel& model);
std::vector<PopulationMethod> readMethods(const Deck& deck, const PopulationCase& populationCase);

}  // namespace lampblack::populationcase
