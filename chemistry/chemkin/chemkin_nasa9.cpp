#include "chemistry/chemkin/chemkin_nasa9.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_set>
#include <utility>

namespace lampblack::chemistry {

namespace {

class Nasa9Reader {
 public:
  Nasa9Reader(const ChemkinSource& source, std::span<const ChemkinLine> section) : source_(source) {
    for (const auto& line : section) {
      lines_.push_back(line);
      std::ranges::replace(lines_.back().text, '\t', ' ');
    }
  }

  void read(const std::function<bool(std::string_view)>& wanted, ChemkinThermoTable& table,
            std::vector<std::string>& warnings) {
    std::unordered_set<std::string> known, here;
    for (const auto& [name, data] : table) known.insert(name);
    while (next_ < lines_.size()) {
      name_ = std::string(chemkinWords(lines_[next_].text)[0]);
      first_ = next_++;
      if (fortranNumber(name_)) continue;  // default temperatures, or a record that is not wanted and cannot be read
      const auto ranges = numberOfRanges();
      const bool use = wanted(name_) && !known.contains(name_);
      if (use && here.insert(name_).second) {
        if (!ranges) fail(first_, "expected the number of ranges of temperature in columns 1 and 2 of the next line");
        table[name_] = readRecord(*ranges);
        continue;
      }
      if (use)
        warnings.push_back(fmt::format("{}: species '{}' has thermodynamic data already at {}; the first holds",
                                       source_.place(lines_[first_].number), name_, table.at(name_).place));
      if (ranges) next_ = std::min(lines_.size(), next_ + 1 + 3 * *ranges);
    }
  }

 private:
  [[noreturn]] void fail(std::size_t line, std::string_view message) const {
    source_.fail(lines_[line].number, fmt::format("thermodynamic data of '{}': {}", name_, message));
  }

  std::optional<std::size_t> numberOfRanges() const {
    if (next_ == lines_.size()) return std::nullopt;
    const auto digits = trimmed(chemkinColumns(lines_[next_].text, 1, 2));
    if (digits.size() != 1 || digits[0] < '1' || digits[0] > '9') return std::nullopt;
    return static_cast<std::size_t>(digits[0] - '0');
  }

  ChemkinThermo readRecord(std::size_t ranges) {
    ChemkinThermo result;
    result.place = source_.place(lines_[first_].number);
    readElements(result);
    ++next_;
    Nasa9 data;
    for (std::size_t i = 0; i < ranges; ++i, next_ += 3) {
      if (next_ + 3 > lines_.size())
        fail(lines_.size() - 1, fmt::format("expected three lines for each of {} ranges of temperature", ranges));
      readRange(data);
    }
    // The range of temperature is asked of these (species.hpp).
    result.thermo.minTemperature = data.temperatures.front();
    result.thermo.midTemperature = data.temperatures[1];
    result.thermo.maxTemperature = data.temperatures.back();
    result.nasa9 = std::move(data);
    return result;
  }

  void readElements(ChemkinThermo& result) const {
    for (std::size_t column = 11; column < 51; column += 8) {
      const auto symbol = trimmed(chemkinColumns(lines_[next_].text, column, 2));
      const auto count = trimmed(chemkinColumns(lines_[next_].text, column + 2, 6));
      if (symbol.empty() && (count.empty() || fortranNumber(count) == 0.0)) continue;
      const auto atoms = fortranNumber(count);
      if (symbol.empty() || !std::ranges::all_of(symbol, isLetter) || !atoms)
        fail(next_, fmt::format("expected the symbol of an element in columns {} and {}, found '{}', and the number of "
                                "its atoms in columns {} to {}, found '{}'",
                                column, column + 1, symbol, column + 2, column + 7, count));
      if (*atoms != 0) result.atoms.emplace_back(upperCase(symbol), *atoms);
    }
    if (result.atoms.empty()) fail(next_, "expected elements with their numbers of atoms in columns 11 to 50");
  }

  static bool isLetter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

  double number(std::size_t line, std::size_t column, std::size_t width) const {
    const auto field = trimmed(chemkinColumns(lines_[line].text, column, width));
    if (field.empty()) return 0;
    const auto value = fortranNumber(field);
    if (!value)
      fail(line, fmt::format("expected a number in columns {} to {}, found '{}'", column, column + width - 1, field));
    return *value;
  }

  void readRange(Nasa9& data) const {
    const double low = number(next_, 1, 11), high = number(next_, 12, 11);
    if (!(low >= 0 && low < high))
      fail(next_,
           fmt::format("expected rising temperatures in columns 1 to 11 and 12 to 22, found {} and {}", low, high));
    if (data.temperatures.empty())
      data.temperatures.push_back(low);
    else if (low != data.temperatures.back())
      fail(next_, fmt::format("expected a range from {} K on, where the one before ends, found {} K",
                              data.temperatures.back(), low));
    data.temperatures.push_back(high);
    for (std::size_t i = 0; i < 7; ++i)
      if (number(next_, 24 + 5 * i, 5) != static_cast<double>(i) - 2)
        fail(next_,
             "expected seven powers of the temperature, -2.0 to 4.0, in columns 24 to 58; others are not "
             "supported");
    std::array<double, 9> a{};
    for (std::size_t i = 0; i < 5; ++i) a[i] = number(next_ + 1, 1 + 16 * i, 16);
    const std::array<std::size_t, 4> second{1, 17, 49, 65};
    for (std::size_t i = 0; i < second.size(); ++i) a[5 + i] = number(next_ + 2, second[i], 16);
    data.ranges.push_back(a);
  }

  const ChemkinSource& source_;
  std::vector<ChemkinLine> lines_;
  std::size_t next_ = 0;   // the line to read
  std::size_t first_ = 0;  // of the record
  std::string name_;
};

}  // namespace

void readChemkinNasa9(const ChemkinSource& source, std::span<const ChemkinLine> section,
                      const std::function<bool(std::string_view)>& wanted, ChemkinThermoTable& table,
                      std::vector<std::string>& warnings) {
  Nasa9Reader(source, section).read(wanted, table, warnings);
}

}  // namespace lampblack::chemistry
