#include "particles/trees/tree_population.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "particles/gas/soot_gas.hpp"
#include "particles/population/engine/coagulating_sample.hpp"
#include "particles/population/engine/event_loop.hpp"
#include "particles/population/engine/jumps.hpp"
#include "particles/population/engine/split_step.hpp"
#include "particles/population/monte_carlo/initial_sample.hpp"

namespace lampblack::particles {

namespace {

std::variant<TreeSites, TreeSoot, TreeGiven> reactionsOf(const PrimaryTrees& type) {
  if (type.material().soot() != nullptr) return TreeSoot(type);
  if (type.material().isGiven()) return TreeGiven(type);
  return TreeSites(type);
}

const TreeOptions& checkedTrees(const TreeOptions& options) {
  requireMaterial(options.material);
  if (options.shape == TreeShape::surfaceVolume && options.material.sites() == nullptr)
    throw InputError("particles: only materials with sites are there by volume and surface");
  if (options.material.isGiven() && options.shape != TreeShape::spheres)
    throw InputError("particles: only spheres in space have births and growth that are given");
  if (options.particles < 8) throw InputError("particles: at least 8 numerical particles are needed");
  if (!(options.splitTolerance > 0) || !(options.splitTolerance <= 1) || !(options.fullAt > 0))
    throw InputError(
        "particles: the split tolerance needs to be in (0, 1], the number density of a full sample positive");
  if (!(options.sinteringTolerance >= 0) || !(options.sinteringTolerance <= 0.1))
    throw InputError("particles: the tolerance of sintering needs to be in [0, 0.1]");
  return options;
}

}  // namespace

TreePopulation::TreePopulation(const TreeOptions& options)
    : options_(checkedTrees(options)),
      type_(options.material, options.size, options.shape, options.sphereTolerance),
      random_(options.seed, options.owner, treeStream),
      method_(type_, modelOfSample(options), InitialPopulation{}, monteCarloOfSample(options), random_),
      sintering_(type_, options.sinteringTolerance),
      reactions_(reactionsOf(type_)) {
  type_.setSintering([this](Tree& tree, double time) {
    TreeSintering::Changes changes;
    sintering_.advance(tree, time, changes);
    record(changes);
  });
}

void TreePopulation::record(const TreeSintering::Changes& changes) {
  std::visit([&](auto& reactions) { reactions.recordSintering(method_.weight(), changes.bridges, exchange_); },
             reactions_);
  counters_.fused += changes.fused;
  counters_.withoutSites += changes.limited;
}

void TreePopulation::fill(std::span<const TreeStart> starts) {
  const auto& material = options_.material;
  std::vector<InitialPopulation> modes;
  for (const auto& [units, number, sizes] : starts) {
    for (const double amount : units)
      if (!(amount >= 0))
        throw InputError("particles: an initial particle may not have less than nothing of a component");
    const bool hasSizes = sizes.distribution != InitialPopulation::Distribution::none;
    if (!(material.volume(units) > 0) || !((hasSizes ? sizes.number : number) > 0))
      throw InputError("particles: an initial particle needs mass and a number");
    if (sizes.distribution == InitialPopulation::Distribution::modes)
      throw std::logic_error("TreePopulation: the modes of a start are starts of their own");
    modes.push_back(
        hasSizes ? sizes
                 : InitialPopulation{InitialPopulation::Distribution::monodisperse, number, material.volume(units)});
  }
  const InitialPopulation all = sumOf(modes);
  std::vector<Tree> trees;
  for (const auto& [volume, mode] : initialMembers(all, options_.particles, random_)) {
    TreeUnits units = starts[mode].units;
    const double factor = volume / material.volume(units);
    for (double& amount : units) amount *= factor;
    trees.push_back(type_.make(units));
  }
  method_.replace(trees, all.number / static_cast<double>(options_.particles), random_);
  births_.startAfresh();
  exchange_ = {};
}

void TreePopulation::fill(std::span<const TreeUnits> particles, double number) {
  std::vector<Tree> trees;
  for (const TreeUnits& units : particles) trees.push_back(type_.make(units));
  method_.replace(trees, number / static_cast<double>(trees.size()), random_);
  births_.startAfresh();
  exchange_ = {};
}

void TreePopulation::setSources(const GivenSources& sources) {
  if (!(sources.births >= 0) || !(sources.growth >= 0) || (sources.births > 0 && !(sources.nucleus > 0)))
    throw InputError("particles: births and growth may not be negative, and what is born needs a volume");
  std::get<TreeGiven>(reactions_).setSources(sources);
}

template <class Reactions>
typename Reactions::Sums TreePopulation::sums(const Reactions& reactions) const {
  typename Reactions::Sums all;
  method_.forEachParticle([&](const Tree& p, double weight) { reactions.add(all, p.head(), weight); });
  return all;
}
template TreeSites::Sums TreePopulation::sums(const TreeSites&) const;
template TreeSoot::Sums TreePopulation::sums(const TreeSoot&) const;
template TreeGiven::Sums TreePopulation::sums(const TreeGiven&) const;

void TreePopulation::advance(const ParticleGas& gas, double dt) {
  if (!(dt > 0)) return;
  requirePhysical(gas, "particles");
  CollisionKernelOptions kernel = options_.kernel;
  kernel.gas = gas;
  const bool isNew = !kernel_ || kernel_->options().gas.temperature != gas.temperature ||
                     kernel_->options().gas.pressure != gas.pressure ||
                     std::abs(kernel_->options().gas.viscosity / gas.viscosity - 1) > 1e-12;
  if (isNew) {
    kernel_.emplace(kernel);
    if (options_.coagulation) method_.setKernel(kernel);
  }
  sintering_.setTemperature(gas.temperature);
  if (size() == 0) {
    method_.startAfresh(options_.fullAt / static_cast<double>(options_.particles));
    births_.startAfresh();
  }
  cost_ = 0;
  const PopulationCounters before = method_.counters();
  std::visit(
      [&](auto& reactions) {
        reactions.setGas(gas, *kernel_);
        if (const TreeUnits nucleus = reactions.nucleus(); options_.material.volume(nucleus) > 0)
          method_.setNucleus(type_.make(nucleus));
        march(reactions, dt);
      },
      reactions_);
  const PopulationCounters& now = method_.counters();
  cost_ += static_cast<double>(now.events() + now.fictitious - before.events() - before.fictitious);
}

template <class Reactions>
void TreePopulation::march(Reactions& reactions, double dt) {
  const CollisionKernel* kernel = options_.coagulation ? &*kernel_ : nullptr;
  typename Reactions::Sums now;
  const auto length = [&](double remaining) {
    now = sums(reactions);
    cost_ += static_cast<double>(size());
    return reactions.step(now, kernel, options_.splitTolerance, remaining);
  };
  const auto update = [&] {
    if constexpr (Reactions::dependsOnSums) now = sums(reactions);
  };
  inSteps(dt, length, [&](double step) {
    splitStep(
        step, [&](double time) { jump(reactions, now, time); },
        [&](double time) {
          update();
          change(reactions, now, time);
          update();
        });
    ++method_.counters().splitSteps;
  });
}

template <class Reactions>
void TreePopulation::Events<Reactions>::giveBirth() {
  of.method_.nucleate(of.random_);
  of.births_.bear(weight, of.method_.weight(), of.random_);
  of.exchange_.inceptions += weight;
  reactions.recordInception(weight, of.exchange_);
}

template <class Reactions>
template <class Process>
void TreePopulation::Events<Reactions>::take(const Process&, bool happened) {
  if (happened)
    of.exchange_.coagulations += weight;
  else
    ++of.method_.counters().fictitious;
}

template <class Reactions>
void TreePopulation::jump(Reactions& reactions, const typename Reactions::Sums& sums, double dt) {
  births_.setRate(reactions.inception(sums, dt));
  births_.plan(method_.weight(), random_);
  double time = type_.clock();
  const double end = time + dt;
  type_.setNextUpdate(end);
  Events<Reactions> events{*this, reactions};
  runEvents(time, end, random_, births_, events, CoagulationJumps<Method>{method_, options_.coagulation});
  counters_.fused += type_.takeAbsorbed();
  type_.clock() = end;
}

template <class Reactions>
void TreePopulation::change(Reactions& reactions, const typename Reactions::Sums& sums, double dt) {
  if (size() == 0) return;
  TreeSintering::Changes sintered;
  reactions.begin(sums, dt);
  const double weight = method_.weight();
  method_.changeParticles([&](Tree& tree, double) {
    if (callback_) callback_();
    sintering_.advanceLazily(tree, sintered);
    if (!reactions.isActive()) return true;
    const TreeFate fate = reactions.grow(tree, random_);
    if (fate == TreeFate::changed) sintering_.advanceLazily(tree, sintered);
    return fate != TreeFate::gone;
  });
  if (TreeSpheres* spheres = type_.spheres()) sintered.fused += spheres->takeMerged();  // by growth
  record(sintered);
  reactions.recordGrowth(weight, exchange_, counters_);
  if constexpr (requires { reactions.takeFragments(); }) {
    std::vector<WeightedParticle<Tree>> fragments;
    for (Tree& part : reactions.takeFragments()) fragments.push_back({std::move(part), weight});
    if (!fragments.empty()) method_.join(fragments, random_);
  }
}

void TreePopulation::applyDeferred() {
  const auto waits = [&](const Tree& tree) { return waitsForSintering(tree.head(), type_.clock()); };
  // Where none does, nothing is rebuilt.
  bool isAnyWaiting = false;
  method_.forEachParticle([&](const Tree& tree, double) { isAnyWaiting = isAnyWaiting || waits(tree); });
  if (!isAnyWaiting) return;
  TreeSintering::Changes changes;
  method_.changeParticles([&](Tree& tree, double) {
    if (waits(tree)) sintering_.advance(tree, type_.clock(), changes);
    return true;
  });
  record(changes);
}

std::vector<TreeEvent> treeEvents(const TreeMaterial& material) {
  using E = TreeExchange;
  using R = TreeRates;
  using C = TreeCounters;
  std::vector<TreeEvent> events;
  const auto add = [&](const char* name, const char* description, SpeciesExchanged gas, double E::*amount,
                       const char* singular = nullptr, double R::*rate = nullptr, std::uint64_t C::*count = nullptr) {
    events.push_back({{{{name, "1/m^3", description}, std::move(gas)}, amount}, singular, rate, count});
  };
  const SootReactions* soot = material.soot();
  const SpeciesExchanged bridge{{}, {TreeSites::product}}, molecule{{TreeSites::precursor}, {TreeSites::product}};
  const SpeciesExchanged dimers = soot != nullptr ? exchangedByDimers(soot->soot) : SpeciesExchanged{};
  const SpeciesExchanged born = soot != nullptr ? dimers : material.sites() != nullptr ? molecule : SpeciesExchanged{};
  add("inceptions", "particles born", born, &E::inceptions, "inception", &R::inceptions, &C::inceptions);
  add("coagulations", "collisions of particles", {}, &E::coagulations, "coagulation", &R::coagulations,
      &C::coagulations);
  if (material.sites() != nullptr) {
    add("surface_reactions", "molecules that reacted with a site of a surface", molecule, &E::reactions,
        "surface_reaction", &R::reactions, &C::reactions);
    add("condensations", "pairs of sites that reacted within a particle", bridge, &E::condensations, "condensation",
        &R::condensations, &C::condensations);
    add("sintered_pairs", "pairs of sites that reacted as their surface sintered", bridge, &E::sinteredPairs);
  }
  if (soot == nullptr) return events;
  add("condensations", "dimers or monomers of PAH that condensed on a particle", dimers, &E::dimers);
  add("growth_reactions", "molecules of C2H2 that a surface took up", exchangedByGrowth(), &E::grown);
  add("oxidations_by_o2", "molecules of O2 that oxidised a surface", exchangedByO2(), &E::oxidisedO2);
  add("oxidations_by_oh", "molecules of OH that oxidised a surface", exchangedByOH(), &E::oxidisedOH);
  add("burnt_primaries", "primaries that burnt away", {}, &E::burntPrimaries);
  add("burnt_particles", "particles that burnt away", {}, &E::burnt, nullptr, nullptr, &C::burnt);
  add("broken_particles", "particles that broke as one of their primaries had burnt away", {}, &E::broken, nullptr,
      nullptr, &C::broken);
  if (soot->fragmentation.active)
    add("fragmentations", "necks of particles that oxidation broke", {}, &E::fragmentations, "fragmentation",
        &R::fragmentations, &C::fragmentations);
  return events;
}

}  // namespace lampblack::particles
