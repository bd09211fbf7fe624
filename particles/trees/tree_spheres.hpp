// The geometry of trees whose primaries are overlapping spheres in space (SphereAggregate): what a collision, growth
// and burning, sintering and breaking do to places, radii and necks, and what a tree's surface and sizes are then.
// Units of primaries follow what moves between spheres, so that the mass of a primary over the density is the volume of
// its sphere. docs/theory/spheres.md, "Of trees".
//
// Primaries stand in an order in which each but the first touches one before it: the neck before it is that contact, of
// which it is the right primary, and which stands as the collision of all before it with it alone.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/spheres/ballistic_joining.hpp"
#include "particles/spheres/sphere_growth.hpp"
#include "particles/spheres/sphere_sintering.hpp"
#include "particles/trees/tree_shape.hpp"

namespace lampblack::particles {

class TreeSpheres {
 public:
  // `material` has to stay. InputError for a law of sintering that spheres do not have.
  // `sinteringTolerance`: relative error of a step (SphereSintering).
  TreeSpheres(const TreeMaterial& material, CollisionSize size, double sinteringTolerance);

  // A tree of one primary.
  void start(TreeHead& tree) const;
  // The second tree comes on a straight line; the first has room for its primaries.
  void join(TreeHead& tree, const TreeHead& second, RandomStream& random);
  // Whether they touch on one line, drawn through the disc of both bounding spheres.
  [[nodiscard]] bool hit(const TreeHead& first, const TreeHead& second, RandomStream& random);
  // Primaries have other units than their spheres have volume: what has come or gone does so at the free surface of
  // each. Volume that moves through necks takes units along, and what is swallowed merges. Primaries without units have
  // no size, and their spheres stay for who takes them away.
  void follow(TreeHead& tree);
  // A layer of a thickness (m) on all of the free surface, of the first component.
  void cover(TreeHead& tree, double thickness);
  // Over a time (s) at a temperature (K). Of sites as many stay as there is surface. Returns pairs of them that went.
  double sinter(TreeHead& tree, double temperature, double time);
  // m2/s of surface that goes.
  [[nodiscard]] double sinteringRate(const TreeHead& tree, double temperature);
  // Neck k becomes one sphere of both.
  void fuse(TreeHead& tree, std::size_t k);
  // Spheres that have lost necks: their radii are those of the volumes that they have.
  void close(TreeHead& tree);
  // Sums, necks, surface and diameter of collision, from units and spheres.
  void measure(TreeHead& tree);
  // The free surface of the primaries up to each, m2.
  void sumSurfaces(const TreeHead& tree, std::vector<double>& to);

  [[nodiscard]] std::uint64_t takeMerged() { return std::exchange(merged_, 0); }  // since it was asked for last
  [[nodiscard]] std::uint64_t tries() const { return joining_.tries(); }          // lines drawn by all collisions

 private:
  static void load(const TreeHead& tree, SphereAggregate& to);
  static void store(const SphereAggregate& from, TreeHead& tree);
  // The spheres in aggregate_ get the volumes of these primaries.
  void grow(TreePrimary* primaries);
  // What round-off, or contacts that are lost, have left of that: radii alone.
  void settle(TreePrimary* primaries);
  void mergeUnits(TreePrimary* primaries);
  [[nodiscard]] double radiusOf(std::size_t i, double volume);

  const TreeMaterial& material_;
  CollisionSize size_;
  BallisticJoining joining_;
  SphereGrowth growth_;
  SphereSintering sintering_;
  SphereAggregate aggregate_, second_;
  std::size_t taken_ = 0;  // merges of aggregate_ that the units have taken
  std::uint64_t merged_ = 0;
  std::vector<double> due_, through_, volumes_, necks_;
  std::vector<SphereSurfaces> surfaces_;
};

}  // namespace lampblack::particles
