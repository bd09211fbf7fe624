// Decimal commas of tables whose fields are not parted by commas.
#pragma once

#include <span>
#include <string>

#include "core/modules.hpp"

namespace lampblack::io {

// "1,5e3" as "1.5e3"; what is no such number stays as it is.
[[nodiscard]] std::string withDecimalPoint(std::string field);

// InputError where the comma of one of the fields may be that of thousands: "1,200", but not "0,200" and "1,20". For
// tables between blanks or tabulators; semicolons stand where commas are decimal.
void refuseThousands(std::span<const std::string> fields);

}  // namespace lampblack::io
