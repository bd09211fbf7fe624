#include "app/run/failed_cell.hpp"

#include <fmt/format.h>

#include "chemistry/reactor/reactor_replay.hpp"
#include "core/errors.hpp"

namespace lampblack::app {

std::string keepFailedCell(const RunFolder& folder, const Mechanism& mechanism, std::int64_t cell,
                           const FailedCell& failed) {
  const auto path = folder.failedCell(cell);
  try {
    writeFileAtomically(path, replayText(mechanism, failed));
  } catch (const InputError& error) {
    return fmt::format("; the cell could not be kept: {}", error.what());
  }
  return fmt::format("; try it again with: lampblack replay {}", path.string());
}

}  // namespace lampblack::app
