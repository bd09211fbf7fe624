// Keys and sections that count only with some choices of another key (DeckKey::onlyWith).
#pragma once

#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::io {

// Looks at everything the deck says: InputError for what its other choices make meaningless. Defaults of such keys are
// marked as not counting. `values` are all values of the deck.
void applyConditions(const DeckSource& source, const DeckSchema::Node& schema, const DeckNode& root,
                     std::vector<DeckValue>& values);

}  // namespace lampblack::io
