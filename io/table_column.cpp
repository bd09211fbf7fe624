#include "io/table_column.hpp"

#include <fmt/format.h>

#include <string_view>

#include "core/errors.hpp"

namespace lampblack::io {

bool isUnit(std::string_view text) {
  try {
    static_cast<void>(units::parseUnit(text));
    return true;
  } catch (const InputError&) {
    return false;
  }
}

std::pair<std::string, std::string> nameAndUnit(const std::string& header) {
  const bool isSpecies = header.starts_with("X_");
  for (const std::string_view brackets : {"[]", "()"}) {
    const std::size_t open = header.rfind(brackets[0]);
    if (open == std::string::npos || open == 0 || !header.ends_with(brackets[1])) continue;
    const bool hasBlank = header[open - 1] == ' ';
    if (isSpecies && !(hasBlank && brackets == "[]")) continue;
    std::string unit = header.substr(open + 1, header.size() - open - 2);
    if (brackets == "()" && !isUnit(unit)) continue;
    const std::size_t end = header.find_last_not_of(' ', open - 1);
    return {header.substr(0, end == std::string::npos ? 0 : end + 1), std::move(unit)};
  }
  // "t / ms"
  for (std::size_t slash = header.find('/', 1); !isSpecies && slash != std::string::npos;
       slash = header.find('/', slash + 1)) {
    const std::size_t begin = header.find_first_not_of(' ', slash + 1), end = header.find_last_not_of(' ', slash - 1);
    if (begin != std::string::npos && end != std::string::npos && isUnit(header.substr(begin)))
      return {header.substr(0, end + 1), header.substr(begin)};
  }
  return {header, ""};
}

TableColumn::TableColumn(std::string name, const std::string& unit, const units::Dimension& dimension)
    : name_(std::move(name)) {
  if (unit.empty() || unit == "1") return;
  unit_ = units::parseUnit(unit);
  if (unit_.dimension != dimension)
    throw InputError(fmt::format("the column '{}' is in {}; expected {}", name_, unit, units::describe(dimension)));
}

double TableColumn::read(const std::string& field, std::size_t line) const {
  try {
    return inSI(units::parseNumber(field));
  } catch (const InputError&) {
    throw InputError(fmt::format("line {}: expected a finite number as '{}', found '{}'{}", line, name_, field,
                                 field.find(',') == std::string::npos ? "" : "; numbers have a decimal point"));
  }
}

}  // namespace lampblack::io
