// Which rank has which cell of a mesh. What a run computes does not depend on it, what it takes does.
#pragma once

#include <mpi.h>

#include <span>
#include <vector>

#include "core/cell_set.hpp"

namespace lampblack {

enum class Partitioner {
  Curve,     // pieces of Hilbert's curve: no rank holds more than its share
  Metis,     // METIS (Karypis and Kumar, 1998) on the first rank, which holds the graph of the whole mesh
  PtScotch,  // PT-Scotch (Chevalier and Pellegrini, 2008) on the spread graph; other parts in each run
};

struct Partition {
  Partitioner by = Partitioner::Curve;
  // Cost of each of this rank's cells, zero or more, on any scale; empty on all ranks for equal ones, which also stand
  // in where the sum is zero.
  std::span<const double> weight{};
};

// Whether this build has it: PT-Scotch comes with PETSc, or not.
bool isThere(Partitioner partitioner);

// Collective. The rank of each of this rank's cells: parts of about equal weight, each of at least one cell; but for
// PT-Scotch always the same for the same mesh, weights and number of ranks. Where a graph's partitioner leaves a rank
// without cells the curve takes its place. InputError, on all ranks, when there are fewer cells than ranks.
std::vector<int> ownersOf(MPI_Comm comm, const CellSet& cells, int dimension, const Partition& partition);

}  // namespace lampblack
