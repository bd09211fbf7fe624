// The exact state of a flame in a results file, group /flame/restart: its unknowns to the last bit and their names, so
// that any flame can start from it, also on another mechanism.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "flow/flame/initial_flame.hpp"
#include "io/results_writer.hpp"

namespace lampblack::app {

// Collective; the profile is the same on all ranks.
void writeFlameProfile(ResultsWriter& results, const NamedFlameProfile& flame);

// Not collective. InputError, naming the file, where it is missing, damaged, or not of a flame.
[[nodiscard]] NamedFlameProfile readFlameProfile(const std::filesystem::path& path);

}  // namespace lampblack::app
