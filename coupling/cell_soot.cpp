#include "coupling/cell_soot.hpp"

#include "coupling/ensemble_species.hpp"
#include "particles/ensemble/packed_ensemble.hpp"
#include "particles/models/soot_model.hpp"
#include "particles/population/monte_carlo/initial_sample.hpp"

namespace lampblack::coupling {
namespace {

constexpr std::uint32_t startStream = 0x53544152;

}  // namespace

CellSoot::CellSoot(const Mechanism& mechanism, const EnsembleOptions& options)
    : CellParticles("soot", {"C", "H"}, mechanism, indicesOfSootSpecies(mechanism, options.soot),
                    {sootAggregate(options), {packedHead, false}}),
      engine_(makeEnsemble(options)) {
  blank_ = engine_->pack();
}

void CellSoot::addAmounts(const double* row, double times, std::span<double> amounts) const {
  GivenParticle particle = particleAt(row);
  particle.number = times;
  Ensemble::Totals t;
  addTo(t, sizes().type, particle);
  amounts[number] += t.number;
  amounts[carbon] += t.carbon;
  amounts[hydrogen] += t.hydrogen;
  amounts[primaries] += t.primaries;
  amounts[surface] += t.surface;
  amounts[diameters] += t.diameters;
}

double CellSoot::absorption(double temperature, double volumeFraction) const {
  return sootAbsorption(temperature, volumeFraction);
}

bool CellSoot::hasPrecursors(const ParticleGas& gas) const {
  return particles::hasPrecursors(gas);
}

void CellSoot::join(std::span<const double> rows) {
  std::vector<GivenParticle> arrived;
  this->rows().forEach(rows, [&](const double* row) { arrived.push_back(particleAt(row)); });
  engine_->join(arrived, 1.0);
}

CellParticles::Change CellSoot::advance(const ParticleGas& gas, double dt) {
  engine_->advance(gas, 0.0, dt);
  const EnsembleExchange taken = engine_->takeExchange();
  return {{taken.gas.begin(), taken.gas.begin() + static_cast<std::ptrdiff_t>(species().size())},
          {taken.carbon, taken.hydrogen},
          {taken.resampledCarbon, taken.resampledHydrogen}};
}

std::vector<double> CellSoot::packed(std::span<const GivenParticle> population, std::uint64_t cell) const {
  EnsembleOptions own = engine_->options();
  own.owner = cell;
  const auto ensemble = makeEnsemble(own);
  ensemble->initialise(population);
  return ensemble->pack();
}

std::vector<double> CellSoot::packed(const InitialPopulation& sizes, std::uint64_t cell) const {
  const EnsembleOptions& options = engine_->options();
  RandomStream random(options.seed, cell, startStream);
  const InitialWeights weights =
      options.method == EnsembleMethod::dsmc ? InitialWeights::equal : InitialWeights::moments;
  std::vector<GivenParticle> particles;
  for (const auto& [volume, weight] : initialParticles(sizes, options.particles, weights, random))
    particles.push_back({volume * options.soot.sootDensity, 0.0, 1.0, weight});
  return packed(particles, cell);
}

}  // namespace lampblack::coupling
