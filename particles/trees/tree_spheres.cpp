#include "particles/trees/tree_spheres.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "particles/spheres/sphere_geometry.hpp"
#include "particles/spheres/sphere_measures.hpp"

namespace lampblack::particles {
namespace {

constexpr double roundOff = 1e-11;    // of a volume: what sums may have lost
constexpr double sitesInStep = 1e-9;  // of the sites, up to which they are as many as there is surface

const SinteringLaw& checkedLaw(const TreeMaterial& material) {
  if (material.sintering.between == SinteringLaw::Between::parts)
    throw InputError("particles: spheres in space sinter between neighbours, not between parts");
  if (material.sintering.active() && material.sintering.size != SinteringLaw::Size::smaller)
    throw InputError("particles: the law of sintering of spheres in space has the size of the smaller neighbour");
  return material.sintering;
}

}  // namespace

TreeSpheres::TreeSpheres(const TreeMaterial& material, CollisionSize size, double sinteringTolerance)
    : material_(material), size_(size), sintering_(checkedLaw(material), sinteringTolerance) {}

void TreeSpheres::start(TreeHead& tree) const {
  const TreePrimary& primary = *primariesOf(&tree);
  *spheresOf(&tree) = {{}, 0.5 * primary.diameter, material_.volume(primary.units), 0, 0};
}

void TreeSpheres::load(const TreeHead& tree, SphereAggregate& to) {
  to.copy({spheresOf(const_cast<TreeHead*>(&tree)), tree.count});
}

void TreeSpheres::store(const SphereAggregate& from, TreeHead& tree) {
  tree.count = static_cast<std::uint32_t>(from.count());
  std::ranges::copy(from.spheres(), spheresOf(&tree));
  for (std::uint32_t k = 1; k < tree.count; ++k) necksOf(&tree)[k - 1] = {0, 0, from.spheres()[k].parent, k, 0, k};
}

bool TreeSpheres::hit(const TreeHead& first, const TreeHead& second, RandomStream& random) {
  load(first, aggregate_);
  load(second, second_);
  return joining_.draw(aggregate_, second_, random).has_value();
}

void TreeSpheres::join(TreeHead& tree, const TreeHead& second, RandomStream& random) {
  load(tree, aggregate_);
  load(second, second_);
  const SphereContact at = joining_.meet(aggregate_, second_, random);
  TreePrimary* primaries = primariesOf(&tree) + tree.count;
  for (const std::size_t i : rootedAt(second_.spheres(), at.second).order)
    *primaries++ = primariesOf(const_cast<TreeHead*>(&second))[i];
  store(joinedAt(joining_.firstPlaces(), aggregate_, joining_.secondPlaces(), second_, {0, 0, at.height}, at.first,
                 at.second),
        tree);
}

void TreeSpheres::mergeUnits(TreePrimary* primaries) {
  const auto merges = aggregate_.merges();
  std::size_t count = aggregate_.count() + merges.size() - taken_;
  for (; taken_ < merges.size(); ++taken_) {
    const auto [stays, gone] = merges[taken_];
    for (std::size_t c = 0; c < mostTreeComponents; ++c) primaries[stays].units[c] += primaries[gone].units[c];
    std::copy(primaries + gone + 1, primaries + count, primaries + gone);
    --count;
    ++merged_;
  }
}

void TreeSpheres::grow(TreePrimary* primaries) {
  if (aggregate_.count() == 1) return settle(primaries);
  for (bool isDone = false; !isDone;) {
    due_.assign(aggregate_.count(), 0.0);
    for (std::size_t i = 0; i < aggregate_.count(); ++i)
      if (const double volume = material_.volume(primaries[i].units); volume > 0)
        due_[i] = volume - aggregate_.spheres()[i].volume;
    isDone = growth_.step(aggregate_, due_, through_);
    for (std::size_t k = aggregate_.count(); k-- > 1;) {
      const std::size_t parent = aggregate_.spheres()[k].parent;
      const std::size_t from = through_[k] > 0 ? parent : k, to = through_[k] > 0 ? k : parent;
      const double there = material_.volume(primaries[from].units);
      if (!(there > 0) || !(material_.volume(primaries[to].units) > 0)) continue;
      const double share = std::min(std::abs(through_[k]) / there, 1.0);
      for (std::size_t c = 0; c < mostTreeComponents; ++c) {
        const double moved = share * primaries[from].units[c];
        primaries[from].units[c] -= moved;
        primaries[to].units[c] += moved;
      }
    }
    if (aggregate_.mergeDue() == 0)
      aggregate_.place();
    else
      mergeUnits(primaries);
  }
  settle(primaries);
}

double TreeSpheres::radiusOf(std::size_t i, double volume) {
  const auto spheres = aggregate_.spheres();
  necks_.clear();
  for (std::size_t k = 1; k < spheres.size(); ++k)
    if (k == i || spheres[k].parent == i) necks_.push_back(spheres[k].neck);
  const double radius = radiusOfVolume(volume, necks_, spheres[i].radius);
  // Too little for its necks: as wide as merges with the widest.
  return radius > 0 ? radius : std::sqrt(*std::ranges::max_element(necks_)) * (1 + roundOff);
}

void TreeSpheres::settle(TreePrimary* primaries) {
  while (true) {
    aggregate_.geometricVolumes(volumes_);
    bool isNew = false;
    for (std::size_t i = 0; i < aggregate_.count(); ++i) {
      AggregateSphere& s = aggregate_.change()[i];
      const double volume = material_.volume(primaries[i].units);
      primaries[i].diameter = volume > 0 ? treeDiameter(volume) : 0;
      s.volume = volume;
      if (!(volume > 0) || std::abs(volumes_[i] - volume) <= roundOff * volume) continue;
      s.radius = radiusOf(i, volume);
      isNew = true;
    }
    if (!isNew) return;
    if (aggregate_.mergeDue() == 0) {
      aggregate_.place();
      return;
    }
    mergeUnits(primaries);
  }
}

void TreeSpheres::follow(TreeHead& tree) {
  load(tree, aggregate_);
  taken_ = 0;
  TreePrimary* primaries = primariesOf(&tree);
  grow(primaries);
  store(aggregate_, tree);
}

void TreeSpheres::cover(TreeHead& tree, double thickness) {
  load(tree, aggregate_);
  taken_ = 0;
  TreePrimary* primaries = primariesOf(&tree);
  growEverywhere(aggregate_, thickness);
  mergeUnits(primaries);
  const double unit = material_.volume({1});
  for (std::size_t i = 0; i < aggregate_.count(); ++i)
    primaries[i].units[0] += (aggregate_.spheres()[i].volume - material_.volume(primaries[i].units)) / unit;
  settle(primaries);
  store(aggregate_, tree);
}

double TreeSpheres::sinter(TreeHead& tree, double temperature, double time) {
  load(tree, aggregate_);
  taken_ = 0;
  TreePrimary* primaries = primariesOf(&tree);
  const SiteReactions* sites = material_.sites();
  double number = 0, pairs = 0;
  if (sites != nullptr)
    for (std::size_t i = 0; i < tree.count; ++i) number += primaries[i].units[sites->site];
  const double density = number / aggregate_.surface();
  sintering_.advance(aggregate_, temperature, time);
  mergeUnits(primaries);
  settle(primaries);
  // Sites take volume along, and the surface shrinks with it.
  for (double gone; number > 0 && (gone = number - density * aggregate_.surface()) > sitesInStep * number;) {
    for (std::size_t i = 0; i < aggregate_.count(); ++i) {
      const double taken = primaries[i].units[sites->site] * (gone / number);
      primaries[i].units[sites->site] -= taken;
      primaries[i].units[sites->bridge] += 0.5 * taken;
      pairs += 0.5 * taken;
    }
    number -= gone;
    grow(primaries);
  }
  store(aggregate_, tree);
  return pairs;
}

double TreeSpheres::sinteringRate(const TreeHead& tree, double temperature) {
  if (tree.count == 1 || !material_.sintering.active()) return 0;
  load(tree, aggregate_);
  return sintering_.surfaceRate(aggregate_, temperature);
}

void TreeSpheres::fuse(TreeHead& tree, std::size_t k) {
  load(tree, aggregate_);
  taken_ = 0;
  aggregate_.mergeWithParent(k + 1);
  mergeUnits(primariesOf(&tree));
  settle(primariesOf(&tree));
  aggregate_.place();
  store(aggregate_, tree);
}

void TreeSpheres::close(TreeHead& tree) {
  load(tree, aggregate_);
  taken_ = 0;
  settle(primariesOf(&tree));
  aggregate_.place();
  store(aggregate_, tree);
}

void TreeSpheres::measure(TreeHead& tree) {
  load(tree, aggregate_);
  const auto spheres = aggregate_.spheres();
  const TreePrimary* primaries = primariesOf(&tree);
  for (std::uint32_t k = 0; k + 1 < tree.count; ++k) {
    TreeNeck& neck = necksOf(&tree)[k];
    // The level of a neck is that of its two spheres without others.
    double surface = 0, volume = 0;
    for (const double r : {spheres[neck.left].radius, spheres[neck.right].radius}) {
      const double x = planeOfNeck(r, spheres[neck.right].neck);
      surface += surfaceOfRadius(r) - capSurface(r, x);
      volume += volumeOfRadius(r) - capVolume(r, x);
    }
    const bool areThere = primaries[neck.left].diameter > 0 && primaries[neck.right].diameter > 0;
    neck.sphere = areThere ? sphereOfNeck(primaries, neck) : treeSphere(volume);
    neck.common = neck.sphere * (surface / treeSphere(volume));
  }
  sumTree(tree);
  tree.surface = tree.count == 1 ? tree.surfaces : aggregate_.surface();
  if (tree.count == 1)
    tree.collision = tree.diameters;
  else if (size_ == CollisionSize::shadow)
    tree.collision = shadowDiameter(shadowAlongAxes(aggregate_));
  else if (size_ == CollisionSize::lines)
    tree.collision = 2 * aggregate_.reach();
  else
    tree.collision = collisionOfSurface(tree, 1 / material_.fractalDimension, size_);
}

void TreeSpheres::sumSurfaces(const TreeHead& tree, std::vector<double>& to) {
  load(tree, aggregate_);
  aggregate_.surfaces(surfaces_);
  to.clear();
  double sum = 0;
  for (const SphereSurfaces& s : surfaces_) to.push_back(sum += std::max(s.free, 0.0));
}

}  // namespace lampblack::particles
