#include "particles/trajectory_ensemble.hpp"

#include "core/errors.hpp"

namespace lampblack {
namespace {

TrajectoryRecord record(const Ensemble& ensemble, const TrajectorySample& sample, const TrajectoryOptions& options) {
  return {sample.time,
          sample.position,
          ensemble.numberDensity(),
          ensemble.volumeFraction(),
          ensemble.meanDiameter(),
          ensemble.geometricStandardDeviation(),
          ensemble.sizeDistribution(options.logDiameterMin, options.logDiameterMax, options.bins)};
}

}  // namespace

std::vector<TrajectoryRecord> marchTrajectory(Ensemble& ensemble, const std::vector<TrajectorySample>& samples,
                                              const TrajectoryOptions& options) {
  if (samples.empty()) throw InputError("path of soot: at least one sample is needed");
  const std::size_t n = ensemble.options().soot.pah.size();
  for (std::size_t k = 0; k + 1 < samples.size(); ++k) checkInterval(samples[k], samples[k + 1], n);
  std::vector<TrajectoryRecord> history;
  history.reserve(samples.size());
  history.push_back(record(ensemble, samples.front(), options));
  for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
    const TrajectorySample &from = samples[k], &to = samples[k + 1];
    marchInterval(from, to, options.division, [&](const SootGasState& gas, double w, double dt) {
      ensemble.advance(gas, (1 - w) * from.divergence + w * to.divergence, dt);
    });
    history.push_back(record(ensemble, to, options));
  }
  return history;
}

}  // namespace lampblack
