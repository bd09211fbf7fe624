// What a checkpoint of an engine has: the repeats that have ended, and of a run of one repeat its cycle as it is.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/problems/engine/engine_repeat.hpp"
#include "app/run/saved_progress.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

struct EngineProgress {
  std::uint64_t done = 0;                 // repeats
  std::vector<double> repeats;            // what they leave, one after the other; of rank 0
  std::vector<double> particles, cycles;  // EngineRepeat, of the first
  std::optional<EngineCycles> present;    // where there is one repeat, whose ranks share the reactions
};

// What decides what a checkpoint means: the deck, but for the number of repeats, and the mechanism.
[[nodiscard]] Fingerprint engineFingerprint(const Deck& deck, const EngineCase& made);
// `progress` has to live as long.
[[nodiscard]] ArchiveOwners engineOwners(EngineProgress& progress);

}  // namespace lampblack::app
