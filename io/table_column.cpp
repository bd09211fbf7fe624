#include "io/table_column.hpp"

#include <fmt/format.h>

#include "core/errors.hpp"

namespace lampblack::io {

std::pair<std::string, std::string> nameAndUnit(const std::string& header) {
  const std::size_t open = header.rfind(" [");
  if (open == std::string::npos || !header.ends_with(']')) return {header, ""};
  return {header.substr(0, open), header.substr(open + 2, header.size() - open - 3)};
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
    return unit_.factor * units::parseNumber(field) + unit_.offset;
  } catch (const InputError&) {
    throw InputError(fmt::format("line {}: expected a finite number as '{}', found '{}'", line, name_, field));
  }
}

}  // namespace lampblack::io
