#include "particles/trees/tree_growth.hpp"

#include <algorithm>
#include <cmath>

#include "core/poisson.hpp"
#include "particles/trees/tree_rounding.hpp"

namespace lampblack::particles {

double TreeGrowth::within(const TreeHead& tree, double sites) const {
  if (!reactions_.condenses) return 0;
  const double bySintering = isAggregate(tree) ? 0.5 * sites / tree.surface * tree.sintering : 0;
  return rate_ * sites - bySintering;
}

void TreeGrowth::react(TreeHead& tree, TreePrimary* primaries, std::size_t i, double events, Changes& changes) {
  for (std::size_t c = 0; c < mostTreeComponents; ++c) {
    primaries[i].units[c] += events * reactions_.growth[c];
    tree.units[c] += events * reactions_.growth[c];
  }
  grown_[i] += events;
  changes.reactions += events;
  changed_ = true;
}

void TreeGrowth::condense(TreeHead& tree, TreePrimary* primaries, std::size_t i, double events, Changes& changes) {
  const SiteReactions& m = reactions_;
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

// Uniformly, or of spheres in space by the surface that is free.
std::size_t TreeGrowth::drawPrimary(const TreeHead& tree, RandomStream& random) const {
  if (surfaces_.empty()) return random.below(tree.count);
  const auto at = std::upper_bound(surfaces_.begin(), surfaces_.end(), random.uniform() * surfaces_.back());
  return std::min<std::size_t>(static_cast<std::size_t>(at - surfaces_.begin()), tree.count - 1);
}

// The first event is now, `left` (s) is what remains.
void TreeGrowth::applySingleEvents(TreeHead& tree, TreePrimary* primaries, double left, RandomStream& random,
                                   Changes& changes) {
  const std::size_t site = reactions_.site;
  while (true) {
    const double surface = rate_ * tree.units[site];
    double total = surface + std::max(0.0, within(tree, tree.units[site]));
    const std::size_t i = tree.count == 1 ? 0 : drawPrimary(tree, random);
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

void TreeGrowth::applyPoissonNumbers(TreeHead& tree, TreePrimary* primaries, double dt, RandomStream& random,
                                     Changes& changes) {
  const std::size_t site = reactions_.site;
  const double n = tree.count, steps = std::ceil(2 * rate_ * dt / sitesChange), h = dt / steps;
  for (double s = 0; s < steps; ++s) {
    const double sites = tree.units[site], inside = within(tree, sites);
    if (inside < 0) ++changes.limited;
    const double all = rate_ * sites * h, allInside = std::max(inside, 0.0) * h;
    for (std::size_t i = 0; i < tree.count; ++i) {
      const bool isEqual = surfaces_.empty();
      const double part = isEqual ? 0 : (surfaces_[i] - (i > 0 ? surfaces_[i - 1] : 0)) / surfaces_.back();
      const double surface = isEqual ? all / n : all * part, condensing = isEqual ? allInside / n : allInside * part;
      const double events = poisson(random, surface), pairs = poisson(random, condensing);
      if (events > 0) react(tree, primaries, i, events, changes);
      if (pairs > 0) condense(tree, primaries, i, pairs, changes);
    }
  }
}

bool TreeGrowth::advance(Tree& handle, double dt, RandomStream& random, Changes& changes) {
  const TreeHead& seen = handle.head();
  const double sites = seen.units[reactions_.site];
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
  if (type_.spheres() != nullptr) type_.spheres()->sumSurfaces(tree, surfaces_);
  if (expected <= fewEvents)
    applySingleEvents(tree, primariesOf(&tree), left, random, changes);
  else
    applyPoissonNumbers(tree, primariesOf(&tree), dt, random, changes);
  if (changed_) roundTree(type_, tree, grown_, type_.material().volume(reactions_.growth));
  return changed_;
}

}  // namespace lampblack::particles
