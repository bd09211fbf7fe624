#include "particles/trajectory_ensemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack {
namespace {

constexpr double SootGasState::*gasValues[] = {&SootGasState::temperature,
                                               &SootGasState::pressure,
                                               &SootGasState::density,
                                               &SootGasState::viscosity,
                                               &SootGasState::meanMolecularWeight,
                                               &SootGasState::H,
                                               &SootGasState::H2,
                                               &SootGasState::OH,
                                               &SootGasState::H2O,
                                               &SootGasState::O2,
                                               &SootGasState::C2H2};

std::size_t divisions(const TrajectorySample& from, const TrajectorySample& to, const TrajectoryOptions& options) {
  double most = std::abs(to.gas.temperature - from.gas.temperature) / options.temperatureStep;
  const auto consider = [&](double x, double y) {
    const double larger = std::max(std::abs(x), std::abs(y));
    if (larger > 1e-9) most = std::max(most, std::abs(x - y) / larger / options.relativeStep);  // mol/m3
  };
  consider(from.gas.H, to.gas.H);
  consider(from.gas.OH, to.gas.OH);
  consider(from.gas.O2, to.gas.O2);
  consider(from.gas.C2H2, to.gas.C2H2);
  for (std::size_t i = 0; i < from.pah.size(); ++i) consider(from.pah[i], to.pah[i]);
  return std::clamp(static_cast<std::size_t>(std::ceil(most)), std::size_t{1}, options.maximumDivisions);
}

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
  if (samples.size() < 2) throw InputError("soot trajectory: at least two samples are needed");
  const std::size_t n = ensemble.options().soot.pah.size();
  for (const TrajectorySample& sample : samples) {
    if (sample.pah.size() != n) {
      throw InputError(
          fmt::format("soot trajectory: {} PAH at t = {} s, {} in the model", sample.pah.size(), sample.time, n));
    }
  }
  std::vector<TrajectoryRecord> history;
  history.reserve(samples.size());
  history.push_back(record(ensemble, samples.front(), options));
  std::vector<double> pah(n);
  for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
    const TrajectorySample &from = samples[k], &to = samples[k + 1];
    if (!(to.time >= from.time)) {
      throw InputError(fmt::format("soot trajectory: time falls from {} to {} s", from.time, to.time));
    }
    const std::size_t parts = divisions(from, to, options);
    const double dt = (to.time - from.time) / static_cast<double>(parts);
    for (std::size_t part = 0; part < parts && dt > 0; ++part) {
      const double w = (static_cast<double>(part) + 0.5) / static_cast<double>(parts);
      SootGasState gas;
      for (const auto value : gasValues) gas.*value = (1 - w) * from.gas.*value + w * to.gas.*value;
      for (std::size_t i = 0; i < n; ++i) pah[i] = (1 - w) * from.pah[i] + w * to.pah[i];
      gas.pah = pah;
      ensemble.advance(gas, (1 - w) * from.divergence + w * to.divergence, dt);
    }
    history.push_back(record(ensemble, to, options));
  }
  return history;
}

}  // namespace lampblack
