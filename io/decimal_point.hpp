// Decimal commas of tables whose fields are not parted by commas.
#pragma once

#include <string>

#include "core/modules.hpp"

namespace lampblack::io {

// "1,5e3" as "1.5e3"; what is no such number stays as it is.
[[nodiscard]] std::string withDecimalPoint(std::string field);

}  // namespace lampblack::io
