// Stochastic soot along one path through a gas that is known: repeats, spread over the ranks, and their means with what
// they differ by.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "particles/ensemble/ensemble.hpp"
#include "particles/ensemble/ensemble_path.hpp"

namespace lampblack::coupling {

// Mean of the repeats at the records of a path, and the standard error of that mean.
struct RepeatedValue {
  std::vector<double> mean, error;
};

struct PathEnsemble {
  RepeatedValue number;  // 1/m3
  RepeatedValue volumeFraction;
  RepeatedValue meanDiameter;  // m, of mobility, by number
  RepeatedValue geometricDeviation;
  RepeatedValue primaries;               // of an aggregate
  RepeatedValue carbon, hydrogen;        // kg/m3
  RepeatedValue surface;                 // m2/m3
  RepeatedValue mass;                    // kg/m3
  RepeatedValue volumeDiameter;          // m, of the sphere of mean volume
  RepeatedValue massSquared, massCubed;  // kg2/m3, kg3/m3
  RepeatedValue coagulations;            // events so far, of a repeat
  RepeatedValue distribution;            // dN/dlog10(d), 1/m3: bins at the first record, at the second, ...
  std::vector<EnsembleExchange> exchange, exchangeError;  // means, one between two records, and their standard errors
  PopulationCounters counters;                            // of all repeats
  double seconds = 0;                                     // of all repeats
};

// Collective. The same on all ranks, to the last bit whatever their number. `options.owner` is that of the first
// repeat, the others have the next. InputError with less than 2 repeats; NumericsError, in the name of `what`, says
// which failed.
[[nodiscard]] PathEnsemble runPathEnsemble(MPI_Comm comm, const ParticlePath& path, const EnsembleOptions& options,
                                           std::size_t repeats, const EnsemblePathOptions& march,
                                           const std::string& what);

}  // namespace lampblack::coupling
