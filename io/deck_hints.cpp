#include "io/deck_hints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <system_error>
#include <utility>

#include "core/errors.hpp"
#include "core/letter_case.hpp"
#include "io/deck_value.hpp"

namespace lampblack::io {

std::string byOtherName(std::string_view name, const std::vector<std::string>& here, const OtherNames& otherNames) {
  for (const auto& [other, known] : otherNames)
    if (sameInAnyCase(name, other) && (name.size() > 1 || name == other) &&
        std::ranges::find(here, known) != here.end())
      return fmt::format("; did you mean '{}'?", known);
  return {};
}

std::string didYouMeanOneOf(const std::vector<std::string>& names) {
  if (names.empty()) return {};
  std::string text = "; did you mean ";
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format("{}'{}'", i == 0 ? "" : i + 1 == names.size() ? " or " : ", ", names[i]);
  return text + "?";
}

std::string asQuotedText(const DeckNode& map) {
  const bool isComposition =
      map.kind == DeckNode::Kind::map && !map.children.empty() &&
      std::ranges::all_of(map.children, [](const auto& child) {
        double value = 0;
        const char* const end = child.text.data() + child.text.size();
        return child.kind == DeckNode::Kind::scalar &&
               std::from_chars(child.text.data(), end, value) == std::from_chars_result{end, std::errc{}};
      });
  if (!isComposition) return {};
  std::string text;
  for (const DeckNode& child : map.children)
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", child.name, child.text);
  return fmt::format("; write it in quotes, \"{}\"", shortened(text));
}

namespace {

// "pressure 1 atm" or "pressure:1 atm", and nothing that may stand without a key.
bool lacksColon(std::string_view line) {
  const std::size_t text = line.find_first_not_of(' ');
  if (text == std::string_view::npos || std::isalpha(static_cast<unsigned char>(line[text])) == 0) return false;
  return !line.ends_with(':') && line.find(": ") == std::string_view::npos &&
         line.find_first_of("{}[],#\"") == std::string_view::npos &&
         line.find_first_of(" :", text) != std::string_view::npos;
}

std::size_t indentOf(std::string_view line) {
  return std::min(line.find_first_not_of(' '), line.size());
}

std::string_view withoutBlanksBehind(std::string_view line) {
  while (!line.empty() && (line.back() == ' ' || line.back() == '\r')) line.remove_suffix(1);
  return line;
}

// Of a text that began on the line before it: deeper than that, which is no section's.
bool goesOnAText(std::string_view line, std::string_view lineBefore) {
  return !lineBefore.empty() && !lineBefore.ends_with(':') && indentOf(line) > indentOf(lineBefore);
}

}  // namespace

std::string whyNotYaml(std::string_view line, std::string_view lineBefore, std::string_view lineBeforeThat) {
  const std::size_t text = line.find_first_not_of(" \t");
  if (line.substr(0, text).find('\t') != std::string_view::npos) return "; YAML indents by blanks, no tabulators";
  constexpr std::size_t none = std::string_view::npos;
  lineBefore = withoutBlanksBehind(lineBefore);
  if (lacksColon(lineBefore) && indentOf(lineBefore) <= indentOf(line) &&
      !goesOnAText(lineBefore, withoutBlanksBehind(lineBeforeThat)))
    return fmt::format("; a key ends with a colon and a blank, 'key: value', which the line before lacks: '{}'",
                       shortened(std::string(lineBefore.substr(lineBefore.find_first_not_of(' ')))));
  for (std::size_t colon = line.find(": "), next = none; colon != none; colon = next) {
    next = line.find(": ", colon + 1);
    // "key: a: b": a key and a value that is itself "a: b", with nothing that begins a map or a list between them.
    if (next != none && line.substr(colon, next - colon).find_first_of("{[,") == none)
      return "; a text with ': ' or a comma in it stands in quotes, \"H2: 2, O2: 1\"";
  }
  return {};
}

std::string asSection(const DeckSource& source, const DeckSchema::Node& section, const DeckNode& scalar) {
  if (scalar.kind != DeckNode::Kind::scalar || scalar.text.empty()) return {};
  for (const DeckSchema::Node& child : section.children) {
    // Numbers alone could be of any key.
    const bool tells =
        child.key != nullptr && !child.key->isList &&
        (child.key->type == KeyType::choice ||
         (child.key->type == KeyType::quantity && std::isdigit(static_cast<unsigned char>(scalar.text.back())) == 0));
    if (!tells) continue;
    try {
      static_cast<void>(readDeckValue(source, *child.key, child.path, scalar));
      return fmt::format(", such as {{{}: {}}}", child.name, scalar.text);
    } catch (const InputError&) {
      continue;  // another key, perhaps
    }
  }
  return {};
}

}  // namespace lampblack::io
