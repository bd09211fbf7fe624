// The deck as written: a tree of maps, lists and scalars that remembers where each part stands, so that any later
// complaint can point at it. Made from YAML events rather than from a finished document because those still show
// repeated keys. Anchors and aliases are refused: a deck says what it means where it means it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/errors.hpp"
#include "core/modules.hpp"

namespace lampblack::io {

struct DeckFile {
  std::filesystem::path path;
  std::string text;
};

// The texts that messages quote from.
struct DeckSource {
  DeckFile file;
  std::optional<DeckFile> base;        // that the deck goes on from (io/deck_base.hpp)
  std::vector<std::string> overrides;  // "a.b=c"
};

// Where something stands: in a file (1-based line and column in bytes) or in an override.
struct DeckLocation {
  int overrideIndex = -1;  // -1: in a file
  int line = 0;            // 0: nowhere, for instance a default
  int column = 0;
  int length = 1;         // bytes to underline
  bool isInBase = false;  // the file is that of the deck's base
};

struct DeckNode {
  enum class Kind { null, scalar, list, map };

  Kind kind = Kind::null;
  std::string name;  // key in the enclosing map; empty in a list
  DeckLocation nameAt;
  DeckLocation at;
  std::string text;     // scalar; of a map that an override gives without braces: as it was written
  bool quoted = false;  // scalar in quotes: never null
  std::vector<DeckNode> children;

  [[nodiscard]] const DeckNode* child(std::string_view childName) const;
  [[nodiscard]] DeckNode* child(std::string_view childName);
};

// A text of a deck as messages quote it: its first 60 bytes at most.
std::string shortened(const std::string& text);

// A line of a text, from 1; empty behind its end.
std::string lineOf(const std::string& text, int line);

// "map", "list of 3", "'20 cm'" or "nothing": what was found, for messages.
std::string foundText(const DeckNode& node);

// An InputError "file:line:column: key: message" (or "--set a.b=c: ...") with the line and a caret under the place.
InputError deckError(const DeckSource& source, const DeckLocation& at, const std::string& key,
                     const std::string& message);

// The same place in a few words, for notes of one line: "file:line", "--set a.b" or the file.
std::string deckPlace(const DeckSource& source, const DeckLocation& at);

// Reads a file's text, a map at the top. InputError for bad YAML, repeated keys, aliases, several
// documents.
DeckNode parseDeck(const DeckFile& file);

// Applies source.overrides[i] to the tree. Parts of maps that are missing are made; a list takes an index up to its
// length. What a shell has left of a text with colons, "H2: 2, O2: 1", is taken as that text.
void applyOverride(DeckNode& root, const DeckSource& source, std::size_t i);

// "mesh.z[0].cells" or "mesh.z.0.cells" into {"mesh", "z", "0", "cells"}.
std::vector<std::string> splitDeckPath(std::string_view path);

}  // namespace lampblack::io
