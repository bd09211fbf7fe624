// The file that a failed cell leaves, and from which it is advanced again: YAML with the mechanism's path, the state to
// the last digit, the interval and the options (docs/formats.md).
#pragma once

#include <string>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/reactor_failure.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// The text of the file. The mechanism's path is written absolute.
std::string replayText(const Mechanism& mechanism, const FailedCell& cell);

struct Replay {
  Mechanism mechanism;
  FailedCell cell;
};

// Reads such a file and the mechanism it names; a relative path counts from the file's folder. InputError with file,
// line and what was expected for keys or species that are unknown, missing or given twice, and values that are no
// numbers. Numbers that are no state of a gas (.nan, for one) are taken: they may be what failed.
Replay readReplay(const std::string& path);

}  // namespace lampblack::chemistry
