#include "particles/ensemble/ensemble_path.hpp"

#include "core/errors.hpp"
#include "particles/ensemble/size_bins.hpp"

namespace lampblack::particles {
namespace {

EnsemblePathRecord record(const Ensemble& soot, const EnsemblePathOptions& options) {
  EnsemblePathRecord r;
  r.totals = soot.totals();
  r.volumeFraction = r.totals.mass() / soot.options().soot.sootDensity;
  r.geometricDeviation = soot.geometricDeviation();
  r.distribution = soot.sizeDistribution(options.logDiameterMin, options.logDiameterMax, options.bins);
  return r;
}

}  // namespace

std::vector<double> EnsemblePathOptions::binEdges() const {
  return SizeBins{logDiameterMin, logDiameterMax, bins}.edges();
}

EnsemblePathResult marchPath(Ensemble& soot, const ParticlePath& path, const EnsemblePathOptions& options) {
  const auto& points = path.points;
  if (points.empty() || path.divergence.size() + 1 != points.size())
    throw InputError("path of soot: at least one point is needed, and a divergence between each and the next");
  const std::size_t species = SootSpecies::fixed + soot.options().soot.pah.size();
  EnsemblePathResult result;
  result.records.reserve(points.size());
  result.exchange.reserve(points.size() - 1);
  result.records.push_back(record(soot, options));
  (void)soot.takeExchange();
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    checkInterval(points[k], points[k + 1], species);
    marchInterval(points[k], points[k + 1], options.division, [&](const ParticleGas& gas, double w, double dt) {
      soot.advance(gas, path.divergence[k].at(w), dt);
    });
    result.records.push_back(record(soot, options));
    result.exchange.push_back(soot.takeExchange());
  }
  return result;
}

}  // namespace lampblack::particles
