#include "particles/soot/soot_path.hpp"

#include "core/errors.hpp"

namespace lampblack {
namespace {

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
    throw InputError("path of soot: at least two points are needed, and a divergence between each and the next");
  const std::size_t n = soot.options().soot.pah.size();
  SootPathResult result;
  result.records.reserve(points.size());
  result.exchange.reserve(points.size() - 1);
  result.records.push_back(record(soot, options));
  (void)soot.takeExchange();
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    checkInterval(points[k], points[k + 1], n);
    marchInterval(points[k], points[k + 1], options.division,
                  [&](const SootGasState& gas, double, double dt) { soot.advance(gas, path.divergence[k], dt); });
    result.records.push_back(record(soot, options));
    result.exchange.push_back(soot.takeExchange());
  }
  return result;
}

}  // namespace lampblack
