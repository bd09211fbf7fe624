#include "particles/trees/tree_growth.hpp"

#include <algorithm>
#include <cmath>

#include "core/poisson.hpp"

namespace lampblack::particles {

// Rate of the reaction within the tree (eq. 59), below zero where sintering takes more sites than the surface gets.
double TreeGrowth::within(const TreeHead& tree, double sites) const {
  if (!type_.material().condenses) return 0;
  const double bySintering = tree.count > 1 ? 0.5 * sites / tree.surface * tree.sintering : 0;
  return rate_ * sites - bySintering;
}

void TreeGrowth::react(TreeHead& tree, TreePrimary* primaries, std::size_t i, double events, Changes& changes) {
  const TreeMaterial& m = type_.material();
  for (std::size_t c = 0; c < mostTreeComponents; ++c) {
    primaries[i].units[c] += events * m.growth[c];
    tree.units[c] += events * m.growth[c];
  }
  grown_[i] += events;
  changes.reactions += events;
  changed_ = true;
}

void TreeGrowth::condense(TreeHead& tree, TreePrimary* primaries, std::size_t i, double events, Changes& changes) {
  const TreeMaterial& m = type_.material();
  const double possible = std::floor(0.5 * primaries[i].units[m.site]), done = std::min(events, possible);
  if (done < events) changes.limited += static_cast<std::uint64_t>(events - done);
  if (!(done > 0)) return;
  primaries[i].units[m.site] -= 2 * done;
  primaries[i].units[m.bridge] += done;
  tree.units[m.site] -= 2 * done;
  tree.units[m.bridge] += done;
  changes.bridges += done;
  changed_ = true;
}

// The first event is now, `left` (s) is what remains.
void TreeGrowth::oneByOne(TreeHead& tree, TreePrimary* primaries, double left, RandomStream& random, Changes& changes) {
  const std::size_t site = type_.material().site;
  while (true) {
    const double surface = rate_ * tree.units[site];
    double total = surface + std::max(0.0, within(tree, tree.units[site]));
    const std::size_t i = tree.count == 1 ? 0 : random.below(tree.count);
    if (random.uniform() * total < surface)
      react(tree, primaries, i, 1, changes);
    else
      condense(tree, primaries, i, 1, changes);
    const double sites = tree.units[site], inside = within(tree, sites);
    if (inside < 0) ++changes.limited;
    total = rate_ * sites + std::max(inside, 0.0);
    if (!(total > 0)) return;
    left -= random.exponential(total);
    if (left < 0) return;
  }
}

void TreeGrowth::inNumbers(TreeHead& tree, TreePrimary* primaries, double dt, RandomStream& random, Changes& changes) {
  const std::size_t site = type_.material().site;
  const double n = tree.count, steps = std::ceil(2 * rate_ * dt / sitesChange), h = dt / steps;
  for (double s = 0; s < steps; ++s) {
    const double sites = tree.units[site], inside = within(tree, sites);
    if (inside < 0) ++changes.limited;
    const double surface = rate_ * sites * h / n, condensing = std::max(inside, 0.0) * h / n;
    for (std::size_t i = 0; i < tree.count; ++i) {
      const double events = poisson(random, surface), pairs = poisson(random, condensing);
      if (events > 0) react(tree, primaries, i, events, changes);
      if (pairs > 0) condense(tree, primaries, i, pairs, changes);
    }
  }
}

// Sizes from units; necks gain surface from what has grown on their primaries (eqs. 30, 31).
void TreeGrowth::finish(TreeHead& tree) {
  const TreeMaterial& m = type_.material();
  TreePrimary* primaries = primariesOf(&tree);
  const double gain = 2 * m.smoothing * m.growthVolume();
  for (std::size_t i = 0; i < tree.count; ++i) {
    TreePrimary& p = primaries[i];
    grown_[i] *= gain / p.diameter;  // m2
    p.diameter = treeDiameter(m.volume(p.units));
  }
  TreeNeck* necks = necksOf(&tree);
  for (std::uint32_t k = 0; k + 1 < tree.count; ++k) {
    TreeNeck& neck = necks[k];
    neck.sphere = sphereOfNeck(primaries, neck);
    neck.common = std::max(neck.common + grown_[neck.left] + grown_[neck.right], neck.sphere);
  }
  type_.measure(tree);
  tree.rest = 0;
}

bool TreeGrowth::advance(Tree& handle, double dt, RandomStream& random, Changes& changes) {
  const TreeHead& seen = handle.head();
  const double sites = seen.units[type_.material().site];
  const double expected = 2 * rate_ * sites * dt;
  if (!(expected > 0)) return false;
  double left = dt;
  if (expected <= fewEvents) {  // where nothing happens, nothing is touched
    left -= random.exponential(rate_ * sites + std::max(0.0, within(seen, sites)));
    if (left < 0) return false;
  }
  TreeHead& tree = handle.own();
  grown_.assign(tree.count, 0.0);
  changed_ = false;
  if (expected <= fewEvents)
    oneByOne(tree, primariesOf(&tree), left, random, changes);
  else
    inNumbers(tree, primariesOf(&tree), dt, random, changes);
  if (changed_) finish(tree);
  return changed_;
}

}  // namespace lampblack::particles
