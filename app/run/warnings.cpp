#include "app/run/warnings.hpp"

#include <iostream>

#include "core/long_lines.hpp"
#include "core/parallel_session.hpp"

namespace lampblack::app {

void printWarnings(const std::vector<std::string>& warnings) {
  if (placeOfProcess().rank != 0 || warnings.empty()) return;
  std::cout.flush();
  for (const auto& warning : warnings) std::cerr << "lampblack: warning: " << withoutLongLines(warning) << '\n';
  std::cerr.flush();
}

}  // namespace lampblack::app
