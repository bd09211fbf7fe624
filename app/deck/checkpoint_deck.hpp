// When a run writes checkpoints by itself.
#pragma once

#include <string>

#include "core/modules.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app {

struct CheckpointTimes {
  double wallTime = 0;  // s, between two
  bool atEnd = false;
};

// checkpoint.wall_time, checkpoint.at_end. `more`: what a run may go on to from a checkpoint at its end, "more
// repeats".
[[nodiscard]] DeckKeys<CheckpointTimes> checkpointKeys(const std::string& more);

}  // namespace lampblack::app
