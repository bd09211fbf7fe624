// Which rank this is, and of how many.
#pragma once

#include <mpi.h>

#include "tests/every_module.hpp"

namespace lampblack::test {

inline int worldRank() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

inline int worldSize() {
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

}  // namespace lampblack::test
