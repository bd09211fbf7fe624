#include "particles/ensemble/ensemble_path.hpp"

#include <numeric>

#include "core/errors.hpp"

namespace lampblack::particles {
namespace {

EnsemblePathRecord record(const Ensemble& soot, const EnsemblePathOptions& options) {
  EnsemblePathRecord r;
  r.totals = soot.totals();
  r.volumeFraction = r.totals.mass() / soot.options().soot.sootDensity;
  const double density = soot.options().soot.sootDensity;
  r.massSquared = density * density * soot.moment(2);
  r.massCubed = density * density * density * soot.moment(3);
  r.coagulations = soot.counters().coagulations;
  r.geometricDeviation = soot.geometricDeviation();
  r.distribution = soot.sizeDistribution(options.bins.logMin, options.bins.logMax, options.bins.count);
  return r;
}

}  // namespace

EnsemblePathResult marchPath(Ensemble& soot, const ParticlePath& path, const EnsemblePathOptions& options) {
  const auto& points = path.points;
  if (points.empty() || path.divergence.size() + 1 != points.size())
    throw InputError("path of soot: at least one point is needed, and a divergence between each and the next");
  const std::size_t species = SootSpecies::fixed + soot.options().soot.pah.size();
  std::vector<std::size_t> recorded = options.recorded;
  if (recorded.empty()) {
    recorded.resize(points.size());
    std::iota(recorded.begin(), recorded.end(), std::size_t{0});
  }
  if (recorded.back() >= points.size()) throw InputError("path of soot: a record is wanted beyond its last point");
  EnsemblePathResult result;
  result.records.reserve(recorded.size());
  result.exchange.reserve(recorded.size() - 1);
  std::size_t next = 0;
  const auto reached = [&](std::size_t point) {
    if (next == recorded.size() || recorded[next] != point) return;
    result.records.push_back(record(soot, options));
    const EnsembleExchange exchange = soot.takeExchange();
    if (next++ > 0) result.exchange.push_back(exchange);
  };
  reached(0);
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    checkInterval(points[k], points[k + 1], species);
    marchInterval(points[k], points[k + 1], options.division, [&](const ParticleGas& gas, double w, double dt) {
      soot.advance(gas, path.divergence[k].at(w), dt);
    });
    reached(k + 1);
  }
  result.counters = soot.counters();
  return result;
}

}  // namespace lampblack::particles
