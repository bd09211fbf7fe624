#include "io/decimal_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "core/errors.hpp"

namespace lampblack::io {
namespace {

bool areDigits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

std::string_view withoutSign(std::string_view text) {
  return text.substr(text.starts_with('+') || text.starts_with('-') ? 1 : 0);
}

// The digits before and behind the comma of a number, and whether an exponent follows.
struct CommaNumber {
  std::string_view whole, decimals;
  bool hasExponent = false;
};

std::optional<CommaNumber> commaNumber(std::string_view field) {
  const std::string_view number = withoutSign(field);
  const std::size_t comma = number.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const std::size_t end = std::min(number.find_first_of("eE", comma), number.size());
  const CommaNumber parts{number.substr(0, comma), number.substr(comma + 1, end - comma - 1), end < number.size()};
  const bool isNumber = (parts.whole.empty() || areDigits(parts.whole)) && areDigits(parts.decimals) &&
                        (!parts.hasExponent || areDigits(withoutSign(number.substr(end + 1))));
  return isNumber ? std::optional(parts) : std::nullopt;
}

bool mayHaveThousands(std::string_view field) {
  const auto number = commaNumber(field);
  return number && !number->hasExponent && number->decimals.size() == 3 && !number->whole.empty() &&
         number->whole.size() <= 3 && number->whole.front() != '0';
}

}  // namespace

std::string withDecimalPoint(std::string field) {
  if (commaNumber(field)) field[field.find(',')] = '.';
  return field;
}

void refuseThousands(std::span<const std::string> fields) {
  const auto unclear = std::ranges::find_if(fields, mayHaveThousands);
  if (unclear != fields.end())
    throw InputError(
        fmt::format("the comma of '{}' may be that of thousands; write a decimal point, or part the "
                    "columns by semicolons",
                    *unclear));
}

}  // namespace lampblack::io
