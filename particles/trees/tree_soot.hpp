// A population of trees of soot in a gas: nuclei of PAH, condensation, growth and oxidation in whole events, deferred
// over a step of splitting, by the laws of all populations of soot (SootMedium, soot_steps.hpp). Inside of TreeProcess.
//
// A tree grows as so many equal primaries as have its volume and surface: n_r = S^3/(36 pi V^2) of the diameter 6 V/S
// (Shekar, Smith, Kraft, Wagner 2011, eq. 19), which are a sphere's where it is one. An event
// of the tree acts on a primary with the probability of its share of the surface. The tree breaks at its necks
// (TreeFragmentation) for half of the step before that and for half of it after.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "particles/soot/soot_events.hpp"
#include "particles/soot/soot_steps.hpp"
#include "particles/trees/tree_fragmentation.hpp"
#include "particles/trees/tree_sites.hpp"

namespace lampblack::particles {

class TreeSoot {
 public:
  struct Sums : SootSums {
    double breaking = 0;  // 1/m3/s for each kg/m2/s of oxidation: how often trees break at their necks
  };
  static constexpr bool dependsOnSums = true;

  explicit TreeSoot(const PrimaryTrees& type);

  void add(Sums& sums, const TreeHead& tree, double weight) const;
  void setGas(const ParticleGas& gas, const CollisionKernel&);
  [[nodiscard]] double inception(const Sums& sums, double dt) const;
  [[nodiscard]] TreeUnits nucleus() const;
  [[nodiscard]] double step(const Sums& sums, const CollisionKernel* kernel, double tolerance, double remaining);

  void begin(const Sums& sums, double dt);
  [[nodiscard]] bool isActive() const { return medium_->condensing() || medium_->surfaceActive(); }
  TreeFate grow(Tree& tree, RandomStream& random);
  // Adds the event rates of `number` trees (1/m3) during growth.
  void addRates(TreeRates& rates, const TreeHead& tree, double number) const {
    rates.fragmentations += number * growth_->oxidation() * fragmentation_.perOxidation(tree);
  }
  // What trees that grew since this was asked for last have lost: parts that a burnt primary held, and sides of necks
  // that broke.
  [[nodiscard]] std::vector<Tree> takeFragments() { return std::exchange(fragments_, {}); }

  void recordInception(double weight, TreeExchange& exchange) const;
  void recordGrowth(double weight, TreeExchange& exchange, TreeCounters& counters) const;
  void recordSintering(double, double, TreeExchange&) const {}  // no sites go with the surface

 private:
  [[nodiscard]] SootPopulationLaw law(double tolerance) const;
  [[nodiscard]] SootAggregate::Particle asSphere(const TreeHead& tree) const;
  void applyEvents(TreePrimary* primaries, std::size_t i, std::size_t kind, double times);
  void sumSurfaces(const TreeHead& tree);
  void applySingleEvents(TreeHead& tree, const SootEventNumbers& expected, double left, RandomStream& random);
  void applyPoissonNumbers(TreeHead& tree, const SootEventNumbers& expected, RandomStream& random);
  TreeFate react(Tree& tree, RandomStream& random);
  TreeFate withoutBurnt(Tree& tree);
  void breakUp(Tree& tree, RandomStream& random, std::vector<Tree>& parts);

  static constexpr double fewEvents = 8;

  const PrimaryTrees& type_;
  const SootReactions& reactions_;
  DimerModel dimers_;
  double carbonAtom_, hydrogenAtom_;  // kg
  std::optional<SootMedium> medium_;
  const CollisionKernel* kernel_ = nullptr;  // null: no coagulation
  double joined_;
  TreeFragmentation fragmentation_;
  // Of the time of growth.
  double dt_ = 0;
  std::optional<SootGrowth> growth_;
  SootTransfer moved_;
  std::uint64_t burntPrimaries_ = 0, burnt_ = 0, broken_ = 0, fragmentations_ = 0;
  double events_[sootEvents] = {};
  std::vector<Tree> fragments_, pieces_;
  std::vector<double> surfaces_, change_;  // m2, sums up to each primary; m3, of each
  std::vector<std::uint32_t> changed_;     // primaries that had events
};

}  // namespace lampblack::particles
