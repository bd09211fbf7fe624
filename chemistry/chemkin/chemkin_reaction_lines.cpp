#include "chemistry/chemkin/chemkin_reaction_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "chemistry/chemkin/chemkin_keywords.hpp"

namespace lampblack::chemistry {

namespace {

std::string_view keyBefore(std::string_view text, std::size_t slash) {
  return trimmed(text.substr(0, slash));
}

class ReactionLines {
 public:
  ReactionLines(const ChemkinSource& source, const ChemkinEquationParser& species, std::vector<std::string>& warnings)
      : source_(source), species_(species), warnings_(warnings) {}

  std::vector<ChemkinReactionEntry> split(std::span<const ChemkinLine> section) {
    for (std::size_t i = 0; i < section.size(); ++i) {
      ChemkinLine line = section[i];
      while (line.text.ends_with('&')) {
        line.text.pop_back();
        if (i + 1 == section.size()) source_.fail(line.number, "expected a line after '&'");
        line.text += section[++i].text;
      }
      if (startsReaction(line.text))
        entries_.push_back(readReaction(line));
      else
        readAuxiliaries(line);
    }
    return std::move(entries_);
  }

 private:
  bool startsReaction(std::string_view text) const {
    if (text.find('=') == std::string_view::npos) return false;
    const auto slash = text.find('/');
    if (slash == std::string_view::npos) return true;
    const auto key = keyBefore(text, slash);
    return !isChemkinKeyword(key) && !species_.find(key);
  }

  ChemkinReactionEntry readReaction(const ChemkinLine& line) const {
    ChemkinReactionEntry entry;
    entry.line = line.number;
    const auto words = chemkinWords(line.text);
    const std::size_t equationWords = words.size() < 3 ? 0 : words.size() - 3;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = equationWords == 0 ? std::nullopt : fortranNumber(words[equationWords + i]);
      if (!value)
        source_.fail(
            line.number,
            fmt::format("reaction '{}': expected three numbers A, b and Ea after the equation{}", trimmed(line.text),
                        equationWords == 0 ? std::string() : fmt::format(", found '{}'", words[equationWords + i])));
      entry.rate[i] = *value;
    }
    for (std::size_t i = 0; i < equationWords; ++i) entry.equation += words[i];
    return entry;
  }

  void readAuxiliaries(const ChemkinLine& line) {
    std::string_view rest = trimmed(line.text);
    while (!rest.empty()) {
      ChemkinAuxiliary item;
      item.line = line.number;
      const auto end = std::min(rest.find_first_of(" \t/"), rest.size());
      item.key = rest.substr(0, end);
      rest = trimmed(rest.substr(end));
      if (fortranNumber(item.key))
        source_.fail(line.number,
                     fmt::format("cannot read '{}': expected a keyword or a species before '/', found '{}'; is "
                                 "a '/' missing before it?",
                                 trimmed(line.text), item.key));
      if (item.key.empty()) source_.fail(line.number, "stray '/'; expected a keyword or a species before it");
      if (rest.starts_with('/')) {
        item.slashes = true;
        const auto close = std::min(rest.find('/', 1), rest.size());
        if (close == rest.size())
          warnings_.push_back(
              fmt::format("{}: the last '/' behind the values of '{}' is missing; they end with the line",
                          source_.place(line.number), item.key));
        // Names of species may hold commas.
        const auto key = upperCase(item.key);
        const std::string_view separators = key == "FORD" || key == "RORD" ? " \t" : " \t,";
        for (const auto word : chemkinWords(rest.substr(1, close - 1), separators)) item.values.emplace_back(word);
        rest = close == rest.size() ? std::string_view{} : trimmed(rest.substr(close + 1));
        if (key == "UNITS") rest = unitPerMole(rest, item);
      } else if (!isChemkinKeyword(item.key)) {
        explain(line, item.key);
      }
      if (entries_.empty())
        source_.fail(line.number, fmt::format("'{}' stands before the first reaction; expected an equation", item.key));
      entries_.back().auxiliaries.push_back(std::move(item));
    }
  }

  // "UNITS/KCAL/MOLE MOLES/": the slash inside the unit is not its end.
  static std::string_view unitPerMole(std::string_view rest, ChemkinAuxiliary& item) {
    const auto close = rest.find('/');
    if (close == std::string_view::npos) return rest;
    const auto words = chemkinWords(rest.substr(0, close), " \t,");
    if (words.empty() || !upperCase(words[0]).starts_with("MOL")) return rest;
    item.values.insert(item.values.end(), words.begin() + 1, words.end());
    return trimmed(rest.substr(close + 1));
  }

  [[noreturn]] void explain(const ChemkinLine& line, std::string_view key) const {
    for (const std::string_view arrow : {"->", "\xe2\x86\x92", "\xe2\x87\x8c", "\xe2\x87\x94"})
      if (line.text.find(arrow) != std::string::npos)
        source_.fail(line.number,
                     fmt::format("cannot read '{}'; expected '=>' (irreversible), '<=>' or '=' in place of "
                                 "'{}'",
                                 trimmed(line.text), arrow));
    source_.fail(
        line.number,
        fmt::format("cannot read '{}': '{}' is not a keyword{}; expected a reaction (with '='), a keyword, or an "
                    "efficiency such as H2O/6.0/",
                    trimmed(line.text), key, suggestChemkinKeyword(key)));
  }

  const ChemkinSource& source_;
  const ChemkinEquationParser& species_;
  std::vector<std::string>& warnings_;
  std::vector<ChemkinReactionEntry> entries_;
};

}  // namespace

std::vector<ChemkinReactionEntry> splitChemkinReactions(const ChemkinSource& source,
                                                        std::span<const ChemkinLine> section,
                                                        const ChemkinEquationParser& species,
                                                        std::vector<std::string>& warnings) {
  return ReactionLines(source, species, warnings).split(section);
}

}  // namespace lampblack::chemistry
