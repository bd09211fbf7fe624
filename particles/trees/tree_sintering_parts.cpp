// Sintering between the parts of a tree: each neck loses surface at the rate of the whole of both parts that it joins,
// (S - S_sphere) / tau(6 V/S) with their volume V and surface S: that of eq. 15 for the tree itself, for other parts
// the sum of their primaries (and, where the law says so, without S_sphere). So the rates of all necks but the last
// collision's are constant until primaries fuse, and that one's is followed by the midpoint rule.
#include <algorithm>
#include <cmath>

#include "particles/trees/tree_sintering.hpp"

namespace lampblack::particles {
namespace {

// Of the time: what happens within is done at once.
constexpr double instant = 1e-3;
// By which the surface of a tree changes in a step. The characteristic time changes by fifty times as much.
constexpr double surfaceStep = 0.01;

// To where its primaries are one, for fuseAll() to see.
void fuseAt(TreeNeck& neck, double common) {
  neck.common = common;
  neck.sphere = common / fusedRatio * (1 + 1e-12);
}

double surfaceOf(const TreeHead& tree, double levels, double sphere, double root) {
  return sphere / (levels / (tree.count - 1.0) * (1 - root) + root);
}

}  // namespace

double TreeSintering::partRate(double volume, double surface) const {
  const double excess = surface - treeSphere(volume);
  return excess > 0 ? excess / type_.material().sintering.time(T_, 6 * volume / surface) : 0;
}

// Rates and sites of all necks; which is that of the whole tree.
std::size_t TreeSintering::partRates(TreeHead& tree) {
  const TreePrimary* primaries = primariesOf(&tree);
  volumes_.assign(1, 0.0);
  surfaces_.assign(1, 0.0);
  sites_.assign(1, 0.0);
  const SiteReactions* sites = type_.material().sites();
  for (std::uint32_t i = 0; i < tree.count; ++i) {
    const TreePrimary& p = primaries[i];
    volumes_.push_back(volumes_.back() + primaryVolume(p.diameter));
    surfaces_.push_back(surfaces_.back() + primarySurface(p.diameter));
    sites_.push_back(sites_.back() + (sites != nullptr ? p.units[sites->site] : 0));
  }
  const std::size_t count = tree.count - 1;
  const TreeNeck* necks = necksOf(&tree);
  rates_.resize(count);
  densities_.resize(count);
  std::size_t whole = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const TreeNeck& neck = necks[k];
    const bool isWhole = neck.first == 0 && neck.last == count;
    if (isWhole) whole = k;
    const double S = isWhole ? tree.surface : surfaces_[neck.last + 1] - surfaces_[neck.first];
    const double V = volumes_[neck.last + 1] - volumes_[neck.first];
    const SinteringLaw& law = type_.material().sintering;
    rates_[k] = isWhole || law.innerSpheres ? partRate(V, S) : S / law.time(T_, 6 * V / S);
    densities_[k] = (sites_[neck.last + 1] - sites_[neck.first]) / S;
  }
  return whole;
}

// Necks that need next to no time, by a bound from below of their rates: the size of the tree grows as it sinters,
// which slows it down, and its excess of surface falls.
bool TreeSintering::fuseAtOnce(TreeHead& tree, std::size_t whole, double dt) {
  bool any = false;
  TreeNeck* necks = necksOf(&tree);
  for (std::size_t k = 0; k + 1 < tree.count; ++k) {
    const double fused = shrinkings_[k].fused;
    double rate = rates_[k];
    if ((necks[k].common - fused) > rate * instant * dt) continue;
    if (k == whole) {
      const double root = 1 / cubeRoot(static_cast<double>(tree.count)), sphere = treeSphere(tree.volume);
      rate = partRate(tree.volume, surfaceOf(tree, tree.levels - sinteringLevel(necks[k]) + fusedLevel, sphere, root));
      if ((necks[k].common - fused) > rate * instant * dt) continue;
    }
    fuseAt(necks[k], fused);
    any = true;
  }
  return any;
}

// Of the surface that necks have lost since the beginning.
void TreeSintering::losePartSites(TreeHead& tree, Changes& changes) {
  for (std::uint32_t k = 0; k + 1 < tree.count; ++k) {
    const TreeNeck& neck = necksOf(&tree)[k];
    loseSites(primariesOf(&tree), neck, densities_[k] * (starts_[k] - neck.common), changes);
  }
  sizePrimaries(tree);
  for (std::uint32_t k = 0; k + 1 < tree.count; ++k) {
    TreeNeck& neck = necksOf(&tree)[k];
    const bool wasFused = isFused(neck);
    neck.sphere = sphereOfNeck(primariesOf(&tree), neck);
    if (wasFused) fuseAt(neck, neck.sphere * fusedRatio);
  }
}

void TreeSintering::parts(Tree& handle, double dt, Changes& changes) {
  TreeHead& tree = handle.own();
  TreeNeck* necks = necksOf(&tree);
  double remaining = dt;
  while (true) {
    fuseAll(tree, changes);
    if (tree.count == 1 || !(remaining > 0)) return;
    fresh_ = false;
    const std::size_t whole = partRates(tree), count = tree.count - 1;
    starts_.clear();
    shrinkings_.clear();
    for (std::size_t k = 0; k < count; ++k) {
      starts_.push_back(necks[k].common);
      shrinkings_.push_back(shrinking(primariesOf(&tree), necks[k], densities_[k]));
    }
    bool hasFused = fuseAtOnce(tree, whole, remaining);
    const double root = 1 / cubeRoot(static_cast<double>(tree.count));
    while (!hasFused && remaining > 0) {
      const double sphere = treeSphere(tree.volume);
      // Change of the sum of levels, 1/s, and what step that and the necks allow.
      const double surface = surfaceOf(tree, tree.levels, sphere, root);
      rates_[whole] = partRate(tree.volume, surface);
      double h = remaining, rise = 0, loss = 0;  // m3/s
      for (std::size_t k = 0; k < count; ++k) {
        const double C = necks[k].common;
        if (rates_[k] > 0) h = std::min(h, (C - shrinkings_[k].fused) / rates_[k]);
        rise += rates_[k] * (necks[k].sphere - shrinkings_[k].sphere * C) / (C * C * (1 - touching));
        loss += rates_[k] * shrinkings_[k].volume;
      }
      const double relative = surface / sphere * (1 - root) / static_cast<double>(count) * rise;  // of the surface, 1/s
      if (relative * h > surfaceStep) h = surfaceStep / relative;
      const double volume = tree.volume - 0.5 * h * loss;
      rates_[whole] = partRate(volume, surfaceOf(tree, tree.levels + 0.5 * h * rise, treeSphere(volume), root));
      tree.levels = 0;
      for (std::size_t k = 0; k < count; ++k) {
        const double fused = shrinkings_[k].fused, gone = rates_[k] * h;
        necks[k].common -= gone;
        necks[k].sphere -= shrinkings_[k].sphere * gone;
        tree.volume -= shrinkings_[k].volume * gone;
        if (necks[k].common - fused < 1e-6 * fused) {
          fuseAt(necks[k], fused);
          hasFused = true;
        }
        tree.levels += sinteringLevel(necks[k]);
      }
      fresh_ = h == dt && relative * h < tolerance_ && !hasFused;
      remaining = h < remaining ? remaining - h : 0;
    }
    losePartSites(tree, changes);
  }
}

}  // namespace lampblack::particles
