// What benchmarks measure on a machine that does other work besides.
#pragma once

#include <ctime>

namespace lampblack::bench {

// s, that this process has computed so far.
inline double processorSeconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace lampblack::bench
