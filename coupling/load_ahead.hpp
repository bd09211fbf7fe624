// Populations of cells lie anywhere in memory: who goes through those of many cells asks for the next one's while it
// works on one.
#pragma once

#include <cstddef>
#include <vector>

namespace lampblack::coupling {

inline void loadAhead(const std::vector<std::vector<double>>& populations, std::size_t cell) {
  if (cell >= populations.size()) return;
  constexpr std::size_t line = 8;  // doubles
  const std::vector<double>& rows = populations[cell];
  for (std::size_t i = 0; i < rows.size(); i += line) __builtin_prefetch(&rows[i]);
}

}  // namespace lampblack::coupling
