#include "particles/ensemble/soot_ensemble.hpp"

#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "core/packed_doubles.hpp"
#include "particles/ensemble/packed_ensemble.hpp"
#include "particles/models/soot_model.hpp"
#include "particles/population/monte_carlo/initial_sample.hpp"
#include "particles/soot/soot_steps.hpp"

namespace lampblack::particles {
namespace {

constexpr std::uint32_t startStream = 0x53544152;

std::vector<ProcessOf<EnsembleExchange>> sootProcesses(const SootModelOptions& soot) {
  using E = EnsembleExchange;
  const SpeciesExchanged dimers = exchangedByDimers(soot);
  return {{{{"nucleation_number", "1/m^3", "new particles"}, dimers}, &E::nucleatedNumber},
          {{{"oxidation_number", "1/m^3", "particles oxidised away"}}, &E::oxidisedNumber},
          {{{"nucleation", "kg/m^3", "soot mass from nucleation"}, dimers}, &E::nucleated},
          {{{"condensation", "kg/m^3", "soot mass from condensation"}, dimers}, &E::condensed},
          {{{"growth", "kg/m^3", "soot mass from surface growth"}, exchangedByGrowth()}, &E::grown},
          {{{"oxidation_O2", "kg/m^3", "soot mass lost by oxidation by O2"}, exchangedByO2()}, &E::oxidisedO2},
          {{{"oxidation_OH", "kg/m^3", "soot mass lost by oxidation by OH"}, exchangedByOH()}, &E::oxidisedOH},
          {{{"dilution_carbon", "kg/m^3", "carbon lost by the expansion of the gas"}}, &E::dilutedCarbon},
          {{{"resampled_carbon", "kg/m^3", "carbon of numerical particles that come and go, zero in the mean"}},
           &E::resampledCarbon}};
}

}  // namespace

SootEnsemble::SootEnsemble(const Mechanism& mechanism, EnsembleOptions options, const InitialPopulation& start)
    : StochasticPopulation({"soot",
                            indicesOfSootSpecies(mechanism, options.soot),
                            {"C", "H"},
                            {sootAggregate(options), {packedHead, false, options.method == EnsembleMethod::dsmc}}}),
      ensemble_(makeEnsemble(std::move(options))),
      processes_(sootProcesses(ensemble_->options().soot)) {
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
  taken_ = ensemble_->takeExchange();
  return {{taken_.gas.begin(), taken_.gas.begin() + static_cast<std::ptrdiff_t>(species().size())},
          {taken_.carbon, taken_.hydrogen}};
}

std::vector<std::size_t> SootEnsemble::pathSpecies() const {
  std::vector<std::size_t> places{SootSpecies::H, SootSpecies::OH, SootSpecies::O2, SootSpecies::C2H2};
  for (std::size_t k = SootSpecies::fixed; k < species().size(); ++k) places.push_back(k);
  return places;
}

std::vector<double> SootEnsemble::content() {
  std::vector<double> content;
  for (const GivenParticle& p : ensemble_->particles()) packDoubles(content, p);
  return content;
}

void SootEnsemble::join(std::span<const double> rows, double share) {
  std::vector<GivenParticle> particles(rows.size() / packedParticle);
  for (std::size_t k = 0; k < particles.size(); ++k) particles[k] = particleAt(&rows[k * packedParticle]);
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

void SootEnsemble::addAmountsOf(std::span<const double> of, std::span<double> amounts) const {
  constexpr std::size_t atATime = 64 * packedParticle;
  const SootAggregate& type = sizes().type;
  Ensemble::Totals t;
  for (; !of.empty(); of = of.subspan(std::min(atATime, of.size()))) {
    const std::span<const double> rows = of.first(std::min(atATime, of.size()));
    double diameters[atATime / packedParticle];
    for (std::size_t i = 0; i < rows.size(); i += packedParticle)
      diameters[i / packedParticle] = type.perVolume() * massAt(&rows[i]) / rows[i + 2];
    SootAggregate::takeRoots(diameters, rows.size() / packedParticle);
    for (std::size_t i = 0; i < rows.size(); i += packedParticle)
      addTo(t, particleAt(&rows[i]), diameters[i / packedParticle]);
  }
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
          {"soot_hydrogen", "kg/m^3", "hydrogen in particles"},
          {"soot_mass", "kg/m^3", "mass of all particles"},
          {"soot_mass_squared", "kg^2/m^3", "sum of the squared masses of particles"},
          {"soot_mass_cubed", "kg^3/m^3", "sum of the cubed masses of particles"},
          {"soot_primaries", "1", "primary particles in an aggregate, mean"},
          {"soot_coagulation_events", "1", "collisions of numerical particles since the beginning"}};
}

std::vector<double> SootEnsemble::values(const ParticleGas&) const {
  const Ensemble::Totals totals = ensemble_->totals();
  const double density = ensemble_->options().soot.sootDensity, fraction = totals.mass() / density;
  return {fraction,
          totals.number,
          totals.number > 0 ? std::cbrt(6 / constants::pi * fraction / totals.number) : 0.0,
          totals.meanDiameter(),
          ensemble_->geometricDeviation(),
          totals.surface,
          totals.carbon,
          totals.hydrogen,
          totals.mass(),
          density * density * ensemble_->moment(2),
          density * density * density * ensemble_->moment(3),
          totals.number > 0 ? totals.primaries / totals.number : 0.0,
          static_cast<double>(ensemble_->counters().coagulations)};
}

std::vector<std::pair<std::string, double>> SootEnsemble::counts() const {
  std::vector<std::pair<std::string, double>> all;
  for (const PopulationCounter& counter : populationCounters)
    all.emplace_back(counter.name, static_cast<double>(ensemble_->counters().*counter.value));
  return all;
}

std::vector<ParticleFunctional> SootEnsemble::functionals() const {
  return {{{"mobility_diameter", "m", "mobility diameter"}, ParticleFunctional::Use::size}};
}

void SootEnsemble::forEachRow(const std::function<void(const double* row)>& f) const {
  const std::vector<double> packed = ensemble_->pack();
  rows().forEach(rows().of(packed), f);
}

}  // namespace lampblack::particles
