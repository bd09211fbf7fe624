#include "particles/trees/tree_soot.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/poisson.hpp"
#include "particles/trees/tree_burning.hpp"
#include "particles/trees/tree_rounding.hpp"

namespace lampblack::particles {

using Component = SootReactions::Component;

TreeSoot::TreeSoot(const PrimaryTrees& type)
    : type_(type),
      reactions_(*type.material().soot()),
      dimers_(reactions_.soot),
      carbonAtom_(reactions_.soot.carbonWeight / constants::avogadro),
      hydrogenAtom_(reactions_.soot.hydrogenWeight / constants::avogadro),
      joined_(type.material().sintering.active() ? std::cbrt(2.0) : std::pow(2.0, 1 / type.fractalDimension())),
      fragmentation_(type) {}

SootPopulationLaw TreeSoot::law(double tolerance) const {
  return {reactions_.soot, dimers_, kernel_, joined_, reactions_.alphaOfPrimaries, true, tolerance};
}

SootAggregate::Particle TreeSoot::asSphere(const TreeHead& tree) const {
  return {tree.units[Component::carbon] * carbonAtom_, tree.units[Component::hydrogen] * hydrogenAtom_, 1,
          tree.collision};
}

void TreeSoot::add(Sums& sums, const TreeHead& tree, double weight) const {
  const SootAggregate::Particle p = asSphere(tree);
  sums.number += weight;
  sums.carbon += weight * p.carbon;
  sums.hydrogen += weight * p.hydrogen;
  sums.primaries += weight * tree.count;
  sums.area += weight * tree.surface;
  sums.diameters += weight * tree.collision;
  sums.breaking += weight * fragmentation_.perOxidation(tree);
  if (!medium_->condensing()) return;
  const double rate = medium_->condensingCollision(p);
  sums.collisions += weight * rate;
  sums.slopes += weight * medium_->collisionSlope(p, rate);
}

void TreeSoot::setGas(const ParticleGas& gas, const CollisionKernel&) {
  medium_.emplace(reactions_.soot, dimers_, gas, reactions_.keepsHydrogen);
}

double TreeSoot::inception(const Sums& sums, double dt) const {
  return medium_->incepting() ? sootInception(law(1), *medium_, sums, dt) : 0;
}

TreeUnits TreeSoot::nucleus() const {
  TreeUnits units{};
  units[Component::carbon] = 2 * medium_->dimerCarbon() / carbonAtom_;
  units[Component::hydrogen] = 2 * medium_->dimerHydrogen() / hydrogenAtom_;
  return units;
}

double TreeSoot::step(const Sums& sums, const CollisionKernel* kernel, double tolerance, double remaining) {
  kernel_ = kernel;
  // The number may not change by more in a step by what breaks, either.
  const SootFluxes flux = medium_->fluxes();
  const double breaking = sums.number > 0 ? (flux.O2 + flux.OH) * sums.breaking / sums.number : 0;
  return sootStep(law(tolerance), *medium_, sums, breaking, remaining);
}

void TreeSoot::begin(const Sums& sums, double dt) {
  dt_ = dt;
  growth_.emplace(medium_->growth(sootFluxes(law(1), *medium_, sums, dt)));
  moved_ = {};
  burntPrimaries_ = burnt_ = broken_ = fragmentations_ = 0;
  std::fill(std::begin(events_), std::end(events_), 0.0);
}

// What a burnt primary had is gone, and nothing else happens to it.
void TreeSoot::applyEvents(TreePrimary* primaries, std::size_t i, std::size_t kind, double times) {
  TreePrimary& primary = primaries[i];
  double carbon = primary.units[Component::carbon] * carbonAtom_;
  double hydrogen = primary.units[Component::hydrogen] * hydrogenAtom_;
  if (!(carbon > 0)) return;
  if (!(change_[i] < 0)) {  // for the first time
    change_[i] = -type_.material().volume(primary.units);
    changed_.push_back(static_cast<std::uint32_t>(i));
  }
  SootEvents events(*medium_, growth_->leastCarbon(), 1, moved_);
  events_[kind] += times;
  if (!events.applyEvents(kind, carbon, hydrogen, times)) ++burntPrimaries_;
  primary.units[Component::carbon] = carbon / carbonAtom_;
  primary.units[Component::hydrogen] = hydrogen / hydrogenAtom_;
}

// Of the primaries up to each: of spheres in space what is free.
void TreeSoot::sumSurfaces(const TreeHead& tree) {
  if (type_.spheres() != nullptr) return type_.spheres()->sumSurfaces(tree, surfaces_);
  surfaces_.clear();
  double sum = 0;
  const TreePrimary* primaries = primariesOf(const_cast<TreeHead*>(&tree));
  for (std::size_t i = 0; i < tree.count; ++i) surfaces_.push_back(sum += primarySurface(primaries[i].diameter));
}

// The first event is due where `left` of the expected numbers are still to come.
void TreeSoot::applySingleEvents(TreeHead& tree, const SootEventNumbers& expected, double left, RandomStream& random) {
  TreePrimary* primaries = primariesOf(&tree);
  const double total = sumOf(expected);
  if (tree.count > 1) sumSurfaces(tree);
  do {
    const std::size_t kind = eventAt(expected, random.uniform() * total);
    std::size_t i = 0;
    if (tree.count > 1) {
      const auto at = std::upper_bound(surfaces_.begin(), surfaces_.end(), random.uniform() * surfaces_.back());
      i = std::min<std::size_t>(static_cast<std::size_t>(at - surfaces_.begin()), tree.count - 1);
    }
    applyEvents(primaries, i, kind, 1);
    left -= random.exponential(1);
  } while (left > 0);
}

void TreeSoot::applyPoissonNumbers(TreeHead& tree, const SootEventNumbers& expected, RandomStream& random) {
  TreePrimary* primaries = primariesOf(&tree);
  const bool areSpheres = type_.spheres() != nullptr;
  if (areSpheres) sumSurfaces(tree);
  for (std::size_t i = 0; i < tree.count; ++i) {
    const double part = areSpheres ? (surfaces_[i] - (i > 0 ? surfaces_[i - 1] : 0)) / surfaces_.back()
                                   : primarySurface(primaries[i].diameter) / tree.surfaces;
    for (std::size_t kind = 0; kind < expected.size(); ++kind) {
      const double times = poisson(random, part * expected[kind]);
      if (times > 0) applyEvents(primaries, i, kind, times);
    }
  }
}

void TreeSoot::breakUp(Tree& tree, RandomStream& random, std::vector<Tree>& parts) {
  fragmentations_ += fragmentation_.breakUp(tree, growth_->oxidation(), 0.5 * dt_, random, parts);
}

TreeFate TreeSoot::grow(Tree& tree, RandomStream& random) {
  if (!fragmentation_.isActive() || !(growth_->oxidation() > 0)) return react(tree, random);
  const std::uint64_t before = fragmentations_;
  const std::size_t first = fragments_.size();
  pieces_.clear();
  breakUp(tree, random, pieces_);
  pieces_.push_back(std::move(tree));
  bool isSame = true;
  for (Tree& piece : pieces_) {
    const TreeFate fate = react(piece, random);
    isSame = isSame && fate == TreeFate::same;
    if (fate != TreeFate::gone) fragments_.push_back(std::move(piece));
  }
  // All that is left of the tree stands there now, with what burnt primaries held.
  pieces_.clear();
  for (std::size_t k = first; k < fragments_.size(); ++k) breakUp(fragments_[k], random, pieces_);
  std::move(pieces_.begin(), pieces_.end(), std::back_inserter(fragments_));
  if (fragments_.size() == first) return TreeFate::gone;
  tree = std::move(fragments_.back());
  fragments_.pop_back();
  return isSame && fragmentations_ == before ? TreeFate::same : TreeFate::changed;
}

TreeFate TreeSoot::react(Tree& handle, RandomStream& random) {
  const TreeHead& seen = handle.head();
  const double d = 6 * seen.volume / seen.surface, equal = equalPrimaries(seen);
  const SootAggregate::Particle p = asSphere(seen);
  const SootEventNumbers expected =
      expectedEvents(*growth_, p.carbon, p.hydrogen, equal, seen.collision / d, d, dt_, 1 / carbonAtom_);
  const double total = sumOf(expected);
  if (!(total > 0)) return TreeFate::same;
  const bool areFew = total <= fewEvents + seen.count;
  // Where nothing happens, nothing is touched.
  const double left = areFew ? total - random.exponential(1) : total;
  if (left < 0) return TreeFate::same;
  TreeHead& tree = handle.own();
  const TreePrimary* primaries = primariesOf(&tree);
  change_.assign(tree.count, 0.0);
  changed_.clear();
  const std::uint64_t before = burntPrimaries_;
  if (areFew)
    applySingleEvents(tree, expected, left, random);
  else
    applyPoissonNumbers(tree, expected, random);
  for (const std::uint32_t i : changed_) change_[i] += type_.material().volume(primaries[i].units);
  const std::size_t burnt = burntPrimaries_ - before;
  if (burnt == tree.count) {
    ++burnt_;
    return TreeFate::gone;
  }
  roundTree(type_, tree, change_, 1, changed_);
  return burnt > 0 ? withoutBurnt(handle) : TreeFate::changed;
}

TreeFate TreeSoot::withoutBurnt(Tree& tree) {
  if (!reactions_.breaksUp) {
    joinOverBurnt(type_, tree);
    return TreeFate::changed;
  }
  std::vector<Tree> parts = partsAroundBurnt(type_, tree);
  tree = std::move(parts.back());
  parts.pop_back();
  if (!parts.empty()) ++broken_;
  for (Tree& part : parts) fragments_.push_back(std::move(part));
  return TreeFate::changed;
}

void TreeSoot::recordInception(double weight, TreeExchange& exchange) const {
  exchangeDimers(*medium_, reactions_.soot, 2 * weight, exchange.gas);
  const TreeUnits units = nucleus();
  for (std::size_t c = 0; c < mostTreeComponents; ++c) exchange.units[c] += weight * units[c];
}

void TreeSoot::recordGrowth(double weight, TreeExchange& exchange, TreeCounters& counters) const {
  SootTransfer all;
  all.add(weight, moved_);
  exchangeDimers(*medium_, reactions_.soot, all.dimers, exchange.gas);
  exchangeSurface(reactions_.soot, all, exchange.gas);
  const double carbon = all.dimers * medium_->dimerCarbon() + all.growth - all.oxidationO2 - all.oxidationOH;
  const double hydrogen = all.dimers * medium_->dimerHydrogen() - all.hydrogenO2 - all.hydrogenOH;
  exchange.units[Component::carbon] += carbon / carbonAtom_;
  exchange.units[Component::hydrogen] += hydrogen / hydrogenAtom_;
  exchange.dimers += weight * events_[dimerEvent];
  exchange.grown += weight * events_[growthEvent];
  exchange.oxidisedO2 += weight * events_[oxidationByO2Event];
  exchange.oxidisedOH += weight * events_[oxidationByOHEvent];
  exchange.burntPrimaries += weight * static_cast<double>(burntPrimaries_);
  exchange.burnt += weight * static_cast<double>(burnt_);
  exchange.broken += weight * static_cast<double>(broken_);
  counters.burnt += burnt_;
  counters.broken += broken_;
  exchange.fragmentations += weight * static_cast<double>(fragmentations_);
  counters.fragmentations += fragmentations_;
}

}  // namespace lampblack::particles
