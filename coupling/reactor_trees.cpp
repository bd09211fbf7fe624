#include "coupling/reactor_trees.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "chemistry/mechanism/known_species.hpp"
#include "core/constants.hpp"
#include "core/errors.hpp"

namespace lampblack::coupling {
namespace {

double atomsOf(const TreeComponent& component, const std::string& element) {
  double sum = 0;
  for (const auto& [name, atoms] : component.elements)
    if (name == element) sum += atoms;
  return sum;
}

// Pairs drawn for the rate of coagulation: it has an error of a hundredth of the kernel's deviation.
constexpr std::size_t pairsForRate = 10000;

}  // namespace

ReactorTrees::ReactorTrees(const Mechanism& mechanism, const TreeOptions& options, GasViscosity viscosity,
                           std::span<const TreeStart> start)
    : material_(options.material),
      functionals_(options.material),
      events_(treeEvents(options.material)),
      viscosity_(viscosity),
      population_(makeTreePopulation(options)) {
  species_ = knownSpecies(mechanism, material_.species(), fmt::format("particles of {} need", material_.name));
  for (std::size_t e = 0; e < mechanism.numElements(); ++e)
    for (const TreeComponent& component : material_.components)
      if (atomsOf(component, mechanism.elementName(e)) != 0) {
        elements_.push_back(mechanism.elementName(e));
        break;
      }
  for (const TreeComponent& component : material_.components)
    for (const auto& [element, atoms] : component.elements)
      if (atoms != 0 && !mechanism.findElement(element))
        throw InputError(
            fmt::format("particles of {} have the element {}, which the mechanism lacks", material_.name, element));
  for (const std::size_t k : species_) {
    perMole_.emplace_back();
    for (const std::string& name : elements_) {
      const std::size_t e = mechanism.elementIndex(name);
      perMole_.back().push_back(mechanism.atoms(k, e) * mechanism.atomicWeight(e));
    }
  }
  if (const SiteReactions* reactions = material_.sites()) requireAtoms(mechanism, *reactions);
  if (!start.empty()) population_->fill(start);
}

// Atoms of units and of the gas's species are the same before and after each process.
void ReactorTrees::requireAtoms(const Mechanism& mechanism, const SiteReactions& reactions) const {
  const auto require = [&](const char* process, double precursors, double products, const TreeUnits& gained) {
    for (std::size_t e = 0; e < mechanism.numElements(); ++e) {
      const std::string& name = mechanism.elementName(e);
      double sum = precursors * mechanism.atoms(species_[0], e) - products * mechanism.atoms(species_[1], e);
      for (std::size_t c = 0; c < material_.components.size(); ++c)
        sum -= gained[c] * atomsOf(material_.components[c], name);
      if (std::abs(sum) > 1e-9)
        throw InputError(
            fmt::format("particles of {}: {} makes {:g} atoms of {} of nothing", material_.name, process, -sum, name));
    }
  };
  TreeUnits bridge{};
  bridge[reactions.site] -= 2;
  bridge[reactions.bridge] += 1;
  require("inception", reactions.nucleusPrecursors, reactions.nucleusProducts, reactions.nucleus);
  require("surface reaction", 1, reactions.growthProducts, reactions.growth);
  require("the reaction of two sites", 0, 1, bridge);
}

SplitParticles::Exchange ReactorTrees::advance(const ParticleGas& gas, double dt) {
  population_->advance(gas, dt);
  return takeExchange();
}

SplitParticles::Exchange ReactorTrees::advanceAndApplyDeferred(const ParticleGas& gas, double dt) {
  population_->advance(gas, dt);
  population_->applyDeferred();
  return takeExchange();
}

SplitParticles::Exchange ReactorTrees::takeExchange() {
  const TreeExchange taken = population_->takeExchange();
  for (const TreeEvent& event : events_) total_.*event.number += taken.*event.number;
  Exchange exchange{{taken.gas.begin(), taken.gas.begin() + static_cast<std::ptrdiff_t>(species_.size())},
                    std::vector<double>(elements_.size(), 0.0)};
  for (std::size_t k = 0; k < species_.size(); ++k)
    for (std::size_t e = 0; e < elements_.size(); ++e) exchange.elements[e] -= taken.gas[k] * perMole_[k][e];
  return exchange;
}

std::optional<double> ReactorTrees::rateOf(std::size_t i, const ParticleGas& gas) const {
  const SiteReactions* reactions = material_.sites();
  if (i != 0 || reactions == nullptr) return std::nullopt;
  const TreeRates rates = population_->rates(gas, 0);
  return -(reactions->nucleusPrecursors * rates.inceptions + rates.reactions) / constants::avogadro;
}

void ReactorTrees::dilute(double factor) {
  if (factor != 1) population_->dilute(factor);
}

std::vector<double> ReactorTrees::content() const {
  population_->applyDeferred();
  const std::vector<double> packed = population_->pack();
  const std::span<const double> rows = treeRows.of(packed);
  return {rows.begin(), rows.end()};
}

void ReactorTrees::join(std::span<const double> content, double share) {
  population_->join(content, share);
}

std::unique_ptr<SplitParticles::State> ReactorTrees::save() const {
  auto saved = std::make_unique<Saved>();
  saved->population = population_->save();
  saved->total = total_;
  return saved;
}

void ReactorTrees::restore(const State& state) {
  const auto& saved = dynamic_cast<const Saved&>(state);
  population_->restore(*saved.population);
  total_ = saved.total;
}

bool ReactorTrees::idle(const ParticleGas& gas) const {
  return population_->size() == 0 && !canBeBorn(gas);
}

std::vector<ReactorPopulation::Column> ReactorTrees::columns() const {
  const std::string name = material_.name + "_";
  std::vector<Column> all{
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
    const Column& ratio = functionals_.column(TreeFunctionals::elementRatio);
    all.push_back({name + ratio.name, ratio.unit, "mean over particles: " + ratio.description});
  }
  for (const TreeComponent& c : material_.components)
    all.push_back({name + c.name, "1/m^3", "units of " + c.name + " in all particles"});
  for (const TreeEvent& event : events_)
    all.push_back({name + event.plural, "1/m^3", std::string(event.description) + ", since the beginning"});
  for (const TreeEvent& event : events_) {
    if (event.singular == nullptr) continue;
    all.push_back({name + event.singular + "_rate", "1/m^3/s", std::string(event.description) + ", by the law"});
    all.push_back({name + event.singular + "_events", "1",
                   std::string(event.description) + ", in the sample since the beginning"});
  }
  all.push_back({name + "numerical_particles", "1", "numerical particles of the sample"});
  return all;
}

void ReactorTrees::applyDeferred() {
  population_->applyDeferred();
}

std::vector<double> ReactorTrees::values(const ParticleGas& gas) const {
  const TreeTotals t = population_->totals();
  double massCubed = 0, mobility = 0, ratios = 0;
  population_->forEachTree([&](const Tree& tree, double number) {
    const double mass = tree.head().volume * material_.density;
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
                t.units.begin() + static_cast<std::ptrdiff_t>(material_.components.size()));
  const TreeRates rates = population_->rates(gas, pairsForRate);
  const TreeCounters counters = population_->counters();
  for (const TreeEvent& event : events_) values.push_back(total_.*event.number);
  for (const TreeEvent& event : events_)
    if (event.singular != nullptr)
      values.insert(values.end(), {rates.*event.rate, static_cast<double>(counters.*event.count)});
  values.push_back(static_cast<double>(population_->size()));
  return values;
}

std::vector<std::pair<std::string, double>> ReactorTrees::counts() const {
  const TreeCounters c = population_->counters();
  const auto value = [](std::uint64_t count) { return static_cast<double>(count); };
  std::vector<std::pair<std::string, double>> all{
      {"inceptions", value(c.inceptions)},
      {"coagulations", value(c.coagulations)},
      {"fictitious_collisions", value(c.fictitious)},
      {"collision_pairs", value(c.coagulations + c.fictitious)},
      {"collision_pairs_above_majorant", 0.0},  // the first ends the run (checkBound)
      {"fused_primaries", value(c.fused)},
      {"doublings", value(c.doublings)},
      {"removals", value(c.removals)},
      {"samples_never_full", population_->size() > 0 && !population_->wasFull() ? 1.0 : 0.0},
      {"splitting_steps", value(c.splitSteps)}};
  if (material_.sites() != nullptr) {
    all.emplace_back("surface_reactions", value(c.reactions));
    all.emplace_back("condensations", value(c.condensations));
    all.emplace_back("condensations_bounded", value(c.limited));
    all.emplace_back("sintering_without_sites", value(c.withoutSites));
  } else {
    all.emplace_back("burnt_particles", value(c.burnt));
    all.emplace_back("broken_particles", value(c.broken));
    if (material_.soot()->fragmentation.active) all.emplace_back("fragmentations", value(c.fragmentations));
  }
  all.emplace_back("population_bytes", static_cast<double>(population_->bytes()));
  return all;
}

}  // namespace lampblack::coupling
