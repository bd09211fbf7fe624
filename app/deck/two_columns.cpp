#include "app/deck/two_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include "core/errors.hpp"
#include "core/text_file.hpp"
#include "io/csv.hpp"
#include "io/decimal_point.hpp"
#include "io/table_column.hpp"

namespace lampblack::app {
namespace {

std::string trimmed(const std::string& line) {
  return line.substr(0, line.find('\r'));
}

// The fields of a line, without the blanks and quotes around them: between commas or semicolons as in other tables, or
// between any blanks where there are neither.
std::vector<std::string> fieldsOf(const std::string& line, char found) {
  const char separator = found == '\t' ? ' ' : found;
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    const bool blank = c == ' ' || c == '\t' || c == '\r';
    if (c == '"')
      quoted = !quoted;
    else if (!quoted && (separator == ' ' ? blank : c == separator))
      fields.emplace_back();
    else if (quoted || !blank || !fields.back().empty())
      fields.back() += c;
  }
  for (std::string& field : fields) field.erase(field.find_last_not_of(" \t\r") + 1);
  if (separator == ' ') std::erase(fields, "");
  while (fields.size() > 2 && fields.back().empty()) fields.pop_back();  // spreadsheets' separators behind the last
  return fields;
}

// NaN and infinities are numbers that nobody wants here, not names.
std::optional<double> numberIn(const std::string& field) {
  const std::string_view digits = field.starts_with('+') ? std::string_view(field).substr(1) : std::string_view(field);
  double value = 0;
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || status == std::errc::invalid_argument || end != digits.data() + digits.size())
    return std::nullopt;
  return status == std::errc{} ? value : std::numeric_limits<double>::infinity();
}

// The two numbers of a line; with decimal commas where semicolons or blanks part them, "0,5;300". InputError where
// blanks part them and a comma may be of thousands.
std::optional<std::array<double, 2>> numbersIn(const std::string& line) {
  const auto two = [](const std::vector<std::string>& fields) -> std::optional<std::array<double, 2>> {
    if (fields.size() != 2) return std::nullopt;
    const auto point = numberIn(fields[0]), value = numberIn(fields[1]);
    if (!point || !value || !std::isfinite(*point) || !std::isfinite(*value)) return std::nullopt;
    return std::array{*point, *value};
  };
  if (const auto numbers = two(fieldsOf(line, separatorOf(line).value_or(' ')))) return numbers;
  for (const char separator : {';', ' '}) {
    const std::vector<std::string> given = fieldsOf(line, separator);
    std::vector<std::string> fields(given.size());
    std::ranges::transform(given, fields.begin(), withDecimalPoint);
    const auto numbers = two(fields);
    if (!numbers) continue;
    if (separator == ' ') refuseThousands(given);
    return numbers;
  }
  return std::nullopt;
}

// Of a header: units behind a blank belong to the name before them where blanks separate the columns.
std::vector<std::string> joinedWithUnits(std::vector<std::string> names) {
  for (std::size_t i = 1; i < names.size();) {
    if (!names[i].starts_with('[') && !names[i].starts_with('(')) {
      ++i;
      continue;
    }
    names[i - 1] += ' ' + names[i];
    names.erase(names.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return names;
}

// InputError for "time_ms", which would be read in SI.
void refuseUnitInName(const std::string& name, const std::string& unit, const units::Dimension& dimension) {
  const std::size_t end = name.rfind('_');
  if (!unit.empty() || end == std::string::npos || end + 1 == name.size()) return;
  const std::string tail = name.substr(end + 1);
  try {
    if (TableColumn(name, tail, dimension).inSI(1) == 1) return;
  } catch (const InputError&) {
    return;  // no unit
  }
  throw InputError(fmt::format("the column '{}' has no unit in brackets and would be read in SI; write '{} [{}]'", name,
                               name.substr(0, end), tail));
}

}  // namespace

TwoColumns readTwoColumns(const std::filesystem::path& path, const units::Dimension& pointDimension,
                          const units::Dimension& valueDimension, const std::string& example,
                          const std::function<void(double)>& check) {
  std::string text = readTextFile(path, "a table of two columns");
  try {
    text = withNamesOutOfComment(text);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
  std::istringstream file(std::move(text));
  std::vector<double> points, values;
  bool first = true;
  std::size_t number = 0;
  TableColumn pointColumn("", "", pointDimension), valueColumn("", "", valueDimension);
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::vector<std::string> fields = fieldsOf(line, separatorOf(line).value_or(' '));
    if (std::all_of(fields.begin(), fields.end(), [](const std::string& field) { return field.empty(); }) ||
        fields[0].starts_with('#'))
      continue;
    const auto refuse = [&](const std::string& why) {
      throw InputError(fmt::format("{}:{}: {}", path.string(), number, why));
    };
    const bool header =
        std::exchange(first, false) &&
        std::none_of(fields.begin(), fields.end(), [](const auto& field) { return numberIn(field).has_value(); });
    if (header) {
      const std::vector<std::string> names = joinedWithUnits(fields);
      if (names.size() != 2) {
        if (line.find_first_of("[(") != std::string::npos)
          refuse(fmt::format("expected the names of two columns, '{}', found '{}'", example, trimmed(line)));
        continue;
      }
      try {
        const auto [pointName, pointUnit] = nameAndUnit(names[0]);
        const auto [valueName, valueUnit] = nameAndUnit(names[1]);
        refuseUnitInName(pointName, pointUnit, pointDimension);
        refuseUnitInName(valueName, valueUnit, valueDimension);
        pointColumn = TableColumn(pointName, pointUnit, pointDimension);
        valueColumn = TableColumn(valueName, valueUnit, valueDimension);
      } catch (const InputError& error) {
        refuse(error.what());
      }
      continue;
    }
    std::optional<std::array<double, 2>> numbers;
    try {
      numbers = numbersIn(line);
    } catch (const InputError& error) {
      refuse(error.what());
    }
    if (!numbers) refuse(fmt::format("expected two numbers, found '{}'", trimmed(line)));
    const double point = pointColumn.inSI((*numbers)[0]), value = valueColumn.inSI((*numbers)[1]);
    if (!points.empty() && !(point > points.back()))
      refuse(fmt::format("the points have to rise; {} follows {}", point, points.back()));
    try {
      check(value);
    } catch (const InputError& error) {
      refuse(error.what());
    }
    points.push_back(point);
    values.push_back(value);
  }
  if (points.empty()) throw InputError(fmt::format("{}: expected lines of two numbers, found none", path.string()));
  return {std::move(points), std::move(values)};
}

}  // namespace lampblack::app
