// The columns of a table of texts by their names, which may have their units behind them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/modules.hpp"
#include "io/csv.hpp"
#include "io/units.hpp"

namespace lampblack::io {

// Whether a column of this name is meant: letters of either case, but for names of one letter, as t and T differ.
[[nodiscard]] bool isColumnName(std::string_view column, std::string_view name);

class TableColumns {
 public:
  // Of a table that stays. InputError where there are numbers in place of names.
  explicit TableColumns(const TextTable& table);

  [[nodiscard]] std::size_t size() const { return names_.size(); }
  // Without its unit.
  [[nodiscard]] const std::string& name(std::size_t column) const { return names_[column]; }
  [[nodiscard]] const std::string& unit(std::size_t column) const { return units_[column]; }
  // "'time [s]', 'T [K]'": all of them, for messages.
  [[nodiscard]] std::string listed() const;
  // The column that has one of the names; InputError where two have.
  [[nodiscard]] std::optional<std::size_t> find(const std::vector<std::string_view>& names) const;
  // Its values in SI, row by row. InputError where the unit is of another dimension, and for what is no finite number.
  [[nodiscard]] std::vector<double> read(std::size_t column, const units::Dimension& dimension) const;

 private:
  const TextTable& table_;
  std::vector<std::string> names_, units_;
};

}  // namespace lampblack::io
