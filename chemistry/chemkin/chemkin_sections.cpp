#include "chemistry/chemkin/chemkin_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "chemistry/chemkin/chemkin_keywords.hpp"
#include "core/nearest_name.hpp"

namespace lampblack::chemistry {

namespace {

using Kind = ChemkinSection::Kind;

// CHEMKIN goes by the first four letters; here any beginning of the word from four letters on: "ELEM", "SPECIE".
std::optional<Kind> sectionKind(std::string_view word) {
  if (word.size() < 4) return std::nullopt;
  const auto upper = upperCase(word);
  using Heading = std::pair<std::string_view, Kind>;
  for (const auto& [heading, kind] :
       {Heading("ELEMENTS", Kind::Elements), Heading("SPECIES", Kind::Species), Heading("THERMO", Kind::Thermo),
        Heading("REACTIONS", Kind::Reactions), Heading("TRANSPORT", Kind::Transport)})
    if (heading.starts_with(upper)) return kind;
  return std::nullopt;
}

bool isEnd(std::string_view word) {
  return upperCase(word) == "END";
}

std::string joined(std::span<const std::string_view> words) {
  std::string text;
  for (const auto word : words) text += fmt::format("{}{}", text.empty() ? "" : " ", word);
  return text;
}

bool isList(Kind kind) {
  return kind == Kind::Elements || kind == Kind::Species;
}

class SectionSplitter {
 public:
  SectionSplitter(const ChemkinSource& source, const Kind* implied, std::vector<std::string>& warnings)
      : source_(source), implied_(implied), warnings_(warnings) {}

  std::vector<ChemkinSection> split() {
    for (const auto& line : source_.lines()) takeLine(line);
    return std::move(sections_);
  }

 private:
  void takeLine(const ChemkinLine& line) {
    auto words = chemkinWords(line.text);
    const auto kind = sectionKind(words[0]);
    if (kind && (open_ || !dataEnded_ || isHeadingAlone(*kind, words))) {
      sections_.push_back({*kind, {}, {}, line.number});
      open_ = true;
      words.erase(words.begin());
      if (isList(*kind))
        takeList(words, line.number);
      else
        sections_.back().options.assign(words.begin(), words.end());
      return;
    }
    const bool ends = isEnd(words[0]);
    if (!open_ && !ended_ && implied_ != nullptr) {
      sections_.push_back({*implied_, {}, {}, line.number});
      open_ = true;
    }
    if (!open_) {
      if (!ends) takeStray(line, words[0]);
    } else if (isList(sections_.back().kind)) {
      takeList(words, line.number);
    } else if (ends) {
      close();
    } else {
      sections_.back().lines.push_back(line);
    }
  }

  // Behind the END of REACTIONS or of a file of data a line such as "Species named by ..." is text.
  static bool isHeadingAlone(Kind kind, std::span<const std::string_view> words) {
    return std::ranges::all_of(words.subspan(1), [kind](std::string_view word) {
      if (kind == Kind::Reactions) return ChemkinUnits().set(word);
      const auto upper = upperCase(word);
      return !isList(kind) && (upper == "ALL" || (kind == Kind::Thermo && (upper == "NASA9" || upper == "NASA7")));
    });
  }

  // "H+O2=O+OH 1e14 0 1000"
  static bool isReaction(const ChemkinLine& line) {
    const auto words = chemkinWords(line.text);
    return words.size() > 3 && line.text.find('=') != std::string::npos &&
           std::all_of(words.end() - 3, words.end(), [](auto word) { return fortranNumber(word).has_value(); });
  }

  // Names up to END; what stands behind it in the same line is like a line of its own.
  void takeList(std::span<const std::string_view> words, int number) {
    const auto end = std::ranges::find_if(words, isEnd);
    if (const auto names = joined({words.begin(), end}); !names.empty())
      sections_.back().lines.push_back({names, number});
    if (end == words.end()) return;
    close();
    if (end + 1 != words.end()) takeLine({joined({end + 1, words.end()}), number});
  }

  void takeStray(const ChemkinLine& line, std::string_view word) {
    const auto upper = upperCase(word);
    if (upper.starts_with("SITE") || upper.starts_with("BULK") || upper.starts_with("MATERIAL") ||
        upper.starts_with("SURFACE"))
      source_.fail(line.number, fmt::format("'{}': mechanisms of surfaces are not supported", word));
    if (!ended_)
      source_.fail(line.number,
                   fmt::format("expected ELEMENTS, SPECIES, THERMO, REACTIONS or TRANSPORT, found '{}'{}", word,
                               didYouMean(word, {"ELEMENTS", "SPECIES", "THERMO", "REACTIONS", "TRANSPORT"})));
    const bool reaction = isReaction(line);
    if (reaction && !dataEnded_)
      source_.fail(line.number, "a reaction behind END; expected it in the section REACTIONS");
    const auto keyword = didYouMean(word, {"ELEMENTS", "SPECIES", "THERMO", "REACTIONS", "TRANSPORT"});
    if (!keyword.empty() && trimmed(line.text) == word)
      source_.fail(line.number, fmt::format("'{}' begins no section{}", word, keyword));
    if (reaction)
      warnings_.push_back(
          fmt::format("{}: a reaction behind END is ignored: '{}'", source_.place(line.number), trimmed(line.text)));
    else if (!warned_)
      warnings_.push_back(fmt::format("{}: text behind END is ignored", source_.place(line.number)));
    warned_ = warned_ || !reaction;
  }

  void close() {
    open_ = false;
    ended_ = true;
    dataEnded_ = dataEnded_ || implied_ != nullptr || sections_.back().kind == Kind::Reactions;
  }

  const ChemkinSource& source_;
  const Kind* implied_;
  std::vector<std::string>& warnings_;
  std::vector<ChemkinSection> sections_;
  bool open_ = false, ended_ = false, warned_ = false;
  bool dataEnded_ = false;  // what the file is for: text may follow
};

}  // namespace

std::vector<ChemkinSection> splitChemkinSections(const ChemkinSource& source, const Kind* implied,
                                                 std::vector<std::string>& warnings) {
  return SectionSplitter(source, implied, warnings).split();
}

}  // namespace lampblack::chemistry
