// Sintering of a tree over a time, by its necks: the surface of each relaxes to that of the sphere of its two primaries
// (Shekar, Smith, Kraft, Wagner 2011, eqs. 40-43), sites go with the surface (eqs. 45-50), and primaries become one at
// a level of 0.95 (eqs. 44, 52-55), each at its own time. Between such times the law is linear and integrated exactly
// where it asks for the smaller primary, at its size when a look begins; by steps of at most `step` of the sphere's
// surface otherwise.
//
// Sites that go take mass along, so that the sphere shrinks as its neck does (eqs. 40, 43, 45 together, in the limit of
// small steps): by a straight line in the common surface, exact at both of its ends. What a primary loses at one neck
// its others see when the tree is brought up to date, which `tolerance` says how often.
//
// By volume and surface the whole is what relaxes, dS/dt = -(S - S_sphere)/tau(6V/S) (Koch, Friedlander 1990), and
// sites go with its surface.
//
// A neck whose primaries are fused with another hands its level on, as far as point contact allows: the paper leaves
// open what becomes of it.
#pragma once

#include <cstdint>
#include <vector>

#include "core/modules.hpp"
#include "particles/trees/primary_trees.hpp"
#include "particles/trees/tree_fusing.hpp"

namespace lampblack::particles {

// Two primaries that became one: the right one's place and that of the left one, in whose place the new one stands
// before the others move (fuseNeck()).
struct FusedPrimaries {
  std::uint32_t first = 0, neck = 0, left = 0, right = 0;
};

class TreeSintering {
 public:
  struct Changes {
    double bridges = 0;         // pairs of sites that became a bridge, each with a molecule of the product
    std::uint64_t fused = 0;    // pairs of primaries
    std::uint64_t limited = 0;  // times a primary had fewer sites than should have gone
  };

  // `tolerance`: by what part of the sphere's surface a neck may change before its tree is brought up to date.
  explicit TreeSintering(const PrimaryTrees& type, double tolerance);

  void setTemperature(double kelvin) { T_ = kelvin; }
  // To a time of the clock; also fuses what growth has left at the level of one primary. A tree that is there already
  // stays. Its sums are those of its primaries and necks, before and after.
  void advance(Tree& tree, double time, Changes& changes);
  // The same, but for trees that may wait.
  void advanceLazily(Tree& tree, Changes& changes) {
    const TreeHead& head = tree.head();
    if (isAggregate(head) && type_.clock() - head.time >= head.rest) advance(tree, type_.clock(), changes);
  }

  // Each fusion of primaries is told to `fusions`, for who keeps more of primaries than a tree does; null: not.
  void tell(std::vector<FusedPrimaries>* fusions) { fusions_ = fusions; }

  static constexpr double step = 0.005;

 private:
  struct Course {
    double common = 0, sphere = 0;  // m2 at the end, or where it fuses
    double fuses = 0;               // s from the beginning; infinite
  };
  // What goes with the surface of a neck: where its primaries are one, m2, and the sphere's surface and the volume that
  // a m2 takes along.
  struct Shrinking {
    double fused = 0, sphere = 0, volume = 0;
  };
  // `density`: sites in a m2.
  [[nodiscard]] Shrinking shrinking(const TreePrimary* primaries, const TreeNeck& neck, double density) const;
  [[nodiscard]] double sizeOf(const TreePrimary* primaries, const TreeNeck& neck, double common, double sphere) const;
  [[nodiscard]] Course follow(const TreePrimary* primaries, const TreeNeck& neck, double density, double dt) const;
  void neighbours(Tree& tree, double dt, Changes& changes);
  void parts(Tree& tree, double dt, Changes& changes);
  void surface(TreeHead& tree, double dt, Changes& changes) const;
  std::size_t partRates(TreeHead& tree);
  [[nodiscard]] double partRate(double volume, double surface) const;
  [[nodiscard]] bool fuseAtOnce(TreeHead& tree, std::size_t whole, double dt);
  void losePartSites(TreeHead& tree, Changes& changes);
  void loseSites(TreePrimary* primaries, const TreeNeck& neck, double sites, Changes& changes) const;
  void sizePrimaries(TreeHead& tree) const;
  // The tree is measured where any did.
  void fuseAll(TreeHead& tree, Changes& changes);
  void rest(TreeHead& tree, double time);
  std::size_t fuse(TreeHead& tree, std::size_t k);

  const PrimaryTrees& type_;
  double tolerance_, T_ = 0;
  std::vector<FusedPrimaries>* fusions_ = nullptr;
  double volumeOfSite_ = 0;  // m3 that a site takes along as it becomes half a bridge
  bool fresh_ = false;       // rates_ are those of the tree that has just changed, hardly
  std::vector<Course> courses_;
  std::vector<double> left_;                        // s, of each neck
  std::vector<double> volumes_, surfaces_, sites_;  // sums over the primaries before each
  std::vector<double> rates_, starts_, densities_;  // of each neck: m2/s; m2 at the beginning; sites in a m2
  std::vector<Shrinking> shrinkings_;
};

}  // namespace lampblack::particles
