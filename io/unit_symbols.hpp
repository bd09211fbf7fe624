// The units that are known by name, with their prefixes, and what is said of others.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/modules.hpp"
#include "io/units.hpp"

namespace lampblack::io::units {

// "mm", "Torr"; nothing where the name is none of a unit.
std::optional<Unit> unitOfSymbol(std::string_view name);

// How a unit that is not known may have been meant: "; did you mean Torr?" of "torr", "; write degC" of "C", or
// nothing.
std::string unitAsWrittenHere(std::string_view name);

}  // namespace lampblack::io::units
