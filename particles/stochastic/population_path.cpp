#include "particles/stochastic/population_path.hpp"

#include <numeric>

#include "core/errors.hpp"

namespace lampblack::particles {
namespace {

std::vector<double> contentOf(const StochasticPopulation& population) {
  const AmountsOfParticles at{population.elements().size()};
  std::vector<double> amounts(at.diameters() + 1, 0.0);
  population.forEachRow([&](const double* row) { population.addAmounts(row, row[packedNumberAt], amounts); });
  const auto first = amounts.begin() + static_cast<std::ptrdiff_t>(at.element(0));
  return {first, first + static_cast<std::ptrdiff_t>(at.held)};
}

}  // namespace

PathResult marchPath(StochasticPopulation& population, const ParticlePath& path, const PathMarch& march) {
  const auto& points = path.points;
  if (points.empty() || path.divergence.size() + 1 != points.size())
    throw InputError("path of particles: at least one point is needed, and a divergence between each and the next");
  const std::size_t species = population.species().size();
  std::vector<std::size_t> recorded = march.recorded;
  if (recorded.empty()) {
    recorded.resize(points.size());
    std::iota(recorded.begin(), recorded.end(), std::size_t{0});
  }
  if (recorded.back() >= points.size()) throw InputError("path of particles: a record is wanted beyond its last point");
  GasDivision division = march.division;
  if (division.counted.empty()) division.counted = population.pathSpecies();
  PathResult result;
  result.records.reserve(recorded.size());
  result.exchange.reserve(recorded.size() - 1);
  std::size_t next = 0;
  const auto reached = [&](std::size_t point) {
    if (next == recorded.size() || recorded[next] != point) return;
    population.applyDeferred();
    StochasticPopulation::Exchange exchange = population.takeExchange();
    const GasSample& at = points[point];
    result.records.push_back(
        {population.values(ParticleGas{at.gas, at.concentrations}), population.distribution(0, march.bins)});
    if (next++ > 0)
      result.exchange.push_back(
          {std::move(exchange.gas), std::move(exchange.elements), population.amountsOfProcesses()});
  };
  reached(0);
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    checkInterval(points[k], points[k + 1], species);
    marchInterval(points[k], points[k + 1], division, [&](const ParticleGas& gas, double w, double dt) {
      population.advanceDiverging(gas, path.divergence[k].at(w), dt);
    });
    reached(k + 1);
  }
  result.content = contentOf(population);
  result.counts = population.counts();
  return result;
}

}  // namespace lampblack::particles
