// Trees of primaries as a type of particles (particle_type.hpp): how they are made and joined. They have no mean and no
// pieces, so that methods that merge particles of different weights, or break them, do not take them: between two
// trees there is no tree with the mean of all that belongs to them.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/population/model/particle_type.hpp"
#include "particles/trees/tree_fusing.hpp"
#include "particles/trees/tree_spheres.hpp"

namespace lampblack::particles {

class PrimaryTrees {
 public:
  using Particle = Tree;
  static constexpr bool moreThanVolume = true;

  // `sphereTolerance`: of spheres in space (TreeSpheres).
  PrimaryTrees(const TreeMaterial& material, CollisionSize size, TreeShape shape = TreeShape::primaries,
               double sphereTolerance = 1e-4)
      : material_(std::make_shared<TreeMaterial>(material)),
        pool_(std::make_shared<TreePool>(shape == TreeShape::spheres)),
        size_(size),
        shape_(shape) {
    if (shape == TreeShape::spheres) spheres_ = std::make_shared<TreeSpheres>(*material_, size, sphereTolerance);
  }

  [[nodiscard]] bool bySurface() const { return shape_ == TreeShape::surfaceVolume; }

  [[nodiscard]] TreeSpheres* spheres() const { return spheres_.get(); }  // null of other shapes

  [[nodiscard]] const TreeMaterial& material() const { return *material_; }
  [[nodiscard]] TreePool& pool() const { return *pool_; }

  [[nodiscard]] double volume(const Tree& p) const { return p.head().volume; }
  [[nodiscard]] double mass(const Tree& p) const { return p.head().volume * material_->density; }
  [[nodiscard]] double surface(const Tree& p) const { return p.head().surface; }
  [[nodiscard]] double collisionDiameter(const Tree& p) const { return p.head().collision; }
  [[nodiscard]] double fractalDimension() const { return material_->fractalDimension; }

  // One primary.
  [[nodiscard]] Tree make(const TreeUnits& units) const {
    TreeHead* head = pool_->allocate(1);
    head->count = 1;
    *primariesOf(head) = {units, treeDiameter(material_->volume(units))};
    if (spheres_) spheres_->start(*head);
    measure(*head);
    return Tree(head);
  }
  // A single primary of this volume, for methods that ask for one; no process makes such a particle.
  [[nodiscard]] Tree make(double volume) const {
    TreeUnits units{1};
    units[0] = volume / material_->volume(units);
    return make(units);
  }
  // Whether a line drawn for both has them touch; by laws of collision alone they always do.
  [[nodiscard]] bool meet(const Tree& p, const Tree& q, RandomStream& random) const {
    return size_ != CollisionSize::lines || spheres_->hit(p.head(), q.head(), random);
  }
  // In point contact at a primary of each, drawn uniformly (eq. 35); of spheres in space where they touch. Those of the
  // smaller tree move.
  [[nodiscard]] Tree coagulated(Tree&& p, Tree&& q, RandomStream& random) const {
    for (Tree* one : {&p, &q})
      if (waitsForSintering(one->head(), clock()) && shared_->sinter) shared_->sinter(*one, clock());
    if (bySurface()) return withSurfaceOfBoth(std::move(p), q);
    if (p.count() < q.count()) p.swap(q);
    const std::size_t n = p.count(), m = q.count();
    const TreeHead& other = q.head();
    if (spheres_) {
      TreeHead& tree = p.own(n + m);
      spheres_->join(tree, other, random);
      measure(tree);
      tree.sintering += other.sintering;
      return sinteredOn(std::move(p));
    }
    const TreeNeck contact = contactOf(p, q, random);
    // Where nothing sinters and no other neck waits to be looked at, the contact alone may be fused.
    const bool isAlone = !material_->sintering.active() && looksOn() && isSettled(p.head()) && isSettled(other);
    if (isAlone && m == 1 && isFused(contact)) return absorbed(std::move(p), other, contact.left);
    TreeHead& tree = p.own(n + m);
    TreePrimary* primaries = primariesOf(&tree);
    TreeNeck* necks = necksOf(&tree);
    std::copy_n(q.primaries().data(), m, primaries + n);
    const auto shift = static_cast<std::uint32_t>(n);
    for (std::size_t k = 0; k + 1 < m; ++k) {
      TreeNeck neck = q.necks()[k];
      for (std::uint32_t* index : {&neck.left, &neck.right, &neck.first, &neck.last}) *index += shift;
      necks[n + k] = neck;
    }
    necks[n - 1] = contact;
    tree.count += other.count;
    for (std::size_t c = 0; c < mostTreeComponents; ++c) tree.units[c] += other.units[c];
    tree.volume += other.volume;
    tree.diameters += other.diameters;
    tree.surfaces += other.surfaces;
    tree.levels += other.levels + sinteringLevel(contact);
    tree.sintering += other.sintering;
    shape(tree);
    return isAlone && !isFused(contact) ? resting(std::move(p)) : sinteredOn(std::move(p));
  }

  // Time (s) up to which trees have sintered when they collide.
  [[nodiscard]] double& clock() const { return shared_->clock; }
  // Time (s) at which all trees are brought up to date next.
  void setNextUpdate(double time) const { shared_->nextUpdate = time; }
  // Single primaries that were one with what they touched since the last call, in collisions.
  [[nodiscard]] std::uint64_t takeAbsorbed() const { return std::exchange(shared_->absorbed, 0); }
  // The function that sinters a tree up to a time (s).
  void setSintering(std::function<void(Tree&, double time)> sinter) const { shared_->sinter = std::move(sinter); }

  // By volume and surface the surface stays as it is, where it can.
  void measure(TreeHead& tree) const {
    if (spheres_) return spheres_->measure(tree);
    const double surface = tree.surface;
    measureTree(tree, 1 / material_->fractalDimension, size_);
    if (!bySurface()) return;
    tree.surface = surface;
    shapeBySurface(tree, 1 / material_->fractalDimension);
  }
  void shape(TreeHead& tree) const { shapeTree(tree, 1 / material_->fractalDimension, size_); }

 private:
  // In point contact, as it stands in the joined tree.
  [[nodiscard]] static TreeNeck contactOf(const Tree& p, const Tree& q, RandomStream& random) {
    const auto n = static_cast<std::uint32_t>(p.count()), m = static_cast<std::uint32_t>(q.count());
    const auto left = static_cast<std::uint32_t>(random.below(n)), right = static_cast<std::uint32_t>(random.below(m));
    const std::array<TreePrimary, 2> both{p.primaries()[left], q.primaries()[right]};
    const double common = primarySurface(both[0].diameter) + primarySurface(both[1].diameter);
    const double sphere = sphereOfNeck(both.data(), {0, 0, 0, 1, 0, 1});
    return {common, sphere, left, n + right, 0, n + m - 1};
  }
  // The joined tree sinters until the next update, at the rate it has half-way there.
  [[nodiscard]] bool looksOn() const { return shared_->sinter && shared_->nextUpdate > clock(); }
  [[nodiscard]] double halfWay() const { return 0.5 * (clock() + shared_->nextUpdate); }
  [[nodiscard]] Tree sinteredOn(Tree&& p) const {
    TreeHead& tree = p.own();
    tree.time = clock();
    tree.rest = 0;
    if (looksOn()) shared_->sinter(p, halfWay());
    return std::move(p);
  }
  // As sintered on, where there is nothing to do.
  [[nodiscard]] static bool isSettled(const TreeHead& tree) { return tree.count == 1 || std::isinf(tree.rest); }
  [[nodiscard]] Tree resting(Tree&& p) const {
    TreeHead& tree = p.own();
    tree.time = halfWay();
    tree.rest = std::numeric_limits<double>::infinity();
    tree.sintering = 0;
    return std::move(p);
  }
  // With a single primary that is one with the one that it has touched: as joined and sintered on.
  [[nodiscard]] Tree absorbed(Tree&& p, const TreeHead& single, std::uint32_t at) const {
    TreeHead& tree = p.own();
    const bool isDone = absorb(tree, at, single.units, *material_);
    measure(tree);
    ++shared_->absorbed;
    return isDone ? resting(std::move(p)) : sinteredOn(std::move(p));
  }
  [[nodiscard]] Tree withSurfaceOfBoth(Tree&& p, const Tree& q) const {
    TreeHead& tree = p.own();
    TreePrimary& whole = *primariesOf(&tree);
    for (std::size_t c = 0; c < mostTreeComponents; ++c) whole.units[c] += q.head().units[c];
    whole.diameter = treeDiameter(material_->volume(whole.units));
    tree.surface += q.head().surface;
    tree.sintering += q.head().sintering;
    measure(tree);
    return sinteredOn(std::move(p));
  }

  struct Shared {
    double clock = 0, nextUpdate = 0;
    std::uint64_t absorbed = 0;
    std::function<void(Tree&, double)> sinter;
  };
  std::shared_ptr<const TreeMaterial> material_;
  std::shared_ptr<TreePool> pool_;
  std::shared_ptr<TreeSpheres> spheres_;
  std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
  CollisionSize size_;
  TreeShape shape_;
};

}  // namespace lampblack::particles
