#include "coupling/reactor_ensemble.hpp"

#include <utility>

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
          taken.carbon,
          taken.hydrogen};
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

}  // namespace lampblack::coupling
