// Memory of this process, as Linux counts it.
#pragma once

#include <cstdlib>
#include <fstream>
#include <string>

namespace lampblack::bench {

// Bytes: the most this process has had, since it began or since `forgetPeakMemory`.
inline double peakMemory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024.0 * std::strtod(line.c_str() + 6, nullptr);
  return 0.0;
}

inline void forgetPeakMemory() {
  std::ofstream("/proc/self/clear_refs") << 5;
}

}  // namespace lampblack::bench
