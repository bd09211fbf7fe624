// A population of particles of molecules as seen from outside, and as packed.
#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/packed_doubles.hpp"
#include "particles/molecules/molecule_population.hpp"
#include "particles/molecules/packed_molecules.hpp"

namespace lampblack::particles {

MoleculeTotals MoleculePopulation::totals() const {
  MoleculeTotals t;
  if (size() == 0) return t;
  double levels = 0;
  forEach([&](const MoleculeParticle& p, double w) {
    const TreeHead& tree = p.tree.head();
    const double mass = type_.mass(p);
    t.number += w;
    t.volume += w * tree.volume;
    t.mass += w * mass;
    t.massSquared += w * mass * mass;
    t.surface += w * tree.surface;
    t.carbon += w * p.carbon();
    t.hydrogen += w * p.hydrogen();
    t.primaries += w * tree.count;
    t.molecules += w * p.molecules;
    for (const MoleculesOfPrimary& primary : *p.inside)
      for (const HeldMolecule& m : primary) t.rings += w * static_cast<double>(m->rings());
    if (p.molecules == 1) t.single += w;
    t.collisionDiameter += w * p.collision;
    t.primaryDiameter += w * meanPrimaryDiameter(tree);
    levels += w * meanSinteringLevel(tree);
    t.mostMolecules = std::max<std::size_t>(t.mostMolecules, p.molecules);
  });
  for (double* mean : {&t.collisionDiameter, &t.primaryDiameter}) *mean /= t.number;
  t.sinteringLevel = levels / t.number;
  return t;
}

MoleculePopulation::State MoleculePopulation::save() const {
  State state{{},        method_.memory(), random_.position(), fused_, births_.memory(), type_.trees().clock(),
              exchange_, counters()};
  state.particles.reserve(size());
  forEach([&](const MoleculeParticle& p, double) { state.particles.push_back(p); });
  return state;
}

void MoleculePopulation::restore(const State& state) {
  random_.seek(state.position);
  births_.restore(state.births);
  type_.trees().clock() = state.clock;
  exchange_ = state.exchange;
  fused_ = state.fused;
  method_.counters() = state.counters;
  method_.restore(state.memory, state.particles);
}

namespace {

constexpr double packedMolecules = 1;

}  // namespace

std::vector<double> MoleculePopulation::pack() const {
  std::vector<double> state{packedMolecules, carbonOfGas_, static_cast<double>(options_.particles)};
  packDoubles(state, packedOwner(random_.owner()));
  state.push_back(static_cast<double>(random_.position()));
  packDoubles(state, births_.memory());
  for (const double value : {type_.trees().clock(), cost_, static_cast<double>(fused_)}) state.push_back(value);
  packDoubles(state, exchange_);
  for (const PopulationCounter& counter : populationCounters)
    state.push_back(static_cast<double>(counters().*counter.value));
  packDoubles(state, method_.memory());
  forEach([&](const MoleculeParticle& p, double w) { packParticle(p, w, type_, state); });
  return state;
}

void MoleculePopulation::unpack(std::span<const double> values) {
  PackedDoubles state(values);
  if (state.next() != packedMolecules || state.next() != carbonOfGas_ ||
      state.next() != static_cast<double>(options_.particles))
    throw InputError("particles: the saved state is not one of as many particles of these molecules");
  random_ = RandomStream(options_.seed, ownerOf(state.next<PackedOwner>()), moleculeStream);
  random_.seek(static_cast<std::uint64_t>(state.next()));
  births_.restore(state.next<EvenBirths::Memory>());
  type_.trees().clock() = state.next();
  cost_ = state.next();
  fused_ = static_cast<std::uint64_t>(state.next());
  exchange_ = state.next<MoleculeExchange>();
  for (const PopulationCounter& counter : populationCounters)
    method_.counters().*counter.value = static_cast<std::uint64_t>(state.next());
  const auto memory = state.next<std::array<double, 2>>();
  std::vector<MoleculeParticle> all;
  moleculeRows.forEach(values.last(state.left()), [&](const double* row) {
    all.push_back(unpackParticle({row, moleculeRows.lengthOf(row)}, type_, ofGas_));
  });
  method_.restore(memory, all);
}

void MoleculePopulation::join(std::span<const double> rows, double share) {
  std::vector<WeightedParticle<MoleculeParticle>> coming;
  moleculeRows.forEach(rows, [&](const double* row) {
    MoleculeParticle p = unpackParticle({row, moleculeRows.lengthOf(row)}, type_, ofGas_);
    // Of another clock.
    p.tree.own().time = type_.trees().clock();
    p.tree.own().rest = 0;
    coming.push_back({std::move(p), share * row[packedNumberAt]});
  });
  if (!coming.empty()) method_.join(coming, random_);
}

}  // namespace lampblack::particles
