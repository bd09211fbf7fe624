// A stochastic soot population marched along a path through a gas that is known: the decoupled solution. The path says
// when the particles are where, in what gas, and how fast their velocity diverges.
#pragma once

#include <cstddef>
#include <vector>

#include "core/modules.hpp"
#include "particles/ensemble/ensemble.hpp"
#include "particles/gas/gas_path.hpp"
#include "particles/stochastic/size_bins.hpp"

namespace lampblack::particles {

struct ParticlePath {
  std::vector<GasSample> points;  // in the order of time
  // Of the particles' velocity, 1/s, between a point and the next: at its two ends, linear in time.
  struct Divergence {
    double first = 0, last = 0;
    [[nodiscard]] double at(double w) const { return first + w * (last - first); }
  };
  std::vector<Divergence> divergence;
};

struct EnsemblePathOptions {
  SizeBins bins = {};
  GasDivision division = {};
  std::vector<std::size_t> recorded = {};  // points with a record, rising; empty: all
};

struct EnsemblePathRecord {
  Ensemble::Totals totals;
  double volumeFraction = 0, geometricDeviation = 1;
  double massSquared = 0, massCubed = 0;  // sums over particles: kg2/m3, kg3/m3
  std::uint64_t coagulations = 0;         // events since the start
  std::vector<double> distribution;       // dN/dlog10(d), 1/m3
};

struct EnsemblePathResult {
  std::vector<EnsemblePathRecord> records;  // one a recorded point; at the first before anything has happened
  std::vector<EnsembleExchange> exchange;   // one between two records
  PopulationCounters counters;
};

// Throws InputError without a point or where a divergence is missing, for times that fall, and for species that are
// not the population's.
[[nodiscard]] EnsemblePathResult marchPath(Ensemble& soot, const ParticlePath& path,
                                           const EnsemblePathOptions& options = {});

}  // namespace lampblack::particles
