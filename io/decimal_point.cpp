#include "io/decimal_point.hpp"

#include <algorithm>

namespace lampblack::io {

std::string withDecimalPoint(std::string field) {
  const std::size_t comma = field.find(','), begin = field.find_first_not_of("+-");
  if (comma == std::string::npos || begin > 1) return field;
  const std::size_t end = std::min(field.find_first_of("eE", comma), field.size());
  const auto areDigits = [&](std::size_t from, std::size_t to) {
    return std::all_of(field.begin() + static_cast<std::ptrdiff_t>(from),
                       field.begin() + static_cast<std::ptrdiff_t>(to), [](char c) { return c >= '0' && c <= '9'; });
  };
  const bool isNumber = comma + 1 < end && areDigits(begin, comma) && areDigits(comma + 1, end) &&
                        field.find_first_not_of("eE+-0123456789", end) == std::string::npos;
  if (isNumber) field[comma] = '.';
  return field;
}

}  // namespace lampblack::io
