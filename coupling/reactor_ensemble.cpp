#include "coupling/reactor_ensemble.hpp"

#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "core/packed_doubles.hpp"
#include "coupling/ensemble_species.hpp"

namespace lampblack::coupling {

ReactorEnsemble::ReactorEnsemble(const Mechanism& mechanism, EnsembleOptions options) {
  species_ = indicesOfSootSpecies(mechanism, options.soot);
  population_ = makeEnsemble(std::move(options));
}

SplitParticles::Exchange ReactorEnsemble::advance(const ParticleGas& gas, double dt) {
  population_->advance(gas, 0, dt);
  const EnsembleExchange taken = population_->takeExchange();
  return {{taken.gas.begin(), taken.gas.begin() + static_cast<std::ptrdiff_t>(species_.size())},
          {taken.carbon, taken.hydrogen}};
}

void ReactorEnsemble::dilute(double factor) {
  if (factor != 1) population_->dilute(factor);
}

std::vector<double> ReactorEnsemble::content() const {
  std::vector<double> content;
  for (const GivenParticle& p : population_->particles()) packDoubles(content, p);
  return content;
}

void ReactorEnsemble::join(std::span<const double> content, double share) {
  PackedDoubles packed(content);
  std::vector<GivenParticle> particles;
  while (packed.left() > 0) particles.push_back(packed.next<GivenParticle>());
  population_->join(particles, share);
}

bool ReactorEnsemble::idle(const ParticleGas& gas) const {
  return population_->size() == 0 && !hasPrecursors(gas);
}

std::vector<ReactorPopulation::Column> ReactorEnsemble::columns() const {
  return {{"soot_volume_fraction", "1", "particle volume per volume of gas"},
          {"soot_number_density", "1/m^3", "particles"},
          {"soot_mean_diameter", "m", "of the sphere of mean volume"},
          {"soot_mobility_diameter", "m", "mean mobility diameter"},
          {"soot_geometric_deviation", "1", "of the diameter of mobility, by number"},
          {"soot_surface_area", "m^2/m^3", "surface of all particles"},
          {"soot_carbon", "kg/m^3", "carbon in particles"},
          {"soot_hydrogen", "kg/m^3", "hydrogen in particles"}};
}

std::vector<double> ReactorEnsemble::values(const ParticleGas&) const {
  const Ensemble::Totals totals = population_->totals();
  const double fraction = population_->volumeFraction();
  return {fraction,
          totals.number,
          totals.number > 0 ? std::cbrt(6 / constants::pi * fraction / totals.number) : 0.0,
          totals.meanDiameter(),
          population_->geometricDeviation(),
          totals.surface,
          totals.carbon,
          totals.hydrogen};
}

std::vector<ReactorPopulation::Distribution> ReactorEnsemble::distributions() const {
  return {{"", "by mobility diameter"}};
}

std::vector<double> ReactorEnsemble::distribution(std::size_t, double logMin, double logMax, std::size_t bins) const {
  return population_->sizeDistribution(logMin, logMax, bins);
}

}  // namespace lampblack::coupling
