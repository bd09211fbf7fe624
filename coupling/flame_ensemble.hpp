// A stochastic population of any kind along the paths of a one-dimensional flame: repeats of each path, spread over the
// ranks, and their means with what they differ by. The gas is given: the decoupled solution.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <vector>

#include "core/modules.hpp"
#include "coupling/flame_trajectory.hpp"
#include "coupling/path_ensemble.hpp"

namespace lampblack::coupling {

struct FlameEnsembleOptions {
  MakePopulation make;
  std::size_t repeats = 8;  // of each path, at least 2
  PathMarch march;
  std::vector<FlamePathOptions> paths;
};

struct FlameEnsemblePath : PathEnsemble {
  FlamePathOptions options;
  FlamePath path;
};

// Collective. The same on all ranks, to the last bit whatever their number. NumericsError says which repeat failed.
[[nodiscard]] std::vector<FlameEnsemblePath> runFlameEnsemble(MPI_Comm comm, const GasOfFlame& gas,
                                                              const FlameEnsembleOptions& options);

}  // namespace lampblack::coupling
