// The gas that aggregates of spheres are in, from a table.
#pragma once

#include <filesystem>

#include "core/modules.hpp"
#include "particles/aggregates/aggregates_gas.hpp"

namespace lampblack::app {

// Columns "time", "temperature", "pressure" and, where there are any, "births" and "growth", each with a unit in
// brackets or in SI. InputError, naming the file.
[[nodiscard]] AggregatesGas readAggregatesGas(const std::filesystem::path& file);

}  // namespace lampblack::app
