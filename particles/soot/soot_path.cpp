#include "particles/soot/soot_path.hpp"

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

std::size_t divisions(const SootPathPoint& from, const SootPathPoint& to, const SootPathOptions& options) {
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

SootPathRecord record(const StochasticSoot& soot, const SootPathOptions& options) {
  SootPathRecord r;
  r.totals = soot.totals();
  r.volumeFraction = r.totals.mass() / soot.options().soot.sootDensity;
  r.geometricDeviation = soot.geometricDeviation();
  r.distribution = soot.sizeDistribution(options.logDiameterMin, options.logDiameterMax, options.bins);
  return r;
}

}  // namespace

SootPathResult marchPath(StochasticSoot& soot, const SootPath& path, const SootPathOptions& options) {
  const auto& points = path.points;
  if (points.size() < 2 || path.divergence.size() + 1 != points.size())
    throw InputError("soot path: at least two points are needed, and a divergence between each and the next");
  const std::size_t n = soot.options().soot.pah.size();
  SootPathResult result;
  result.records.reserve(points.size());
  result.exchange.reserve(points.size() - 1);
  result.records.push_back(record(soot, options));
  (void)soot.takeExchange();
  std::vector<double> pah(n);
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const SootPathPoint &from = points[k], &to = points[k + 1];
    if (from.pah.size() != n || to.pah.size() != n)
      throw InputError(fmt::format("soot path: {} PAH at z = {} m, {} in the model", to.pah.size(), to.z, n));
    if (!(to.time >= from.time))
      throw InputError(fmt::format("soot path: time falls from {} to {} s", from.time, to.time));
    const std::size_t parts = divisions(from, to, options);
    const double dt = (to.time - from.time) / static_cast<double>(parts);
    for (std::size_t part = 0; part < parts && dt > 0; ++part) {
      const double w = (static_cast<double>(part) + 0.5) / static_cast<double>(parts);
      SootGasState gas;
      for (const auto value : gasValues) gas.*value = (1 - w) * from.gas.*value + w * to.gas.*value;
      for (std::size_t i = 0; i < n; ++i) pah[i] = (1 - w) * from.pah[i] + w * to.pah[i];
      gas.pah = pah;
      soot.advance(gas, path.divergence[k], dt);
    }
    result.records.push_back(record(soot, options));
    result.exchange.push_back(soot.takeExchange());
  }
  return result;
}

}  // namespace lampblack
