// A stochastic population of any kind along one path through a gas that is known: repeats, spread over the ranks, and
// their means with what they differ by.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "core/quantity.hpp"
#include "particles/stochastic/population_path.hpp"

namespace lampblack::coupling {

// Mean of the repeats at the records of a path, and the standard error of that mean.
struct RepeatedValue {
  std::vector<double> mean, error;
};

struct PathEnsemble {
  std::string material;
  std::vector<Quantity> columns, processes;  // of the population
  std::vector<RepeatedValue> values;         // of each column
  RepeatedValue distribution;                // dN/dlog10(d), 1/m3: bins at the first record, at the second, ...
  std::vector<PathExchange> exchange, exchangeError;  // means, one between two records, and their standard errors
  std::vector<double> content;  // kg/m3 of each element of the particles, in the end, mean of the repeats
  std::vector<std::pair<std::string, double>> counts;  // of all repeats
  double seconds = 0;                                  // of all repeats

  // Of a column by its name without the material, such as number_density, which has to be there.
  [[nodiscard]] const RepeatedValue& valuesOf(const std::string& name) const;
  [[nodiscard]] double count(const std::string& name) const;  // zero where nothing of this name is counted
};

// Collective. The same on all ranks, to the last bit whatever their number. `firstOwner` is that of the random numbers
// of the first repeat, the others have the next. InputError with less than 2 repeats; NumericsError, in the name of
// `what`, says which failed.
[[nodiscard]] PathEnsemble runPathEnsemble(MPI_Comm comm, const ParticlePath& path, const MakePopulation& make,
                                           std::uint64_t firstOwner, std::size_t repeats, const PathMarch& march,
                                           const std::string& what);

}  // namespace lampblack::coupling
