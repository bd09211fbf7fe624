#include "io/table_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/errors.hpp"
#include "core/letter_case.hpp"
#include "io/table_column.hpp"

namespace lampblack::io {
namespace {

bool isNumberText(const std::string& text) {
  try {
    static_cast<void>(units::parseNumber(text));
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

bool isColumnName(std::string_view column, std::string_view name) {
  return name.size() == 1 ? column == name : sameInAnyCase(column, name);
}

TableColumns::TableColumns(const TextTable& table) : table_(table) {
  for (const std::string& header : table.columns) {
    auto [name, unit] = nameAndUnit(header);
    names_.push_back(std::move(name));
    units_.push_back(std::move(unit));
  }
  if (!names_.empty() && std::ranges::all_of(table.columns, isNumberText))
    throw InputError(fmt::format("the first line has the numbers {} in place of the names of the columns",
                                 fmt::join(table.columns, ", ")));
}

std::string TableColumns::listed() const {
  std::vector<std::string> quoted;
  for (const std::string& header : table_.columns) quoted.push_back(fmt::format("'{}'", header));
  return fmt::format("{}", fmt::join(quoted, ", "));
}

std::optional<std::size_t> TableColumns::find(const std::vector<std::string_view>& names) const {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < size(); ++i) {
    if (std::ranges::none_of(names, [&](std::string_view name) { return isColumnName(names_[i], name); })) continue;
    if (found)
      throw InputError(fmt::format("two columns say the same, '{}' and '{}'; leave one out", table_.columns[*found],
                                   table_.columns[i]));
    found = i;
  }
  return found;
}

std::vector<double> TableColumns::read(std::size_t column, const units::Dimension& dimension) const {
  const TableColumn reader(names_[column], units_[column], dimension);
  std::vector<double> values;
  for (std::size_t row = 0; row < table_.rows.size(); ++row)
    values.push_back(reader.read(table_.rows[row][column], table_.lines[row]));
  return values;
}

}  // namespace lampblack::io
