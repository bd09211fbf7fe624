// A stochastic population of any kind marched along a path through a gas that is known: the decoupled solution. The
// path says when the particles are where, in what gas, and how fast their velocity diverges.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "particles/gas/gas_path.hpp"
#include "particles/stochastic/size_bins.hpp"
#include "particles/stochastic/stochastic_population.hpp"

namespace lampblack::particles {

struct PathMarch {
  SizeBins bins = {};
  // Of `counted` nothing: the population's own (pathSpecies()).
  GasDivision division = {};
  std::vector<std::size_t> recorded = {};  // points with a record, rising; empty: all
};

struct PathRecord {
  std::vector<double> values;        // of StochasticPopulation::columns()
  std::vector<double> distribution;  // the first of distributions(), 1/m3
};

// Between two records, per m3 of the gas of each moment.
struct PathExchange {
  std::vector<double> gas;        // mol, of the population's species: gained by the gas
  std::vector<double> elements;   // kg of each element, gained by the particles
  std::vector<double> processes;  // of StochasticPopulation::processes()
};

struct PathResult {
  std::vector<PathRecord> records;     // one a recorded point; at the first before anything has happened
  std::vector<PathExchange> exchange;  // one between two records
  std::vector<double> content;         // kg/m3 of each element of the particles, in the end
  std::vector<std::pair<std::string, double>> counts;
};

// InputError without a point or where a divergence is missing, for times that fall, and for species that are not the
// population's.
[[nodiscard]] PathResult marchPath(StochasticPopulation& population, const ParticlePath& path,
                                   const PathMarch& march = {});

}  // namespace lampblack::particles
