// Sections that former versions had (DeckSchema::formerly): a deck with one is read as if its keys stood where they
// stand now.
#pragma once

#include <string>
#include <vector>

#include "core/modules.hpp"
#include "io/deck_node.hpp"
#include "io/deck_schema.hpp"

namespace lampblack::io {

// Moves the keys of former sections in the tree of a deck to where they stand now. Returns a note for each section.
// Where a key is there by two names, of which one comes from --set, the later assignment holds. InputError where the
// deck itself, or one --set, gives it by both.
std::vector<std::string> moveFormerSections(const DeckSource& source, const FormerSections& former, DeckNode& root);

// What the note of a name says after what it is now: since when, and until when the former one is read.
std::string formerNote(const DeckSource& source, const DeckLocation& at, const std::string& what,
                       const std::string& now);

}  // namespace lampblack::io
