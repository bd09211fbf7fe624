// What becomes of a cell that the chemistry could not advance: a file in the run's folder that `lampblack replay`
// reads.
#pragma once

#include <cstdint>
#include <string>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/reactor_failure.hpp"
#include "core/modules.hpp"
#include "io/run_folder.hpp"

namespace lampblack::app {

// Writes failed_cell_<number>.yaml and returns the end of a message that says how to replay it, or why it could not be
// written. Not collective: the rank that tried the cell knows it, and the number keeps ranks apart.
std::string keepFailedCell(const RunFolder& folder, const Mechanism& mechanism, std::int64_t cell,
                           const FailedCell& failed);

}  // namespace lampblack::app
