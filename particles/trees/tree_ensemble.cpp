#include "particles/trees/tree_ensemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chemistry/mechanism/known_species.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"
#include "particles/models/soot_model.hpp"
#include "particles/trees/packed_tree.hpp"
#include "particles/trees/tree_population.hpp"
#include "particles/trees/tree_shape.hpp"

namespace lampblack::particles {
namespace {

double atomsOf(const TreeComponent& component, const std::string& element) {
  double sum = 0;
  for (const auto& [name, atoms] : component.elements)
    if (name == element) sum += atoms;
  return sum;
}

// Pairs drawn for the rate of coagulation: it has an error of a hundredth of the kernel's deviation.
constexpr std::size_t pairsForRate = 10000;

// In the order of the mechanism.
std::vector<std::string> elementsOf(const Mechanism& mechanism, const TreeMaterial& material) {
  std::vector<std::string> elements;
  for (std::size_t e = 0; e < mechanism.numElements(); ++e)
    if (std::ranges::any_of(material.components, [&](const TreeComponent& component) {
          return atomsOf(component, mechanism.elementName(e)) != 0;
        }))
      elements.push_back(mechanism.elementName(e));
  for (const TreeComponent& component : material.components)
    for (const auto& [element, atoms] : component.elements)
      if (atoms != 0 && !mechanism.findElement(element))
        throw InputError(
            fmt::format("particles of {} have the element {}, which the mechanism lacks", material.name, element));
  return elements;
}

}  // namespace

TreeEnsemble::TreeEnsemble(const Mechanism& mechanism, const TreeOptions& options, std::span<const TreeStart> start)
    : StochasticPopulation({options.material.name,
                            knownSpecies(mechanism, options.material.species(),
                                         fmt::format("particles of {} need", options.material.name)),
                            elementsOf(mechanism, options.material),
                            {SootAggregate(options.material.density, SootShape::aggregates), treeRows}}),
      options_(options),
      functionals_(options.material),
      events_(treeEvents(options.material)),
      trees_(std::make_unique<TreePopulation>(options)),
      before_(elements().size()),
      gained_(elements().size()) {
  for (const std::size_t k : species()) {
    perMole_.emplace_back();
    for (const std::string& name : elements()) {
      const std::size_t e = mechanism.elementIndex(name);
      perMole_.back().push_back(mechanism.atoms(k, e) * mechanism.atomicWeight(e));
    }
  }
  for (const std::string& element : elements()) {
    TreeUnits& mass = elementMass_.emplace_back();
    for (std::size_t c = 0; c < options.material.components.size(); ++c)
      for (const auto& [name, atoms] : options.material.components[c].elements)
        if (name == element)
          mass[c] += atoms * mechanism.atomicWeight(mechanism.elementIndex(element)) / constants::avogadro;
  }
  if (const SiteReactions* reactions = options_.material.sites()) requireAtoms(mechanism, *reactions);
  if (!start.empty()) trees_->fill(start);
}

TreeEnsemble::~TreeEnsemble() = default;

void TreeEnsemble::advance(const ParticleGas& gas, double dt) {
  trees_->advance(gas, dt);
}

void TreeEnsemble::applyDeferred() {
  trees_->applyDeferred();
}

void TreeEnsemble::dilute(double factor) {
  trees_->dilute(factor);
}

std::size_t TreeEnsemble::size() const {
  return trees_->size();
}

std::uint64_t TreeEnsemble::removals() const {
  return trees_->counters().removals;
}

double TreeEnsemble::cost() const {
  return trees_->cost();
}

std::vector<double> TreeEnsemble::pack() const {
  return trees_->pack();
}

std::vector<double> TreeEnsemble::primarySizes(const SizeBins& bins) const {
  return trees_->primarySizes(bins);
}

// Atoms of units and of the gas's species are the same before and after each process.
void TreeEnsemble::requireAtoms(const Mechanism& mechanism, const SiteReactions& reactions) const {
  const auto require = [&](const char* process, double precursors, double products, const TreeUnits& gained) {
    for (std::size_t e = 0; e < mechanism.numElements(); ++e) {
      const std::string& name = mechanism.elementName(e);
      double sum = precursors * mechanism.atoms(species()[0], e) - products * mechanism.atoms(species()[1], e);
      for (std::size_t c = 0; c < options_.material.components.size(); ++c)
        sum -= gained[c] * atomsOf(options_.material.components[c], name);
      if (std::abs(sum) > 1e-9)
        throw InputError(fmt::format("particles of {}: {} makes {:g} atoms of {} of nothing", options_.material.name,
                                     process, -sum, name));
    }
  };
  TreeUnits bridge{};
  bridge[reactions.site] -= 2;
  bridge[reactions.bridge] += 1;
  require("inception", reactions.nucleusPrecursors, reactions.nucleusProducts, reactions.nucleus);
  require("surface reaction", 1, reactions.growthProducts, reactions.growth);
  require("the reaction of two sites", 0, 1, bridge);
}

void TreeEnsemble::addElements(const TreeUnits& units, double number, std::span<double> elements) const {
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (std::size_t c = 0; c < units.size(); ++c) elements[e] += number * units[c] * elementMass_[e][c];
}

void TreeEnsemble::addContent(std::span<double> elements) const {
  trees_->forEachTree([&](const Tree& tree, double number) { addElements(tree.head().units, number, elements); });
}

void TreeEnsemble::addAmounts(const double* row, double number, std::span<double> amounts) const {
  const AmountsOfParticles at{elements().size()};
  const TreeHead tree = headOfPackedTree(row);
  const bool isBySurface = options_.shape == TreeShape::surfaceVolume;
  amounts[AmountsOfParticles::number] += number;
  addElements(tree.units, number, amounts.subspan(at.element(0), at.held));
  amounts[at.primaries()] += number * (isBySurface ? particleAt(row).primaries : tree.count);
  amounts[at.surface()] += number * tree.surface;
  amounts[at.diameters()] += number * sizes().mobilityDiameter(row);
}

double TreeEnsemble::absorption(double temperature, double volumeFraction) const {
  return options_.material.soot() != nullptr ? sootAbsorption(temperature, volumeFraction) : 0.0;
}

double TreeEnsemble::functional(std::size_t which, const double* row) const {
  return functionals_.of(headOfPackedTree(row), which);
}

void TreeEnsemble::forEachRow(const std::function<void(const double* row)>& f) const {
  std::vector<double> row;
  trees_->forEachTree([&](const Tree& tree, double number) {
    row.clear();
    packSums(tree, number, options_.material, row);
    f(row.data());
  });
}

StochasticPopulation::Exchange TreeEnsemble::takeExchange() {
  taken_ = trees_->takeExchange();
  for (const TreeEvent& event : events_) total_.*event.amount += taken_.*event.amount;
  Exchange exchange{{taken_.gas.begin(), taken_.gas.begin() + static_cast<std::ptrdiff_t>(species().size())},
                    std::vector<double>(elements().size(), 0.0)};
  for (std::size_t k = 0; k < species().size(); ++k)
    for (std::size_t e = 0; e < elements().size(); ++e) exchange.elements[e] -= taken_.gas[k] * perMole_[k][e];
  for (std::size_t e = 0; e < elements().size(); ++e) gained_[e] += exchange.elements[e];
  return exchange;
}

std::vector<double> TreeEnsemble::resampled() const {
  std::vector<double> came(elements().size());
  addContent(came);
  for (std::size_t e = 0; e < came.size(); ++e) came[e] -= before_[e] + gained_[e];
  return came;
}

void TreeEnsemble::unpack(std::span<const double> state) {
  trees_->unpack(state);
  before_.assign(elements().size(), 0.0);
  gained_.assign(elements().size(), 0.0);
  addContent(before_);
}

std::optional<double> TreeEnsemble::rateOf(std::size_t i, const ParticleGas& gas) const {
  const SiteReactions* reactions = options_.material.sites();
  if (i != 0 || reactions == nullptr) return std::nullopt;
  const TreeRates rates = trees_->rates(gas, 0);
  return -(reactions->nucleusPrecursors * rates.inceptions + rates.reactions) / constants::avogadro;
}

std::vector<double> TreeEnsemble::content() {
  trees_->applyDeferred();
  const std::vector<double> packed = trees_->pack();
  const std::span<const double> rows = treeRows.of(packed);
  return {rows.begin(), rows.end()};
}

void TreeEnsemble::join(std::span<const double> rows, double share) {
  treeRows.forEach(
      rows, [&](const double* row) { addElements(headOfPackedTree(row).units, share * row[packedNumberAt], before_); });
  trees_->join(rows, share);
}

struct TreeEnsemble::Saved final : State {
  Saved(TreePopulation::State state, const TreeExchange& sum) : trees(std::move(state)), total(sum) {}
  TreePopulation::State trees;
  TreeExchange total;
};

std::unique_ptr<StochasticPopulation::State> TreeEnsemble::save() const {
  return std::make_unique<Saved>(trees_->save(), total_);
}

void TreeEnsemble::restore(const State& state) {
  const auto& saved = dynamic_cast<const Saved&>(state);
  trees_->restore(saved.trees);
  total_ = saved.total;
}

std::vector<Quantity> TreeEnsemble::columns() const {
  const std::string name = options_.material.name + "_";
  std::vector<Quantity> all{
      {name + "volume_fraction", "1", "particle volume per volume of gas"},
      {name + "number_density", "1/m^3", "particles, the zeroth moment"},
      {name + "mean_diameter", "m", "of the sphere of mean volume"},
      {name + "sphere_diameter", "m", "mean diameter of the spheres of the particles' volumes"},
      {name + "collision_diameter", "m", "mean diameter of collision"},
      {name + "collision_deviation", "1", "geometric deviation of the diameter of collision, by number"},
      {name + "surface_area", "m^2/m^3", "surface of all particles"},
      {name + "mass", "kg/m^3", "mass of all particles"},
      {name + "mass_squared", "kg^2/m^3", "sum of the squared masses of particles"},
      {name + "mass_cubed", "kg^3/m^3", "sum of the cubed masses of particles"},
      {name + "primaries", "1", "primary particles in a particle, mean"},
      {name + "primary_diameter", "m", "mean over particles of the mean diameter of their primaries"},
      {name + "primary_deviation", "1", "geometric deviation of the mean primary diameters of particles, by number"},
      {name + "sintering_level", "1", "mean over particles of their mean sintering level; of one primary 1"},
      {name + "sintering_rate", "m^2/m^3/s", "surface that goes by sintering"},
      {name + "largest", "1", "primaries of the particle that has most of them"},
      {name + "mobility_diameter", "m", "mean diameter of mobility, that of soot's aggregates"}};
  if (functionals_.hasRatio()) {
    const Quantity& ratio = functionals_.all()[TreeFunctionals::elementRatio];
    all.push_back({name + ratio.name, ratio.unit, "mean over particles: " + ratio.description});
  }
  for (const TreeComponent& c : options_.material.components)
    all.push_back({name + c.name, "1/m^3", "units of " + c.name + " in all particles"});
  for (const TreeEvent& event : events_)
    all.push_back({name + event.name, event.unit, event.description + ", since the beginning"});
  for (const TreeEvent& event : events_) {
    if (event.singular == nullptr) continue;
    all.push_back({name + event.singular + "_rate", event.unit + "/s", event.description + ", by the law"});
    all.push_back({name + event.singular + "_events", "1", event.description + ", in the sample since the beginning"});
  }
  all.push_back({name + "numerical_particles", "1", "numerical particles of the sample"});
  return all;
}

std::vector<double> TreeEnsemble::values(const ParticleGas& gas) const {
  const TreeTotals t = trees_->totals();
  double massCubed = 0, mobility = 0, ratios = 0;
  trees_->forEachTree([&](const Tree& tree, double number) {
    const double mass = tree.head().volume * options_.material.density;
    massCubed += number * mass * mass * mass;
    mobility += number * functionals_.of(tree.head(), TreeFunctionals::mobilityDiameter);
    if (functionals_.hasRatio()) ratios += number * functionals_.of(tree.head(), TreeFunctionals::elementRatio);
  });
  std::vector<double> values{t.volume,
                             t.number,
                             t.number > 0 ? sphereDiameter(t.volume / t.number) : 0.0,
                             t.sphereDiameter,
                             t.collisionDiameter,
                             t.collisionDeviation,
                             t.surface,
                             t.mass,
                             t.massSquared,
                             massCubed,
                             t.number > 0 ? t.primaries / t.number : 0.0,
                             t.primaryDiameter,
                             t.primaryDeviation,
                             t.sinteringLevel,
                             t.sinteringRate,
                             static_cast<double>(t.largest),
                             t.number > 0 ? mobility / t.number : 0.0};
  if (functionals_.hasRatio()) values.push_back(t.number > 0 ? ratios / t.number : 0.0);
  values.insert(values.end(), t.units.begin(),
                t.units.begin() + static_cast<std::ptrdiff_t>(options_.material.components.size()));
  const TreeRates rates = trees_->rates(gas, pairsForRate);
  const TreeCounters counters = trees_->counters();
  for (const TreeEvent& event : events_) values.push_back(total_.*event.amount);
  for (const TreeEvent& event : events_)
    if (event.singular != nullptr)
      values.insert(values.end(), {rates.*event.rate, static_cast<double>(counters.*event.count)});
  values.push_back(static_cast<double>(trees_->size()));
  return values;
}

std::vector<std::pair<std::string, double>> TreeEnsemble::counts() const {
  const TreeCounters c = trees_->counters();
  const auto value = [](std::uint64_t count) { return static_cast<double>(count); };
  std::vector<std::pair<std::string, double>> all;
  for (const TreeEvent& event : events_)
    if (event.count != nullptr) all.emplace_back(event.name, value(c.*event.count));
  const auto add = [&](std::initializer_list<std::pair<std::string, double>> more) { all.insert(all.end(), more); };
  if (options_.material.sites() != nullptr)
    add({{"condensations_bounded", value(c.limited)}, {"sintering_without_sites", value(c.withoutSites)}});
  add({{"fictitious_collisions", value(c.fictitious)},
       {"collision_pairs", value(c.coagulations + c.fictitious)},
       {"collision_pairs_above_majorant", 0.0},  // the first ends the run (checkBound)
       {"fused_primaries", value(c.fused)},
       {"doublings", value(c.doublings)},
       {"removals", value(c.removals)},
       {"samples_never_full", trees_->size() > 0 && !trees_->wasFull() ? 1.0 : 0.0},
       {"split_steps", value(c.splitSteps)},
       {"trees_bytes", static_cast<double>(trees_->bytes())}});
  return all;
}

}  // namespace lampblack::particles
