// A column of numbers in a table of texts: its name, its unit, its fields in SI.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "core/modules.hpp"
#include "io/units.hpp"

namespace lampblack::io {

// Whether a text is a unit, "cm/s", as a column has it in brackets.
[[nodiscard]] bool isUnit(std::string_view text);

// "velocity [cm/s]": the name and the unit, which is empty where there is none. The blank may be missing but behind the
// name of a species, "X_CH2[S]"; and a unit may stand in round brackets where nothing but a unit can be meant:
// "temperature (K)", but not "temperature (measured)".
[[nodiscard]] std::pair<std::string, std::string> nameAndUnit(const std::string& header);

class TableColumn {
 public:
  // InputError where the unit is not of the dimension; without a unit the column is in SI.
  TableColumn(std::string name, const std::string& unit, const units::Dimension& dimension);
  [[nodiscard]] double inSI(double value) const { return unit_.factor * value + unit_.offset; }
  // InputError, with the line, for what is not a finite number.
  [[nodiscard]] double read(const std::string& field, std::size_t line) const;

 private:
  std::string name_;
  units::Unit unit_;
};

}  // namespace lampblack::io
