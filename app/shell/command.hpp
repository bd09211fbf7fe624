// What the command line asks for.
#pragma once

#include <functional>

#include "core/modules.hpp"

namespace lampblack::app {

struct Command {
  enum class On { AllRanks, FirstRank };
  std::function<void()> work;
  bool needsMpi = false;  // without a launcher, too
  On on = On::AllRanks;  // AllRanks: `work` is collective. FirstRank: on rank 0 alone, after this process has ended MPI
};

}  // namespace lampblack::app
