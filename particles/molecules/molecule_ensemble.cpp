#include "particles/molecules/molecule_ensemble.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "chemistry/mechanism/known_species.hpp"
#include "core/errors.hpp"
#include "particles/models/soot_model.hpp"
#include "particles/molecules/molecule_population.hpp"
#include "particles/molecules/packed_molecules.hpp"

namespace lampblack::particles {
namespace {

// With the weights of the mechanism. The precursor has to be the molecule.
MoleculeOptions ofMechanism(const Mechanism& mechanism, MoleculeOptions options) {
  const Molecule molecule(options.rings);
  const std::size_t k = knownSpecies(mechanism, options.precursor, "particles of molecules need");
  for (std::size_t e = 0; e < mechanism.numElements(); ++e) {
    const std::string& name = mechanism.elementName(e);
    const auto atoms = static_cast<double>(name == "C" ? molecule.carbon() : name == "H" ? molecule.hydrogen() : 0);
    if (mechanism.atoms(k, e) != atoms)
      throw InputError(
          fmt::format("{} has {:g} atoms of {}, the molecule it is taken for {:g}; expected a molecule of "
                      "this species, or the species of this molecule",
                      mechanism.speciesName(k), mechanism.atoms(k, e), name, atoms));
  }
  options.carbonWeight = mechanism.atomicWeight(mechanism.elementIndex("C"));
  options.hydrogenWeight = mechanism.atomicWeight(mechanism.elementIndex("H"));
  return options;
}

// Behind those of trees.
enum Which : std::size_t { moleculesOf, ringsOf, bandGapOf };

}  // namespace

MoleculeEnsemble::MoleculeEnsemble(const Mechanism& mechanism, const MoleculeOptions& options)
    : StochasticPopulation({"soot",
                            knownSpecies(mechanism, options.species(), "particles of molecules need"),
                            {"C", "H"},
                            {SootAggregate(options.density, SootShape::aggregates), moleculeRows}}),
      options_(ofMechanism(mechanism, options)),
      ofTrees_(options_.material()),
      functionals_(ofTrees_.all()),
      molecules_(std::make_unique<MoleculePopulation>(options_)) {
  using Use = ParticleFunctional::Use;
  functionals_.push_back({{"molecules", "1", "molecules in a particle"}, Use::plain, true});
  functionals_.push_back({{"molecule_rings", "1", "mean number of rings of the particle's molecules"}, Use::plain});
  if (!options_.bandGaps.empty())
    functionals_.push_back({{"band_gap", "eV", "optical band gap of the particle's largest molecule"}, Use::plain});
}

MoleculeEnsemble::~MoleculeEnsemble() = default;

double MoleculeEnsemble::absorption(double temperature, double volumeFraction) const {
  return sootAbsorption(temperature, volumeFraction);
}

bool MoleculeEnsemble::hasPrecursors(const ParticleGas& gas) const {
  return gas.concentrations[MoleculeOptions::precursorAt] >=
         1e-15 * gas.pressure / (constants::gasConstant * gas.temperature);
}

void MoleculeEnsemble::advance(const ParticleGas& gas, double dt) {
  molecules_->advance(gas, dt);
}
void MoleculeEnsemble::dilute(double factor) {
  molecules_->dilute(factor);
}
std::size_t MoleculeEnsemble::size() const {
  return molecules_->size();
}
std::uint64_t MoleculeEnsemble::removals() const {
  return molecules_->counters().removals;
}
double MoleculeEnsemble::cost() const {
  return molecules_->cost();
}
std::vector<double> MoleculeEnsemble::pack() const {
  return molecules_->pack();
}

std::vector<double> MoleculeEnsemble::kilograms(double carbon, double hydrogen) const {
  return {carbon * options_.carbonWeight / constants::avogadro,
          hydrogen * options_.hydrogenWeight / constants::avogadro};
}

void MoleculeEnsemble::addContent(std::vector<double>& elements) const {
  molecules_->forEach([&](const MoleculeParticle& p, double number) {
    const std::vector<double> mass = kilograms(number * p.carbon(), number * p.hydrogen());
    for (std::size_t e = 0; e < elements.size(); ++e) elements[e] += mass[e];
  });
}

StochasticPopulation::Exchange MoleculeEnsemble::takeExchange() {
  taken_ = molecules_->takeExchange();
  for (const auto amount : {&MoleculeExchange::inceptions, &MoleculeExchange::coagulations,
                            &MoleculeExchange::condensations, &MoleculeExchange::came, &MoleculeExchange::went})
    total_.*amount += taken_.*amount;
  for (std::size_t k = 0; k < pahProcessCount; ++k) {
    total_.events[k] += taken_.events[k];
    total_.voids[k] += taken_.voids[k];
  }
  Exchange exchange{{taken_.gas.begin(), taken_.gas.end()}, kilograms(taken_.carbon, taken_.hydrogen)};
  for (std::size_t e = 0; e < gained_.size(); ++e) gained_[e] += exchange.elements[e];
  return exchange;
}

std::vector<double> MoleculeEnsemble::resampled() const {
  std::vector<double> came(elements().size());
  addContent(came);
  for (std::size_t e = 0; e < came.size(); ++e) came[e] -= before_[e] + gained_[e];
  return came;
}

void MoleculeEnsemble::unpack(std::span<const double> state) {
  molecules_->unpack(state);
  before_.assign(elements().size(), 0.0);
  gained_.assign(elements().size(), 0.0);
  addContent(before_);
}

std::vector<double> MoleculeEnsemble::content() {
  const std::vector<double> packed = molecules_->pack();
  const std::span<const double> all = moleculeRows.of(packed);
  return {all.begin(), all.end()};
}

void MoleculeEnsemble::join(std::span<const double> rows, double share) {
  moleculeRows.forEach(rows, [&](const double* row) {
    before_[0] += share * row[packedNumberAt] * row[0];
    before_[1] += share * row[packedNumberAt] * row[1];
  });
  molecules_->join(rows, share);
}

struct MoleculeEnsemble::Saved final : State {
  Saved(MoleculePopulation::State state, const MoleculeExchange& sum) : molecules(std::move(state)), total(sum) {}
  MoleculePopulation::State molecules;
  MoleculeExchange total;
};

std::unique_ptr<StochasticPopulation::State> MoleculeEnsemble::save() const {
  return std::make_unique<Saved>(molecules_->save(), total_);
}

void MoleculeEnsemble::restore(const State& state) {
  const auto& saved = dynamic_cast<const Saved&>(state);
  molecules_->restore(saved.molecules);
  total_ = saved.total;
}

void MoleculeEnsemble::addAmounts(const double* row, double number, std::span<double> amounts) const {
  const AmountsOfParticles at{elements().size()};
  const TreeHead tree = MoleculeRow::treeOf(row);
  amounts[AmountsOfParticles::number] += number;
  amounts[at.element(0)] += number * row[0];
  amounts[at.element(1)] += number * row[1];
  amounts[at.primaries()] += number * tree.count;
  amounts[at.surface()] += number * tree.surface;
  amounts[at.diameters()] += number * sizes().mobilityDiameter(row);
}

double MoleculeEnsemble::functional(std::size_t which, const double* row) const {
  const MoleculeRow fixed = MoleculeRow::of(row);
  if (which == TreeFunctionals::collisionDiameter) return fixed.collision;
  if (which < ofTrees_.size()) return ofTrees_.of(MoleculeRow::treeOf(row), which);
  switch (which - ofTrees_.size()) {
    case moleculesOf:
      return fixed.molecules;
    case ringsOf:
      return fixed.rings / fixed.molecules;
    case bandGapOf:
      return options_.bandGap(fixed.mostCarbon);
    default:
      throw std::logic_error("particles of molecules have no such functional");
  }
}

void MoleculeEnsemble::forEachRow(const std::function<void(const double* row)>& f) const {
  std::vector<double> row;
  molecules_->forEach([&](const MoleculeParticle& p, double number) {
    row.clear();
    packFixedPart(p, number, molecules_->type(), row);
    f(row.data());
  });
}

std::vector<double> MoleculeEnsemble::primarySizes(const SizeBins& bins) const {
  std::vector<double> density(bins.count, 0.0);
  molecules_->forEach([&](const MoleculeParticle& p, double number) {
    for (const TreePrimary& primary : p.tree.primaries())
      if (const std::size_t bin = bins.of(primary.diameter); bin < bins.count) density[bin] += number / bins.width();
  });
  return density;
}

}  // namespace lampblack::particles
