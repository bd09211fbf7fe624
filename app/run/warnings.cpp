#include "app/run/warnings.hpp"

#include <petscsys.h>

#include <iostream>

#include "core/long_lines.hpp"

namespace lampblack::app {

void printWarnings(const std::vector<std::string>& warnings) {
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  if (rank != 0 || warnings.empty()) return;
  std::cout.flush();
  for (const auto& warning : warnings) std::cerr << "lampblack: warning: " << withoutLongLines(warning) << '\n';
  std::cerr.flush();
}

}  // namespace lampblack::app
