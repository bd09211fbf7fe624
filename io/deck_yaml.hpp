// The YAML text of a deck as a tree: of the sources of io alone.
#pragma once

#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>

#include <cstddef>
#include <string>

#include "core/modules.hpp"
#include "io/deck_node.hpp"

namespace lampblack::io {

// Found while YAML events arrive; turned into an InputError where the source is known.
struct StructureError {
  YAML::Mark mark;
  std::string key;
  std::string message;
};

// Of a piece of the text, so many characters long.
[[nodiscard]] DeckLocation locationOf(const YAML::Mark& mark, std::size_t length = 1);

// Throws YAML::Exception where the text is not YAML, StructureError where it is not a deck.
[[nodiscard]] DeckNode parseYaml(const std::string& text);

// What a text that is not YAML is told.
[[nodiscard]] StructureError fromYaml(const YAML::Exception& error);

}  // namespace lampblack::io
