// Messages about decks: where, what, and the line itself with a caret under the place.
#include <fmt/format.h>

#include <algorithm>

#include "io/deck_node.hpp"

namespace lampblack::io {

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

namespace {

bool continuesCharacter(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

// Control characters would move the cursor of the console; tabs may.
std::string printable(std::string text) {
  for (char& c : text)
    if ((static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7f) c = '?';
  return text;
}

// The part of a line that is shown, and where what is marked begins in it.
struct Shown {
  std::string text;
  std::size_t first;
};

// A line that is longer than a console is cut on both sides of the place that matters, never inside a UTF-8 character.
Shown aroundPlace(const std::string& line, std::size_t first) {
  constexpr std::size_t longest = 160, before = 60;
  const std::string dots = "...";
  if (line.size() <= longest) return {line, first};
  std::size_t begin = first > before ? first - before : 0;
  std::size_t end = std::min(begin + longest, line.size());
  while (begin > 0 && continuesCharacter(line[begin])) --begin;
  while (end < line.size() && continuesCharacter(line[end])) ++end;
  const std::string front = begin > 0 ? dots : "";
  return {front + line.substr(begin, end - begin) + (end < line.size() ? dots : ""), front.size() + first - begin};
}

// The excerpt: the line under its number, and below it a caret and tildes. Tabs are kept so that the caret stays in
// place; the bytes inside a UTF-8 character take no room.
std::string excerpt(const std::string& whole, const std::string& label, int column, int length) {
  const auto place = std::min(static_cast<std::size_t>(std::max(column - 1, 0)), whole.size());
  const auto& [line, first] = aroundPlace(printable(whole), place);
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

const DeckFile& fileOf(const DeckSource& source, const DeckLocation& at) {
  return at.isInBase ? source.base.value() : source.file;
}

}  // namespace

std::string shortened(const std::string& text) {
  constexpr std::size_t longest = 60;
  if (text.size() <= longest) return printable(text);
  std::size_t end = longest - 3;
  while (continuesCharacter(text[end])) --end;
  return printable(text.substr(0, end)) + "...";
}

std::string foundText(const DeckNode& node) {
  switch (node.kind) {
    case DeckNode::Kind::null:
      return "nothing";
    case DeckNode::Kind::scalar:
      return fmt::format("'{}'", shortened(node.text));
    case DeckNode::Kind::list:
      return fmt::format("a list of {}", node.children.size());
    case DeckNode::Kind::map:
      return "a map";
  }
  return "something else";
}

InputError deckError(const DeckSource& source, const DeckLocation& at, const std::string& key,
                     const std::string& message) {
  const std::string what = key.empty() ? message : fmt::format("{}: {}", shortened(key), message);
  if (at.overrideIndex >= 0) {
    const std::string& text = source.overrides.at(static_cast<std::size_t>(at.overrideIndex));
    const std::string place = fmt::format("--set {}: {}", shortened(text), what);
    if (at.line > 1 || text.find('\n') != std::string::npos) return InputError(place);
    return InputError(place + excerpt(text, "--set", at.column, at.length));
  }
  const DeckFile& file = fileOf(source, at);
  if (at.line == 0) return InputError(fmt::format("{}: {}", file.path.string(), what));
  return InputError(fmt::format("{}:{}:{}: {}{}", file.path.string(), at.line, at.column, what,
                                excerpt(lineOf(file.text, at.line), std::to_string(at.line), at.column, at.length)));
}

std::string deckPlace(const DeckSource& source, const DeckLocation& at) {
  if (at.overrideIndex >= 0) {
    const std::string& text = source.overrides.at(static_cast<std::size_t>(at.overrideIndex));
    return fmt::format("--set {}", shortened(text.substr(0, text.find('='))));
  }
  const std::string file = fileOf(source, at).path.string();
  return at.line == 0 ? file : fmt::format("{}:{}", file, at.line);
}

}  // namespace lampblack::io
