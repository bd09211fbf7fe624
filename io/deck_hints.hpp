// What is said to who writes a deck as other programs, or YAML, suggest.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/modules.hpp"
#include "io/deck_node.hpp"
#include "io/deck_schema.hpp"

namespace lampblack::io {

// "; did you mean 'stirred'?" of "psr": the key or choice here that the schema says is called so elsewhere, where the
// nearest name would be another one. Empty where there is none.
std::string byOtherName(std::string_view name, const std::vector<std::string>& here, const OtherNames& otherNames);

// "; did you mean 'a', 'b' or 'c'?" of one to three names.
std::string didYouMeanOneOf(const std::vector<std::string>& names);

// Of a map that stands in place of a text: how to write it, where it is a composition (numbers alone) without its
// quotes.
std::string asQuotedText(const DeckNode& map);

// Of a text that is not YAML, the line of the mistake and the two before it: what to write where a tabulator, an
// unquoted text or a missing colon is the cause.
std::string whyNotYaml(std::string_view line, std::string_view lineBefore, std::string_view lineBeforeThat);

// Where a scalar stands in place of a section: ", such as {end: 1 ms}", the first key that can have it.
std::string asSection(const DeckSource& source, const DeckSchema::Node& section, const DeckNode& scalar);

}  // namespace lampblack::io
