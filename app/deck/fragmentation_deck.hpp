// Break-up of aggregates of soot by oxidation in a deck: the keys fragmentation and fragmentation_factor of a section.
#pragma once

#include <string>
#include <utility>

#include "core/modules.hpp"
#include "io/deck.hpp"
#include "particles/soot/soot_fragmentation.hpp"

namespace lampblack::app {

// Whether, and the factor; off by default. `description` says what an aggregate breaks into.
[[nodiscard]] std::pair<DeckKey, DeckKey> fragmentationKeys(const std::string& section, const std::string& description);
[[nodiscard]] SootFragmentation readFragmentation(const Deck& deck, const std::string& section);

}  // namespace lampblack::app
