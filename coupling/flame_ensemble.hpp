// Stochastic soot along the paths of a one-dimensional flame: repeats of each path, spread over the ranks, and their
// means with what they differ by. The gas is given: the decoupled solution.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <vector>

#include "core/rooms.hpp"
#include "coupling/flame_trajectory.hpp"
#include "particles/ensemble/ensemble.hpp"
#include "particles/ensemble/ensemble_path.hpp"

namespace lampblack::coupling {

struct FlameEnsembleOptions {
  EnsembleOptions soot;     // `owner` is set for each repeat
  std::size_t repeats = 8;  // of each path, at least 2
  EnsemblePathOptions march;
  std::vector<FlamePathOptions> paths;
};

// Mean of the repeats at the points of a path, and the standard error of that mean.
struct RepeatedValue {
  std::vector<double> mean, error;
};

struct FlameEnsemblePath {
  FlamePathOptions options;
  FlamePath path;
  RepeatedValue number;  // 1/m3
  RepeatedValue volumeFraction;
  RepeatedValue meanDiameter;  // m, of mobility, by number
  RepeatedValue geometricDeviation;
  RepeatedValue primaries;                 // of an aggregate
  RepeatedValue carbon, hydrogen;          // kg/m3
  RepeatedValue surface;                   // m2/m3
  RepeatedValue distribution;              // dN/dlog10(d), 1/m3: bins at the first point, at the second, ...
  std::vector<EnsembleExchange> exchange;  // means, one an interval
  double seconds = 0;                      // of all repeats
};

// Collective. The same on all ranks, to the last bit whatever their number. NumericsError says which repeat failed.
[[nodiscard]] std::vector<FlameEnsemblePath> runFlameEnsemble(MPI_Comm comm, const FlameSootGas& gas,
                                                              const FlameEnsembleOptions& options);

}  // namespace lampblack::coupling
