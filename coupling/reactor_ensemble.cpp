#include "coupling/reactor_ensemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "core/packed_doubles.hpp"

namespace lampblack::coupling {
namespace {

// Mole fraction of all PAH below which none are born.
constexpr double negligibleMoleFraction = 1e-15;

}  // namespace

ReactorEnsemble::ReactorEnsemble(const Mechanism& mechanism, EnsembleOptions options) {
  for (const std::string& name : sootSpecies(options.soot)) {
    const auto k = mechanism.findSpecies(name);
    if (!k)
      throw InputError(fmt::format(
          "ensembles need the species '{}', but the mechanism has no species of this name; choose another mechanism",
          name));
    species_.push_back(*k);
  }
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
  if (population_->size() > 0) return false;
  double pah = 0;
  for (std::size_t i = SootSpecies::fixed; i < species_.size(); ++i) pah += std::max(gas.concentrations[i], 0.0);
  return pah < negligibleMoleFraction * gas.pressure / (constants::gasConstant * gas.temperature);
}

}  // namespace lampblack::coupling
