// Checks a deck's tree against a schema and reads every value.
#pragma once

#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::io {

// All values of the deck with the defaults filled in, in the order of the schema. InputError for unknown keys, missing
// required keys, and values that are not what their key says.
std::vector<DeckValue> checkDeck(const DeckSource& source, const DeckNode& root, const DeckSchema& schema);

// The kind of deck this is. InputError where the deck does not say, or names none of them.
const DeckKind& chooseKind(const DeckSource& source, const DeckNode& root, const DeckKinds& kinds);

// Whether a path such as "mesh.z[0].cells" is one of the schema's keys.
bool isDeclared(const DeckSchema& schema, std::string_view path);

}  // namespace lampblack::io
