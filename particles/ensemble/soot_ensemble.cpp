#include "particles/ensemble/soot_ensemble.hpp"

#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "core/packed_doubles.hpp"
#include "particles/ensemble/packed_ensemble.hpp"
#include "particles/models/soot_model.hpp"
#include "particles/population/monte_carlo/initial_sample.hpp"

namespace lampblack::particles {
namespace {

constexpr std::uint32_t startStream = 0x53544152;

}  // namespace

SootEnsemble::SootEnsemble(const Mechanism& mechanism, EnsembleOptions options, const InitialPopulation& start)
    : StochasticPopulation({"soot",
                            indicesOfSootSpecies(mechanism, options.soot),
                            {"C", "H"},
                            {sootAggregate(options), {packedHead, false}}}),
      ensemble_(makeEnsemble(std::move(options))),
      resampled_(elements().size()) {
  if (!(start.number > 0)) return;
  const EnsembleOptions& own = ensemble_->options();
  RandomStream random(own.seed, own.owner, startStream);
  const InitialWeights weights = own.method == EnsembleMethod::dsmc ? InitialWeights::equal : InitialWeights::moments;
  std::vector<GivenParticle> particles;
  for (const auto& [volume, weight] : initialParticles(start, own.particles, weights, random))
    particles.push_back({volume * own.soot.sootDensity, 0.0, 1.0, weight});
  ensemble_->initialise(particles);
}

double SootEnsemble::absorption(double temperature, double volumeFraction) const {
  return sootAbsorption(temperature, volumeFraction);
}

bool SootEnsemble::hasPrecursors(const ParticleGas& gas) const {
  return particles::hasPrecursors(gas);
}

StochasticPopulation::Exchange SootEnsemble::takeExchange() {
  const EnsembleExchange taken = ensemble_->takeExchange();
  resampled_ = {taken.resampledCarbon, taken.resampledHydrogen};
  return {{taken.gas.begin(), taken.gas.begin() + static_cast<std::ptrdiff_t>(species().size())},
          {taken.carbon, taken.hydrogen}};
}

std::vector<double> SootEnsemble::content() {
  std::vector<double> content;
  for (const GivenParticle& p : ensemble_->particles()) packDoubles(content, p);
  return content;
}

void SootEnsemble::join(std::span<const double> rows, double share) {
  std::vector<GivenParticle> particles;
  this->rows().forEach(rows, [&](const double* row) { particles.push_back(particleAt(row)); });
  ensemble_->join(particles, share);
}

void SootEnsemble::addAmounts(const double* row, double number, std::span<double> amounts) const {
  GivenParticle particle = particleAt(row);
  particle.number = number;
  Ensemble::Totals t;
  addTo(t, sizes().type, particle);
  std::size_t place = 0;
  for (const double amount : {t.number, t.carbon, t.hydrogen, t.primaries, t.surface, t.diameters})
    amounts[place++] += amount;
}

std::vector<Quantity> SootEnsemble::columns() const {
  return {{"soot_volume_fraction", "1", "particle volume per volume of gas"},
          {"soot_number_density", "1/m^3", "particles"},
          {"soot_mean_diameter", "m", "of the sphere of mean volume"},
          {"soot_mobility_diameter", "m", "mean mobility diameter"},
          {"soot_geometric_deviation", "1", "of the diameter of mobility, by number"},
          {"soot_surface_area", "m^2/m^3", "surface of all particles"},
          {"soot_carbon", "kg/m^3", "carbon in particles"},
          {"soot_hydrogen", "kg/m^3", "hydrogen in particles"}};
}

std::vector<double> SootEnsemble::values(const ParticleGas&) const {
  const Ensemble::Totals totals = ensemble_->totals();
  const double fraction = ensemble_->volumeFraction();
  return {fraction,
          totals.number,
          totals.number > 0 ? std::cbrt(6 / constants::pi * fraction / totals.number) : 0.0,
          totals.meanDiameter(),
          ensemble_->geometricDeviation(),
          totals.surface,
          totals.carbon,
          totals.hydrogen};
}

std::vector<ParticleFunctional> SootEnsemble::functionals() const {
  return {{{"mobility_diameter", "m", "mobility diameter"}, ParticleFunctional::Use::size}};
}

void SootEnsemble::forEachRow(const std::function<void(const double* row)>& f) const {
  const std::vector<double> packed = ensemble_->pack();
  rows().forEach(rows().of(packed), f);
}

}  // namespace lampblack::particles
