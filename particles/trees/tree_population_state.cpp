// A population of trees as seen from outside, and as packed.
#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/packed_doubles.hpp"
#include "particles/population/monte_carlo/weighted_deviation.hpp"
#include "particles/stochastic/particle_rows.hpp"
#include "particles/trees/packed_tree.hpp"
#include "particles/trees/tree_population.hpp"

namespace lampblack::particles {

TreeTotals TreePopulation::totals() const {
  TreeTotals t;
  if (size() == 0) return t;
  double levels = 0;
  WeightedDeviation collision, primary;
  method_.forEachParticle([&](const Tree& p, double w) {
    const TreeHead& tree = p.head();
    const double n = primariesOfTree(tree), mass = tree.volume * options_.material.density;
    const double mean = meanPrimaryDiameter(tree);
    t.number += w;
    t.volume += w * tree.volume;
    t.mass += w * mass;
    t.massSquared += w * mass * mass;
    t.surface += w * tree.surface;
    t.primaries += w * n;
    t.sinteringRate += w * tree.sintering;
    for (std::size_t c = 0; c < mostTreeComponents; ++c) t.units[c] += w * tree.units[c];
    t.sphereDiameter += w * treeDiameter(tree.volume);
    t.collisionDiameter += w * tree.collision;
    t.primaryDiameter += w * mean;
    levels += w * meanSinteringLevel(tree);
    collision.add(std::log(tree.collision), w);
    primary.add(std::log(mean), w);
    t.largest = std::max<std::size_t>(t.largest, tree.count);
  });
  for (double* mean : {&t.sphereDiameter, &t.collisionDiameter, &t.primaryDiameter}) *mean /= t.number;
  t.sinteringLevel = levels / t.number;
  t.collisionDeviation = collision.geometric();
  t.primaryDeviation = primary.geometric();
  return t;
}

std::vector<double> TreePopulation::primarySizes(const SizeBins& bins) const {
  std::vector<double> density(bins.count, 0.0);
  method_.forEachParticle([&](const Tree& p, double w) {
    for (const TreePrimary& primary : p.primaries())
      if (const std::size_t bin = bins.of(primary.diameter); bin < bins.count) density[bin] += w / bins.width();
  });
  return density;
}

std::vector<Tree> TreePopulation::trees() const {
  std::vector<Tree> all;
  all.reserve(size());
  method_.forEachParticle([&](const Tree& p, double) { all.push_back(p); });
  return all;
}

TreeCounters TreePopulation::counters() const {
  TreeCounters all = counters_;
  const PopulationCounters& method = const_cast<Method&>(method_).counters();
  all.inceptions = method.nucleations;
  all.coagulations = method.coagulations;
  all.fictitious = method.fictitious;
  all.doublings = method.doublings;
  all.removals = method.removals;
  all.splitSteps = method.splitSteps;
  return all;
}

TreePopulation::State TreePopulation::save() const {
  return {trees(),       method_.memory(), random_.position(), births_.memory(),
          type_.clock(), exchange_,        counters_,          const_cast<Method&>(method_).counters()};
}

void TreePopulation::restore(const State& state) {
  random_.seek(state.position);
  births_.restore(state.births);
  type_.clock() = state.clock;
  exchange_ = state.exchange;
  counters_ = state.counters;
  method_.counters() = state.method;
  method_.restore(state.memory, state.trees);
}

namespace {

constexpr double packedTrees = 5;

// What counters() does not take from those of the method.
constexpr std::uint64_t TreeCounters::*packedCounters[] = {
    &TreeCounters::fused,        &TreeCounters::reactions, &TreeCounters::condensations, &TreeCounters::limited,
    &TreeCounters::withoutSites, &TreeCounters::burnt,     &TreeCounters::broken,        &TreeCounters::fragmentations};

}  // namespace

std::vector<double> TreePopulation::pack() const {
  std::vector<double> state{packedTrees, static_cast<double>(options_.material.components.size()),
                            static_cast<double>(options_.particles)};
  packDoubles(state, packedOwner(random_.owner()));
  state.push_back(static_cast<double>(random_.position()));
  packDoubles(state, births_.memory());
  state.push_back(type_.clock());
  state.push_back(cost_);
  packDoubles(state, exchange_);
  for (const auto count : packedCounters) state.push_back(static_cast<double>(counters_.*count));
  for (const PopulationCounter& counter : populationCounters)
    state.push_back(static_cast<double>(const_cast<Method&>(method_).counters().*counter.value));
  packDoubles(state, method_.memory());
  std::size_t length = state.size();
  method_.forEachParticle([&](const Tree& p, double) { length += lengthOfRow(p, options_.material); });
  state.reserve(length);
  method_.forEachParticle([&](const Tree& p, double w) { packTree(p, w, options_.material, state); });
  return state;
}

void TreePopulation::unpack(std::span<const double> values) {
  PackedDoubles state(values);
  if (state.next() != packedTrees)
    throw InputError(
        "particles: the saved state of trees was written by another version of Lampblack; go on with that version, or "
        "begin the run anew");
  if (state.next() != static_cast<double>(options_.material.components.size()) ||
      state.next() != static_cast<double>(options_.particles))
    throw InputError("particles: the saved state is not one of as many trees of this material");
  random_ = RandomStream(options_.seed, ownerOf(state.next<PackedOwner>()), treeStream);
  random_.seek(static_cast<std::uint64_t>(state.next()));
  births_.restore(state.next<EvenBirths::Memory>());
  type_.clock() = state.next();
  cost_ = state.next();
  exchange_ = state.next<TreeExchange>();
  for (const auto count : packedCounters) counters_.*count = static_cast<std::uint64_t>(state.next());
  for (const PopulationCounter& counter : populationCounters)
    method_.counters().*counter.value = static_cast<std::uint64_t>(state.next());
  const auto memory = state.next<std::array<double, 2>>();
  std::vector<Tree> all;
  for (std::span<const double> rest = values.last(state.left()); !rest.empty();
       rest = rest.subspan(treeRows.lengthOf(rest.data())))
    all.push_back(unpackTree(rest, type_.pool(), options_.material));
  method_.restore(memory, all);
  kernel_.reset();  // what the store knows of rates is of the gas of who was unpacked before
}

void TreePopulation::join(std::span<const double> rows, double share) {
  std::vector<WeightedParticle<Tree>> coming;
  treeRows.forEach(rows, [&](const double* row) {
    Tree tree = unpackTree({row, treeRows.lengthOf(row)}, type_.pool(), options_.material);
    // Of another clock; its contacts are looked at as soon as they may be.
    tree.own().time = type_.clock();
    tree.own().rest = 0;
    coming.push_back({std::move(tree), share * row[packedNumberAt]});
  });
  if (!coming.empty()) method_.join(coming, random_);
}

}  // namespace lampblack::particles
