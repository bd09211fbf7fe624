// What the command line asks for.
#pragma once

#include <functional>

#include "core/modules.hpp"

namespace lampblack::app {

struct Command {
  std::function<void()> work;  // collective where a launcher started several ranks
  bool needsMpi = false;       // without a launcher, too
};

}  // namespace lampblack::app
