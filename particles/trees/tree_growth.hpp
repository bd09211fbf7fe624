// Surface reactions and reactions within a particle over a time in which no trees meet (Shekar, Smith, Kraft, Wagner
// 2011, eqs. 29-32, 57-59), deferred: each tree takes what happens to it in one go. Few events are drawn one by one,
// with the rates that the sites have after each; many as Poisson numbers for each primary, in steps over which the
// number of sites hardly changes. Rates of a reaction are for all sites of the tree; the primary is drawn uniformly.
#pragma once

#include <cstdint>
#include <vector>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/trees/primary_trees.hpp"

namespace lampblack::particles {

class TreeGrowth {
 public:
  struct Changes {
    double reactions = 0, bridges = 0;  // events at the surface, and within
    std::uint64_t limited = 0;          // within: bounded at zero, and refused as the primary had no pair of sites
  };

  // Of a material with sites.
  explicit TreeGrowth(const PrimaryTrees& type) : type_(type), reactions_(*type.material().sites()) {}

  // 1/s for each site.
  void setRate(double perSite) { rate_ = perSite; }
  // 1/s, of the reaction within a tree with so many sites (eq. 59): below zero where sintering takes more sites than
  // the surface gets.
  [[nodiscard]] double within(const TreeHead& tree, double sites) const;
  // Over dt (s). True where the tree has changed: its necks may have to fuse then.
  bool advance(Tree& tree, double dt, RandomStream& random, Changes& changes);

 private:
  void applySingleEvents(TreeHead& tree, TreePrimary* primaries, double left, RandomStream& random, Changes& changes);
  void applyPoissonNumbers(TreeHead& tree, TreePrimary* primaries, double dt, RandomStream& random, Changes& changes);
  [[nodiscard]] std::size_t drawPrimary(const TreeHead& tree, RandomStream& random) const;
  void react(TreeHead& tree, TreePrimary* primaries, std::size_t i, double events, Changes& changes);
  void condense(TreeHead& tree, TreePrimary* primaries, std::size_t i, double events, Changes& changes);

  static constexpr double fewEvents = 16, sitesChange = 0.1;

  const PrimaryTrees& type_;
  const SiteReactions& reactions_;
  double rate_ = 0;
  bool changed_ = false;
  std::vector<double> grown_;     // by surface reactions, of each primary
  std::vector<double> surfaces_;  // free, of the primaries up to each; of spheres in space
};

}  // namespace lampblack::particles
