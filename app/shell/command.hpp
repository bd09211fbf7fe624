// What the command line asks for.
#pragma once

#include <functional>

#include "core/modules.hpp"

namespace lampblack::app {

struct Command {
  enum class On { AllRanks, FirstRank };
  std::function<void()> work;  // on all ranks collective where a launcher started several; on the first without MPI
  bool needsMpi = false;       // without a launcher, too
  On on = On::AllRanks;
};

}  // namespace lampblack::app
