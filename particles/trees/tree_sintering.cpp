#include "particles/trees/tree_sintering.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lampblack::particles {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
// Of a pair's volume: the slope of its sphere is constant to a ninth of the square of that.
constexpr double negligibleLoss = 1e-2;

}  // namespace

TreeSintering::TreeSintering(const PrimaryTrees& type, double tolerance) : type_(type), tolerance_(tolerance) {
  if (type.material().sites() != nullptr) volumeOfSite_ = type.material().volumeOfSite();
}

TreeSintering::Shrinking TreeSintering::shrinking(const TreePrimary* primaries, const TreeNeck& neck,
                                                  double density) const {
  const double S = neck.sphere, C = neck.common;
  if (!(density > 0) || C <= S * fusedRatio) return {S * fusedRatio, 0, 0};
  const std::size_t site = type_.material().sites()->site;
  const TreePrimary &l = primaries[neck.left], &r = primaries[neck.right];
  // Of the neck's own sphere: diameters are behind it while a tree is brought up to date.
  const double volume = primaryVolume(std::sqrt(S / constants::pi));
  const auto fusedAt = [&](double slope) { return fusedRatio * (S - slope * C) / (1 - fusedRatio * slope); };
  // Of a slope: of a pair that is all sites S goes with V^(2/3). A nucleus of silica has 0.2. Only the first guess of a
  // pair with fewer sites than its tree can be beyond.
  constexpr double most = 2.0 / 3;
  Shrinking s;
  s.volume = density * volumeOfSite_;
  s.sphere = std::min(2.0 / 3 * S / volume * s.volume, most);
  s.fused = fusedAt(s.sphere);
  // Of next to no mass, of sites that both have, that is it.
  const double fewest = std::min(l.units[site], r.units[site]);
  if (s.volume * (C - s.fused) < negligibleLoss * volume && 0.5 * density * (C - s.fused) <= fewest) return s;
  for (int i = 0; i < 2; ++i) {
    const double surface = C - s.fused, each = 0.5 * density * surface;
    if (!(surface > 1e-9 * C)) break;
    s.volume = volumeOfSite_ * (std::min(each, l.units[site]) + std::min(each, r.units[site])) / surface;
    s.sphere = std::clamp((S - treeSphere(volume - s.volume * surface)) / surface, 0.0, most);
    s.fused = fusedAt(s.sphere);
  }
  return s;
}

// 6 V/S of the pair, or the smaller diameter.
double TreeSintering::sizeOf(const TreePrimary* primaries, const TreeNeck& neck, double common, double sphere) const {
  if (type_.material().sintering.size == SinteringLaw::Size::smaller)
    return std::min(primaries[neck.left].diameter, primaries[neck.right].diameter);
  return std::sqrt(sphere / constants::pi) * (sphere / common);
}

TreeSintering::Course TreeSintering::follow(const TreePrimary* primaries, const TreeNeck& neck, double density,
                                            double dt) const {
  const SinteringLaw& law = type_.material().sintering;
  if (isFused(neck)) return {neck.common, neck.sphere, 0};
  const Shrinking shrinks = shrinking(primaries, neck, density);
  const double fused = shrinks.fused;
  const auto sphereAt = [&](double common) { return neck.sphere - shrinks.sphere * (neck.common - common); };
  if (law.size == SinteringLaw::Size::smaller || law.mechanism == SinteringMechanism::constant) {
    // The surface goes towards where it would be the sphere's, which goes with it.
    const double tau = law.time(T_, sizeOf(primaries, neck, neck.common, neck.sphere)) / (1 - shrinks.sphere);
    const double target = (neck.sphere - shrinks.sphere * neck.common) / (1 - shrinks.sphere);
    const double time = tau * std::log((neck.common - target) / (fused - target));
    if (time <= dt) return {fused, sphereAt(fused), time};
    const double common = target + (neck.common - target) * std::exp(-dt / tau);
    return {common, sphereAt(common), never};
  }
  // The midpoint rule over steps in the surface: the time is what depends on it.
  double C = neck.common, time = 0;
  while (true) {
    const double down = std::min(step * neck.sphere, C - fused);
    const double middle = C - 0.5 * down, S = sphereAt(middle);
    const double needs = down * law.time(T_, sizeOf(primaries, neck, middle, S)) / (middle - S);
    if (time + needs > dt) {
      const double common = std::max(C - down * (dt - time) / needs, fused);
      return {common, sphereAt(common), never};
    }
    time += needs;
    C -= down;
    if (C <= fused * (1 + 1e-14)) return {fused, sphereAt(fused), time};
  }
}

void TreeSintering::sizePrimaries(TreeHead& tree) const {
  TreePrimary* primaries = primariesOf(&tree);
  for (std::uint32_t i = 0; i < tree.count; ++i)
    primaries[i].diameter = treeDiameter(type_.material().volume(primaries[i].units));
}

// Half of the sites from each (eq. 45); each primary as many as it has. Sizes are left to sizePrimaries().
void TreeSintering::loseSites(TreePrimary* primaries, const TreeNeck& neck, double sites, Changes& changes) const {
  if (!(sites > 0)) return;
  const SiteReactions& m = *type_.material().sites();
  for (const std::uint32_t i : {neck.left, neck.right}) {
    TreePrimary& p = primaries[i];
    const double taken = std::min(0.5 * sites, p.units[m.site]);
    if (taken < 0.5 * sites) ++changes.limited;
    p.units[m.site] -= taken;
    p.units[m.bridge] += 0.5 * taken;
    changes.bridges += 0.5 * taken;
  }
}

void TreeSintering::neighbours(Tree& handle, double dt, Changes& changes) {
  TreeHead& tree = handle.own();
  TreePrimary* primaries = primariesOf(&tree);
  TreeNeck* necks = necksOf(&tree);
  const SiteReactions* sites = type_.material().sites();
  // Of sites, kept (Shekar et al. 2011).
  const double density = sites != nullptr ? tree.units[sites->site] / tree.surface : 0;
  courses_.clear();
  left_.assign(tree.count - 1, dt);
  for (std::uint32_t k = 0; k + 1 < tree.count; ++k) courses_.push_back(follow(primaries, necks[k], density, dt));
  const auto bring = [&](std::size_t k, const Course& course) {
    loseSites(primaries, necks[k], density * (necks[k].common - course.common), changes);
    necks[k].common = course.common;
    necks[k].sphere = course.sphere;
  };
  while (tree.count > 1) {
    // The neck that fuses first, in time from the beginning.
    std::size_t k = 0;
    double first = never;
    for (std::size_t n = 0; n < courses_.size(); ++n) {
      const double time = dt - left_[n] + courses_[n].fuses;
      if (time < first) {
        first = time;
        k = n;
      }
    }
    if (first == never) break;
    const std::uint32_t a = necks[k].left, b = necks[k].right;
    // Those beside it up to that time: they go on with other primaries.
    for (std::uint32_t n = 0; n + 1 < tree.count; ++n) {
      const TreeNeck& neck = necks[n];
      if (n == k || !(neck.left == a || neck.left == b || neck.right == a || neck.right == b)) continue;
      bring(n, follow(primaries, neck, density, first - (dt - left_[n])));
      left_[n] = -1;
    }
    bring(k, courses_[k]);
    // What is known of necks travels with them, as fuseNeck() moves them.
    const auto start = static_cast<std::ptrdiff_t>(necks[k].first), place = static_cast<std::ptrdiff_t>(k);
    const std::ptrdiff_t behind = place + static_cast<std::ptrdiff_t>(b) - (place + 1);
    fuse(tree, k);
    courses_.erase(courses_.begin() + place);
    left_.erase(left_.begin() + place);
    std::rotate(courses_.begin() + start, courses_.begin() + place, courses_.begin() + behind);
    std::rotate(left_.begin() + start, left_.begin() + place, left_.begin() + behind);
    for (std::size_t n = 0; n < left_.size(); ++n) {
      if (left_[n] >= 0) continue;
      left_[n] = dt - first;
      courses_[n] = follow(primaries, necks[n], density, left_[n]);
    }
    ++changes.fused;
  }
  for (std::uint32_t k = 0; k + 1 < tree.count; ++k) bring(k, courses_[k]);
  sizePrimaries(tree);
}

std::size_t TreeSintering::fuse(TreeHead& tree, std::size_t k) {
  const TreeNeck& neck = necksOf(&tree)[k];
  if (fusions_ != nullptr) fusions_->push_back({neck.first, static_cast<std::uint32_t>(k), neck.left, neck.right});
  return fuseNeck(tree, k, type_.material());
}

void TreeSintering::fuseAll(TreeHead& tree, Changes& changes) {
  const TreeNeck* necks = necksOf(&tree);
  const std::uint32_t count = tree.count;
  for (std::uint32_t k = 0; k + 1 < tree.count;) {
    if (!isFused(necks[k])) {
      ++k;
      continue;
    }
    k = static_cast<std::uint32_t>(fuse(tree, k));
    ++changes.fused;
  }
  if (tree.count != count) type_.measure(tree);
}

// By steps in the surface, at whose middle the characteristic time is taken; the excess over the sphere's surface,
// which shrinks with the sites, goes exponentially in each. A trace of it that is left is nothing.
void TreeSintering::surface(TreeHead& tree, double dt, Changes& changes) const {
  const SinteringLaw& law = type_.material().sintering;
  const SiteReactions& sites = *type_.material().sites();
  if (!law.active()) return;
  TreePrimary& whole = *primariesOf(&tree);
  const double density = whole.units[sites.site] / tree.surface;  // of sites: stays as they go with the surface
  const auto sphereAt = [&](double S) {
    return treeSphere(tree.volume - density * volumeOfSite_ * (tree.surface - S));
  };
  double S = tree.surface, sphere = tree.surfaces, left = dt;
  while (left > 0 && S > sphere) {
    const double excess = S - sphere,
                 down = excess < traceOfSurface * sphere ? excess : std::min(step * S, 0.5 * excess);
    const double slope = (sphere - sphereAt(S - down)) / down;
    const double middle = S - 0.5 * down;
    const double volume = tree.volume - density * volumeOfSite_ * (tree.surface - middle);
    const double tau = law.time(T_, 6 * volume / middle) / (1 - slope);
    if (excess < traceOfSurface * sphere) {
      S -= down / (1 - slope);
      break;
    }
    const double needs = tau * std::log(excess / (excess - (1 - slope) * down));
    S -= needs <= left ? down : -std::expm1(-left / tau) * excess / (1 - slope);
    sphere = sphereAt(S);
    left -= needs;
  }
  const double gone = density * (tree.surface - S);
  whole.units[sites.site] -= gone;
  whole.units[sites.bridge] += 0.5 * gone;
  changes.bridges += 0.5 * gone;
  tree.surface = S;
  sizePrimaries(tree);
}

// How long nothing has to be done, and how fast surface goes now.
void TreeSintering::rest(TreeHead& tree, double time) {
  const SinteringLaw& law = type_.material().sintering;
  tree.time = time;
  tree.sintering = 0;
  tree.rest = never;
  if (!isAggregate(tree) || !law.active()) return;
  if (TreeSpheres* spheres = type_.spheres()) {
    tree.sintering = spheres->sinteringRate(tree, T_);
    if (tree.sintering > 0) tree.rest = tolerance_ * tree.surfaces / tree.sintering;
    return;
  }
  if (type_.bySurface()) {
    tree.sintering = partRate(tree.volume, tree.surface);
    if (tree.sintering > 0) tree.rest = tolerance_ * tree.surfaces / tree.sintering;
    return;
  }
  const bool ofParts = law.between == SinteringLaw::Between::parts;
  if (ofParts && !fresh_) partRates(tree);
  fresh_ = false;
  double fastest = 0;
  for (std::uint32_t k = 0; k + 1 < tree.count; ++k) {
    const TreeNeck& neck = necksOf(&tree)[k];
    const double rate = ofParts ? rates_[k]
                                : (neck.common - neck.sphere) /
                                      law.time(T_, sizeOf(primariesOf(&tree), neck, neck.common, neck.sphere));
    tree.sintering += rate;
    fastest = std::max(fastest, rate / neck.sphere);
  }
  tree.rest = fastest > 0 ? tolerance_ / fastest : never;
}

void TreeSintering::advance(Tree& tree, double time, Changes& changes) {
  if (!isAggregate(tree.head())) return;
  const SinteringLaw& law = type_.material().sintering;
  const double dt = std::max(0.0, time - tree.head().time);
  if (TreeSpheres* spheres = type_.spheres()) {
    if (law.active()) changes.bridges += spheres->sinter(tree.own(), T_, dt);
    changes.fused += spheres->takeMerged();
    TreeHead& head = tree.own();
    if (law.active()) type_.measure(head);
    rest(head, std::max(time, head.time));
    tree.fit();
    return;
  }
  if (type_.bySurface())
    surface(tree.own(), dt, changes);
  else if (!law.active())
    fuseAll(tree.own(), changes);
  else if (law.between == SinteringLaw::Between::parts)
    parts(tree, dt, changes);
  else
    neighbours(tree, dt, changes);
  TreeHead& head = tree.own();
  if (law.active()) {  // primaries have lost sites, and volume with them
    for (std::uint32_t k = 0; k + 1 < head.count; ++k)
      necksOf(&head)[k].sphere = sphereOfNeck(primariesOf(&head), necksOf(&head)[k]);
    type_.measure(head);
  }
  rest(head, std::max(time, head.time));
  tree.fit();
}

}  // namespace lampblack::particles
