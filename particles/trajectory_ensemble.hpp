// An ensemble marched along a trajectory: a particle path through a flow that has been solved already, given as samples
// of the gas in time. Between samples the gas is linear in time. This is the decoupled solution: the flow carried the
// two-equation model, the ensemble resolves the size distribution.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "particles/ensemble.hpp"
#include "particles/gas_path.hpp"

namespace lampblack {

struct TrajectorySample : GasSample {
  std::array<double, 3> position{};  // m
  double divergence = 0;             // 1/s, of the velocity of the particles, thermophoresis included
};

struct TrajectoryOptions {
  double logDiameterMin = -9.2, logDiameterMax = -6.2;  // bins of log10(d/m)
  std::size_t bins = 60;
  GasDivision division;
};

struct TrajectoryRecord {
  double time = 0;
  std::array<double, 3> position{};
  double numberDensity = 0, volumeFraction = 0, meanDiameter = 0, geometricStandardDeviation = 1;
  std::vector<double> distribution;  // dN/dlog10(d), 1/m3
};

// Advances `ensemble` over the samples; one record per sample, the first before anything has happened. Throws
// InputError for fewer than two samples, times that decrease or PAH lists that do not match the ensemble's.
[[nodiscard]] std::vector<TrajectoryRecord> marchTrajectory(Ensemble& ensemble,
                                                            const std::vector<TrajectorySample>& samples,
                                                            const TrajectoryOptions& options = {});

}  // namespace lampblack
