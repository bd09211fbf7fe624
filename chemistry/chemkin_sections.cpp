#include "chemistry/chemkin_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/nearest_name.hpp"

namespace lampblack {

namespace {

using Kind = ChemkinSection::Kind;

std::optional<Kind> sectionKind(std::string_view word) {
  const auto upper = upperCase(word);
  if (upper == "ELEMENTS" || upper == "ELEMENT" || upper == "ELEM") return Kind::Elements;
  if (upper == "SPECIES" || upper == "SPEC") return Kind::Species;
  if (upper == "THERMO" || upper == "THERM" || upper == "THER") return Kind::Thermo;
  if (upper == "REACTIONS" || upper == "REACTION" || upper == "REAC") return Kind::Reactions;
  if (upper == "TRANSPORT" || upper == "TRANS" || upper == "TRAN") return Kind::Transport;
  return std::nullopt;
}

bool isList(Kind kind) {
  return kind == Kind::Elements || kind == Kind::Species;
}

}  // namespace

std::vector<ChemkinSection> splitChemkinSections(const ChemkinSource& source, const Kind* implied,
                                                 std::vector<std::string>& warnings) {
  std::vector<ChemkinSection> sections;
  bool open = false, ended = false, warned = false;
  for (const auto& line : source.lines()) {
    auto words = chemkinWords(line.text);
    const auto kind = sectionKind(words[0]);
    if (kind) {
      sections.push_back({*kind, {}, {}, line.number});
      open = true;
      if (!isList(*kind)) {
        sections.back().options.assign(words.begin() + 1, words.end());
        continue;
      }
      words.erase(words.begin());
    } else if (const auto first = upperCase(words[0]);
               first == "SITE" || first == "BULK" || first == "MATERIAL" || first == "SURFACE") {
      source.fail(line.number, fmt::format("'{}': mechanisms of surfaces are not supported", words[0]));
    }
    if (!open && !ended && implied != nullptr) {
      sections.push_back({*implied, {}, {}, line.number});
      open = true;
    }
    const bool list = open && isList(sections.back().kind);
    const auto end = std::ranges::find_if(words.begin(), list ? words.end() : words.begin() + 1,
                                          [](auto word) { return upperCase(word) == "END"; });
    const bool ends = !words.empty() && end != (list ? words.end() : words.begin() + 1);
    if (!open) {
      if (ends) continue;
      if (!ended)
        source.fail(line.number,
                    fmt::format("expected ELEMENTS, SPECIES, THERMO, REACTIONS or TRANSPORT, found '{}'{}", words[0],
                                didYouMean(words[0], {"ELEMENTS", "SPECIES", "THERMO", "REACTIONS", "TRANSPORT"})));
      if (line.text.find('=') != std::string::npos)
        source.fail(line.number, "a reaction behind END; expected it in the section REACTIONS");
      if (!warned) warnings.push_back(fmt::format("{}: text behind END is ignored", source.place(line.number)));
      warned = true;
      continue;
    }
    if (list) {
      std::string text;
      for (auto word = words.begin(); word != end; ++word) text += fmt::format("{} ", *word);
      if (!text.empty()) sections.back().lines.push_back({text, line.number});
    } else if (!ends) {
      sections.back().lines.push_back(line);
    }
    if (ends) {
      open = false;
      ended = true;
    }
  }
  return sections;
}

}  // namespace lampblack
