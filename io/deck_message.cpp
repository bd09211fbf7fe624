// Messages about decks: where, what, and the line itself with a caret under the place.
#include <fmt/format.h>

#include <algorithm>

#include "io/deck_node.hpp"

namespace lampblack {
namespace {

std::string lineOf(const std::string& text, int line) {
  std::size_t start = 0;
  for (int i = 1; i < line; ++i) {
    const std::size_t end = text.find('\n', start);
    if (end == std::string::npos) return {};
    start = end + 1;
  }
  std::string found = text.substr(start, text.find('\n', start) - start);
  if (!found.empty() && found.back() == '\r') found.pop_back();
  return found;
}

bool continuesCharacter(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

// The excerpt: the line under its number, and below it a caret and tildes. Tabs are kept so that the caret stays in
// place; the bytes inside a UTF-8 character take no room.
std::string excerpt(const std::string& line, const std::string& label, int column, int length) {
  const auto first = std::min(static_cast<std::size_t>(std::max(column - 1, 0)), line.size());
  const auto last = std::min(first + static_cast<std::size_t>(std::max(length, 1)), line.size());
  std::string marks;
  for (std::size_t i = 0; i < first; ++i) {
    if (!continuesCharacter(line[i])) marks += line[i] == '\t' ? '\t' : ' ';
  }
  marks += '^';
  for (std::size_t i = first + 1; i < last; ++i) {
    if (!continuesCharacter(line[i])) marks += '~';
  }
  return fmt::format("\n{:>6} | {}\n{:>6} | {}", label, line, "", marks);
}

}  // namespace

std::string foundText(const DeckNode& node) {
  switch (node.kind) {
    case DeckNode::Kind::null:
      return "nothing";
    case DeckNode::Kind::scalar:
      return fmt::format("'{}'", node.text.size() > 60 ? node.text.substr(0, 57) + "..." : node.text);
    case DeckNode::Kind::list:
      return fmt::format("a list of {}", node.children.size());
    case DeckNode::Kind::map:
      return "a map";
  }
  return "something else";
}

InputError deckError(const DeckSource& source, const DeckLocation& at, const std::string& key,
                     const std::string& message) {
  const std::string what = key.empty() ? message : fmt::format("{}: {}", key, message);
  if (at.overrideIndex >= 0) {
    const std::string& text = source.overrides.at(static_cast<std::size_t>(at.overrideIndex));
    if (at.line > 1 || text.find('\n') != std::string::npos) return InputError(fmt::format("--set {}: {}", text, what));
    return InputError(fmt::format("--set {}: {}{}", text, what, excerpt(text, "--set", at.column, at.length)));
  }
  if (at.line == 0) return InputError(fmt::format("{}: {}", source.path.string(), what));
  return InputError(fmt::format("{}:{}:{}: {}{}", source.path.string(), at.line, at.column, what,
                                excerpt(lineOf(source.text, at.line), std::to_string(at.line), at.column, at.length)));
}

}  // namespace lampblack
