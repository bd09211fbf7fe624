// What other programs and papers call keys and choices of decks.
#pragma once

#include "core/modules.hpp"
#include "io/deck_schema.hpp"

namespace lampblack::app {

// For the schemas of all problems (DeckSchema::calledElsewhere).
[[nodiscard]] OtherNames otherNamesOfKeysAndChoices();

}  // namespace lampblack::app
