// A population of trees whose material has sites, in a gas with its precursor: what is born, how sites react, how long
// a step of splitting may be, and what the gas gives and gets. Inside of TreeProcess.
#pragma once

#include "core/modules.hpp"
#include "particles/population/model/collision_kernel.hpp"
#include "particles/trees/tree_growth.hpp"
#include "particles/trees/tree_options.hpp"

namespace lampblack::particles {

enum class TreeFate { same, changed, gone };

class TreeSites {
 public:
  // Per m3, of a population.
  struct Sums {
    double number = 0, volume = 0, sites = 0, diameters = 0;
  };
  // The species of the gas.
  enum : std::size_t { precursor, product };
  // Whether the processes depend on sums over the population, besides the length of a step.
  static constexpr bool dependsOnSums = false;

  explicit TreeSites(const PrimaryTrees& type) : type_(type), reactions_(*type.material().sites()), growth_(type) {}

  void add(Sums& sums, const TreeHead& tree, double weight) const {
    sums.number += weight;
    sums.volume += weight * tree.volume;
    sums.sites += weight * tree.units[reactions_.site];
    sums.diameters += weight * tree.collision;
  }
  // Sets the gas. `kernel`: of collisions in this gas, also where particles do not coagulate.
  void setGas(const ParticleGas& gas, const CollisionKernel& kernel);
  // Nuclei per m3 and s in the middle of a time dt, and their units.
  [[nodiscard]] double inception(const Sums&, double) const { return inception_; }
  [[nodiscard]] TreeUnits nucleus() const { return reactions_.nucleus; }
  // The step (s) in which neither growth changes the volume, nor coagulation the number, by more than the tolerance;
  // and what is born in it hardly does either. `kernel`: null without coagulation.
  [[nodiscard]] double step(const Sums& sums, const CollisionKernel* kernel, double tolerance, double remaining) const;

  // A time of growth: begin() once, then grow() for each tree.
  void begin(const Sums&, double dt) {
    dt_ = dt;
    grown_ = {};
  }
  [[nodiscard]] bool isActive() const { return rate_ > 0; }
  TreeFate grow(Tree& tree, RandomStream& random) {
    return growth_.advance(tree, dt_, random, grown_) ? TreeFate::changed : TreeFate::same;
  }

  // Adds the event rates of `number` trees (1/m3).
  void addRates(TreeRates& rates, const TreeHead& tree, double number) const {
    const double sites = tree.units[reactions_.site];
    rates.reactions += number * rate_ * sites;
    rates.condensations += number * std::max(0.0, growth_.within(tree, sites));
  }

  // Add the transferred amounts of one inception, of all growth since begin(), and of `pairs` of sites that sintered,
  // times the weight (1/m3).
  void recordInception(double weight, TreeExchange& exchange) const;
  void recordGrowth(double weight, TreeExchange& exchange, TreeCounters& counters) const;
  void recordSintering(double weight, double pairs, TreeExchange& exchange) const;

 private:
  void recordPairs(double number, TreeExchange& exchange) const;

  const PrimaryTrees& type_;
  const SiteReactions& reactions_;
  TreeGrowth growth_;
  TreeGrowth::Changes grown_;
  double inception_ = 0, rate_ = 0, dt_ = 0;  // 1/m3/s; 1/s for each site; s
};

}  // namespace lampblack::particles
