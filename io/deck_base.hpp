// Decks that say what differs from another one, their base: `base: deck.yaml`, a deck of the same folder, so that files
// which either names are the same for both. Maps of the deck go over those of the base key by key; values and lists
// replace them. A base has no base of its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "io/deck_node.hpp"

namespace lampblack::io {

inline constexpr const char* baseKey = "base";

// Reads a deck's file, and that of the base that it names. InputError where one cannot be read, is no YAML, or names
// another folder.
DeckSource readDeck(const std::filesystem::path& path, const std::vector<std::string>& overrides);

// The tree of a deck over that of its base, without the key; overrides are not applied. InputError as parseDeck.
DeckNode parseOnBase(const DeckSource& source);

}  // namespace lampblack::io
