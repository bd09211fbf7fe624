// A stochastic soot population marched along a path through a gas that is known: the decoupled solution. The path says
// when the particles are where, in what gas, and how fast their velocity diverges.
#pragma once

#include <cstddef>
#include <vector>

#include "particles/gas_path.hpp"
#include "particles/soot/stochastic_soot.hpp"

namespace lampblack {

struct SootPathPoint : GasSample {
  double z = 0;         // m
  double velocity = 0;  // m/s, of the particles: of the gas and by thermophoresis
};

struct SootPath {
  std::vector<SootPathPoint> points;  // in the order of time
  std::vector<double> divergence;     // 1/s: mean of the particles' velocity between a point and the next
};

struct SootPathOptions {
  double logDiameterMin = -9.2, logDiameterMax = -6.2;  // bins of log10(d/m)
  std::size_t bins = 60;
  GasDivision division;
};

struct SootPathRecord {
  StochasticSoot::Totals totals;
  double volumeFraction = 0, geometricDeviation = 1;
  std::vector<double> distribution;  // dN/dlog10(d), 1/m3
};

struct SootPathResult {
  std::vector<SootPathRecord> records;  // one a point; the first before anything has happened
  std::vector<SootExchange> exchange;   // one an interval
};

// Throws InputError for fewer than two points, times that fall, or PAH lists that are not the population's.
[[nodiscard]] SootPathResult marchPath(StochasticSoot& soot, const SootPath& path, const SootPathOptions& options = {});

}  // namespace lampblack
