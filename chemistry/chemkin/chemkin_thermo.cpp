#include "chemistry/chemkin/chemkin_thermo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <unordered_set>
#include <utility>

#include "core/errors.hpp"

namespace lampblack::chemistry {

namespace {

// A tabulator reaches to the next of every eight columns, as terminals and editors show it.
std::string withWideTabs(std::string_view line) {
  std::string result;
  for (const char c : line) {
    if (c == '\t')
      result.append(8 - result.size() % 8, ' ');
    else
      result += c;
  }
  return result;
}

// Blank, or a zero that stands for no atoms.
bool isNothing(std::string_view field) {
  return field.empty() || field == "." || fortranNumber(field) == 0.0;
}

bool isSymbol(std::string_view word) {
  return (word.size() == 1 || word.size() == 2) &&
         std::ranges::all_of(word, [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; });
}

// The digit in column 80, or 0.
int cardNumber(std::string_view line) {
  const auto mark = chemkinColumns(line, 80, 1);
  return !mark.empty() && mark[0] >= '1' && mark[0] <= '4' ? mark[0] - '0' : 0;
}

class ThermoReader {
 public:
  ThermoReader(const ChemkinSource& source, std::span<const ChemkinLine> section,
               const std::function<bool(std::string_view)>& wanted)
      : source_(source), wanted_(wanted) {
    for (const auto& line : section) {
      const bool hasTab = line.text.find('\t') != std::string::npos;
      wide_.push_back(hasTab ? withWideTabs(line.text) : std::string());
      lines_.push_back(line);
      std::ranges::replace(lines_.back().text, '\t', ' ');
    }
  }

  void read(ChemkinThermoTable& table, std::vector<std::string>& warnings) {
    std::unordered_set<std::string> known, here;
    for (const auto& [name, data] : table) known.insert(name);
    readDefaults();
    while (next_ < lines_.size()) {
      name_ = speciesName(lines_[next_].text);
      first_ = next_;
      const bool use = wanted_(name_) && !known.contains(name_);
      if (use && !here.insert(name_).second) {
        warnings.push_back(fmt::format("{}: species '{}' has thermodynamic data already at {}; the first holds",
                                       source_.place(lines_[next_].number), name_, table.at(name_).place));
        skipContinuations();
      } else if (use) {
        table[name_] = readSpecies(warnings);
      } else {
        // Coefficients name no species either: lines that are not wanted are passed over one by one.
        skipContinuations();
      }
    }
  }

 private:
  [[noreturn]] void fail(std::size_t line, std::string_view message) const {
    source_.fail(lines_[line].number, fmt::format("thermodynamic data of '{}': {}", name_, message));
  }

  void readDefaults() {
    if (lines_.empty()) return;
    const auto words = chemkinWords(lines_[0].text);
    std::array<double, 3> T{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = i < words.size() ? fortranNumber(words[i]) : std::nullopt;
      if (!value) return;
      T[i] = *value;
    }
    defaults_ = T;
    ++next_;
  }

  // The name ends at a blank or, where the date follows at once, with column 18.
  std::string speciesName(std::string_view card) const {
    const auto words = chemkinWords(card);
    const std::string whole(words[0]);
    if (whole.size() <= 18 || card.front() == ' ' || wanted_(whole)) return whole;
    return std::string(trimmed(chemkinColumns(card, 1, 18)));
  }

  // Past card 1 and the lines it announces with '&' at its end; returns these lines joined.
  std::string skipContinuations() {
    std::string elements;
    while (lines_[next_].text.back() == '&' && next_ + 1 < lines_.size()) {
      std::string_view line = lines_[++next_].text;
      if (line.back() == '&') line.remove_suffix(1);
      elements += fmt::format(" {}", line);
    }
    ++next_;
    return elements;
  }

  // `read` looks at this line: with tabulators of one column, or else to the next of every eight.
  void eitherWay(std::size_t line, std::vector<std::string>& warnings, const std::function<void()>& read) {
    if (wide_[line].empty()) return read();
    std::string_view meaning = "one column";
    try {
      read();
    } catch (const InputError&) {
      std::swap(lines_[line].text, wide_[line]);
      meaning = "reaching to the next of every eight columns";
      read();
    }
    warnings.push_back(fmt::format("{}: thermodynamic data of '{}': a tabulator is taken as {}",
                                   source_.place(lines_[line].number), name_, meaning));
  }

  ChemkinThermo readSpecies(std::vector<std::string>& warnings) {
    ChemkinThermo result;
    std::array<double, 3> temperatures{};
    const auto more = skipContinuations();
    eitherWay(first_, warnings, [&] {
      result = {};
      result.place = source_.place(lines_[first_].number);
      readFixedElements(result, warnings);
      readElementsBehind(result);
      readFreeElements(more, result);
      if (result.atoms.empty()) fail(first_, "expected elements with their numbers of atoms in columns 25 to 44");
      temperatures = readTemperatures();
    });
    std::array<std::optional<double>, 14> a;
    const std::array<std::size_t, 3> counts{5, 5, 4};
    std::size_t at = 0;
    for (std::size_t card = 0; card < 3; ++card) {
      const int expected = static_cast<int>(card) + 2;
      if (next_ == lines_.size()) fail(next_ - 1, fmt::format("expected card {} after this line", expected));
      eitherWay(next_, warnings, [&] {
        const int found = cardNumber(lines_[next_].text);
        if (found != 0 && found != expected)
          fail(next_, fmt::format("expected card {}, found a {} in column 80", expected, found));
        readCoefficients(std::span(a).subspan(at, counts[card]));
      });
      at += counts[card];
      ++next_;
    }
    result.thermo = assemble(temperatures, a, warnings);
    return result;
  }

  void addAtoms(ChemkinThermo& result, std::string_view symbol, std::string_view count) const {
    const auto value = fortranNumber(count);
    if (!value) fail(first_, fmt::format("expected the number of atoms of '{}', found '{}'", symbol, trimmed(count)));
    if (*value == 0) return;
    const auto name = upperCase(symbol);
    for (const auto& [known, amount] : result.atoms) {
      if (known != name) continue;
      if (amount != *value) fail(first_, fmt::format("element '{}' has two numbers of atoms", symbol));
      return;
    }
    result.atoms.emplace_back(name, *value);
  }

  // "G" or "0G" where a fourth element would be: the phase, one column or more to the left of its own.
  static bool isPhase(std::string_view count) {
    return !count.empty() && std::isalpha(static_cast<unsigned char>(count.back())) != 0 &&
           isNothing(trimmed(count.substr(0, count.size() - 1)));
  }

  void readFixedElements(ChemkinThermo& result, std::vector<std::string>& warnings) const {
    const std::string_view card = lines_[first_].text;
    for (const std::size_t column : {25, 30, 35, 40, 74}) {
      const auto symbol = trimmed(chemkinColumns(card, column, 2)),
                 count = trimmed(chemkinColumns(card, column + 2, 3));
      // Columns 74-78 also hold the tail of a long temperature.
      if (column == 74 && (!isSymbol(symbol) || count.empty())) continue;
      if (isNothing(symbol) && isNothing(count)) continue;
      if (column == 40 && isNothing(symbol) && isPhase(count)) {
        warnings.push_back(
            fmt::format("{}: thermodynamic data of '{}': the letter '{}' in the columns of a fourth "
                        "element is taken as the phase, which belongs in column 45",
                        source_.place(lines_[first_].number), name_, count.back()));
        continue;
      }
      if (!isSymbol(symbol))
        fail(first_,
             fmt::format("expected the symbol of an element in columns {} and {}, found '{}', and the number of "
                         "its atoms in at most three digits in columns {} to {}, found '{}'; larger numbers "
                         "need a line announced by '&'",
                         column, column + 1, symbol, column + 2, column + 4, count));
      addAtoms(result, symbol, count);
    }
  }

  // Behind column 80: "C  112H   80", pairs to the end of the line. Anything else there is a note.
  void readElementsBehind(ChemkinThermo& result) const {
    auto rest = trimmed(chemkinColumns(lines_[first_].text, 81, std::string_view::npos));
    if (rest.ends_with('&')) rest = trimmed(rest.substr(0, rest.size() - 1));
    std::vector<std::pair<std::string_view, std::string_view>> pairs;
    while (!rest.empty()) {
      const auto letters = std::min<std::size_t>(rest.find_first_of("-+.0123456789 "), rest.size());
      const auto symbol = rest.substr(0, letters);
      rest = trimmed(rest.substr(letters));
      const auto count = rest.substr(0, std::min(rest.find_first_not_of("-+.0123456789"), rest.size()));
      if (!isSymbol(symbol) || !fortranNumber(count)) return;
      pairs.emplace_back(symbol, count);
      rest = trimmed(rest.substr(count.size()));
    }
    for (const auto& [symbol, count] : pairs) addAtoms(result, symbol, count);
  }

  // "C 10 H 8"
  void readFreeElements(const std::string& text, ChemkinThermo& result) const {
    const auto words = chemkinWords(text);
    if (words.size() % 2 != 0) fail(first_, "expected pairs of an element and a number of atoms after '&'");
    for (std::size_t i = 0; i < words.size(); i += 2) {
      if (!isSymbol(words[i]))
        fail(first_, fmt::format("expected the symbol of an element after '&', found '{}'", words[i]));
      addAtoms(result, words[i], words[i + 1]);
    }
  }

  // Low, mid, high.
  std::array<double, 3> readTemperatures() const {
    const std::string_view card = lines_[first_].text;
    auto T = defaults_;
    const std::array<std::string_view, 3> fields{trimmed(chemkinColumns(card, 46, 10)),
                                                 trimmed(chemkinColumns(card, 66, 8)),
                                                 trimmed(chemkinColumns(card, 56, 10))};
    bool inColumns = true;
    for (std::size_t i = 0; i < 3; ++i) {
      if (fields[i].empty()) continue;
      const auto value = fortranNumber(fields[i]);
      inColumns = inColumns && value && fields[i].find(' ') == std::string_view::npos;
      if (value) T[i] = *value;
    }
    if (inColumns && T[0] >= 0 && T[0] < T[2]) return T;
    // Slipped: the numbers after the phase, in their order low, high, mid.
    auto words = chemkinWords(chemkinColumns(card, 45, 35));
    if (!words.empty() && words[0].size() == 1 && std::isalpha(static_cast<unsigned char>(words[0][0])) != 0)
      words.erase(words.begin());
    T = defaults_;
    const std::array<std::size_t, 3> order{0, 2, 1};
    std::size_t read = 0;
    for (; read < 3 && read < words.size(); ++read) {
      const auto value = fortranNumber(words[read]);
      if (!value) break;
      T[order[read]] = *value;
    }
    if (read < 2 || !(T[0] >= 0 && T[0] < T[2]))
      fail(first_,
           fmt::format("expected a low temperature in columns 46 to 55 and a higher one in 56 to 65, found '{}'",
                       trimmed(chemkinColumns(card, 45, 29))));
    return T;
  }

  void readCoefficients(std::span<std::optional<double>> a) const {
    const std::string_view line = lines_[next_].text;
    std::string_view wrong;
    std::size_t column = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const auto field = trimmed(chemkinColumns(line, 15 * i + 1, 15));
      if (field.empty()) continue;
      a[i] = fortranNumber(field);
      // The last of five ends with its column, or it has slipped.
      const bool goesOn = i == 4 && line.size() > 75 && line[74] != ' ' && line[75] != ' ';
      if ((a[i] && !goesOn) || !wrong.empty()) continue;
      wrong = field;
      column = 15 * i + 1;
    }
    if (wrong.empty()) return;
    // Slipped: as many words as there are coefficients, perhaps with the number of the card behind them.
    const auto words = chemkinWords(line);
    bool readable = words.size() >= a.size() && words.size() <= a.size() + 2;
    for (std::size_t i = 0; readable && i < a.size(); ++i) {
      a[i] = fortranNumber(words[i]);
      readable = a[i].has_value();
    }
    if (!readable)
      fail(next_, fmt::format("expected a number in columns {} to {}, found '{}'", column, column + 14, wrong));
  }

  Nasa7 assemble(const std::array<double, 3>& T, const std::array<std::optional<double>, 14>& a,
                 std::vector<std::string>& warnings) const {
    Nasa7 result;
    result.minTemperature = T[0];
    result.midTemperature = T[1];
    result.maxTemperature = T[2];
    for (std::size_t i = 0; i < 7; ++i) {
      result.high[i] = a[i].value_or(0.0);
      result.low[i] = a[i + 7].value_or(0.0);
    }
    const auto absent = [](std::span<const std::optional<double>> range) {
      return std::ranges::all_of(range, [](const auto& value) { return value.value_or(0.0) == 0; });
    };
    const bool noHigh = absent(std::span(a).first(7)), noLow = absent(std::span(a).last(7));
    if (noHigh && noLow) fail(first_, "all coefficients are zero or blank");
    // One range only: the coefficients of the other are missing, or the middle temperature is an end.
    const bool sameRanges = result.low == result.high;
    if (noLow)
      result.low = result.high;
    else if (noHigh || T[1] >= T[2])
      result.high = result.low;
    else if (T[1] <= T[0])
      result.low = result.high;
    else
      return result;
    if (!sameRanges)
      warnings.push_back(fmt::format("{}: species '{}' has one range of temperature, which is taken from {} to {} K",
                                     source_.place(lines_[first_].number), name_, T[0], T[2]));
    result.midTemperature = T[2];
    return result;
  }

  const ChemkinSource& source_;
  const std::function<bool(std::string_view)>& wanted_;
  std::vector<ChemkinLine> lines_;  // a tabulator as one blank
  std::vector<std::string> wide_;   // the same with tabulators to the next of every eight columns; empty without one
  std::array<double, 3> defaults_{300, 1000, 5000};
  std::size_t next_ = 0;   // the line to read
  std::size_t first_ = 0;  // card 1 of the species being read
  std::string name_;
};

}  // namespace

void readChemkinThermo(const ChemkinSource& source, std::span<const ChemkinLine> section,
                       const std::function<bool(std::string_view)>& wanted, ChemkinThermoTable& table,
                       std::vector<std::string>& warnings) {
  ThermoReader(source, section, wanted).read(table, warnings);
}

}  // namespace lampblack::chemistry
