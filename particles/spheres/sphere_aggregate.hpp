// An aggregate of overlapping spheres with places in space (Lindberg, Manuputty, Yapp, Akroyd, Xu, Kraft 2019): a tree
// of spheres, each joined to one before it by a neck, the circle of both. Overlaps of spheres that are not neighbours
// in the tree are not counted. Lengths in m, or any one unit. docs/theory/spheres.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/modules.hpp"
#include "core/vector3.hpp"

namespace lampblack::particles {

struct AggregateSphere {
  Vector3 centre{};  // from the centre of mass
  double radius = 0;
  double volume = 0;         // what its necks leave of the sphere: its mass over the density
  double neck = 0;           // square of the radius of the neck with `parent`, 0 in point contact
  std::uint32_t parent = 0;  // stands before this one; of the first one itself
};

// The free surface of each sphere, and what changes of its radius change of its volume where its necks keep their
// radius: the free surface, and each neck's area times radius over distance of plane.
struct SphereSurfaces {
  double free = 0, withNecks = 0;
};

// One sphere became one with the sphere that it was joined to, which stays; those behind the one that went moved up.
struct SphereMerge {
  std::size_t stays = 0, gone = 0;
};

class SphereAggregate {
 public:
  SphereAggregate() = default;
  explicit SphereAggregate(double radius);
  // As they are said: volumes from the geometry. InputError for what is not a tree.
  explicit SphereAggregate(std::vector<AggregateSphere> spheres);
  // Spheres of another aggregate, as they are.
  void copy(std::span<const AggregateSphere> spheres);

  [[nodiscard]] std::size_t count() const { return spheres_.size(); }
  [[nodiscard]] std::span<const AggregateSphere> spheres() const { return spheres_; }
  [[nodiscard]] double reach() const { return reach_; }  // radius of the sphere about the centre of mass that holds all

  // Distance of the centres of sphere k > 0 and its parent, as radii and neck have it.
  [[nodiscard]] double distance(std::size_t k) const;
  [[nodiscard]] double volume() const;
  [[nodiscard]] double surface() const;
  // One entry a sphere.
  void surfaces(std::vector<SphereSurfaces>& to) const;
  // The volumes that radii and necks have; those that are kept in step with them differ by round-off.
  void geometricVolumes(std::vector<double>& to) const;

  // For changes. Whoever changes radii or necks says so by place(), which moves spheres along the lines of their
  // centres to the distances of their necks, all behind a neck with it, and sets the centre of mass to zero.
  std::vector<AggregateSphere>& change() { return spheres_; }
  void place();
  // Spheres that are due become one with their neighbour, at the mean of both centres by volume; the necks of both with
  // others keep their areas. Due are the two of a neck as wide as `widest` of the smaller radius, and a sphere without
  // a free surface, with the neighbour of its widest neck. Returns how many; `followed`, where given, is set to where
  // that sphere is now.
  std::size_t mergeDue(std::size_t* followed = nullptr);
  static constexpr double widest = 0.95;
  // Sphere k > 0 becomes one with its parent, due or not. place() is left to the caller.
  void mergeWithParent(std::size_t k);
  // All that have become one since copy(), in their order.
  [[nodiscard]] std::span<const SphereMerge> merges() const { return merges_; }

 private:
  void merge(std::size_t k);  // sphere k > 0 and its parent
  [[nodiscard]] std::size_t dueNeck(std::vector<SphereSurfaces>& surfaces) const;
  [[nodiscard]] std::size_t widestNeckOf(std::size_t i) const;

  std::vector<AggregateSphere> spheres_;
  std::vector<SphereMerge> merges_;
  double reach_ = 0;
};

// The radius of a sphere of which caps behind necks, given by the squares of their radii, leave a volume; NaN where
// there is none. Begins from a guess.
[[nodiscard]] double radiusOfVolume(double volume, std::span<const double> necks, double guess);

}  // namespace lampblack::particles
