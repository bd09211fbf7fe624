// Former names of keys and choices (DeckKey::formerly). A deck with a former name is read as if it had the present one.
#pragma once

#include <string>
#include <vector>

#include "core/modules.hpp"
#include "io/deck_node.hpp"
#include "io/deck_schema.hpp"

namespace lampblack::io {

// The version in which the present names began, and the version that does not read the former ones.
inline constexpr const char *presentNamesBegin = "0.2", *formerNamesEnd = "0.3";

// Replaces former names in the tree of a deck by the present ones. Returns a note for each, which says where it stands
// and what to write. Where one of two names comes from --set, the later assignment holds. InputError where the deck
// itself, or one --set, gives a key by both names.
std::vector<std::string> replaceFormerNames(const DeckSource& source, const DeckSchema& schema, DeckNode& root);

// The present name of a key of this section that has the former name `name`, or a name near to it; empty if there is
// none.
std::string presentName(const DeckSchema::Node& section, const std::string& name);

// The name of a kind of decks, then its former names: those of the choice at `key`, which chooses the kind.
std::vector<std::string> namesOfKind(const DeckKind& kind, const std::string& key);

// "`hold_gas` is a former name of this key; version 0.3 does not read former names."; empty for a key without.
std::string formerNameText(const DeckKey& key);

}  // namespace lampblack::io
