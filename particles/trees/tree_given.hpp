// A population of trees of spheres in space whose births and growth are said from outside, as another run or a table
// has them; the gas says how particles collide and how hot they sinter. Inside of TreeProcess.
#pragma once

#include <algorithm>
#include <limits>

#include "core/modules.hpp"
#include "particles/population/model/newborn_step.hpp"
#include "particles/trees/tree_sites.hpp"

namespace lampblack::particles {

struct GivenSources {
  double births = 0;   // 1/m3/s
  double nucleus = 0;  // m3, of what is born
  double growth = 0;   // m/s, >= 0, by which the free surface moves outward
};

class TreeGiven {
 public:
  struct Sums {
    double number = 0, volume = 0, diameters = 0;
    double smallest = std::numeric_limits<double>::infinity();  // m, of the primaries' diameters
  };
  static constexpr bool dependsOnSums = false;

  explicit TreeGiven(const PrimaryTrees& type) : type_(type) {}
  void setSources(const GivenSources& sources) { sources_ = sources; }

  void add(Sums& sums, const TreeHead& tree, double weight) const {
    sums.number += weight;
    sums.volume += weight * tree.volume;
    sums.diameters += weight * tree.collision;
    const TreePrimary* primaries = primariesOf(const_cast<TreeHead*>(&tree));
    for (std::uint32_t i = 0; i < tree.count; ++i) sums.smallest = std::min(sums.smallest, primaries[i].diameter);
  }
  void setGas(const ParticleGas&, const CollisionKernel&) {}
  [[nodiscard]] double inception(const Sums&, double) const { return sources_.births; }
  [[nodiscard]] TreeUnits nucleus() const { return {sources_.nucleus / type_.material().volume({1})}; }
  // The step (s) in which neither the number changes by collisions, nor the smallest radius by growth, nor what is born
  // by either, by more than the tolerance.
  [[nodiscard]] double step(const Sums& sums, const CollisionKernel* kernel, double tolerance, double remaining) const {
    const double density = type_.material().density;
    const auto colliding = [&](double volume, double diameter) {
      const CollisionKernel::Properties one{volume, volume * density, diameter};
      return kernel != nullptr ? kernel->value(one, one) : 0;
    };
    double fastest = 0;
    if (sums.number > 0) {
      const double n = sums.number;
      fastest = std::max(2 * sources_.growth / sums.smallest, 0.5 * n * colliding(sums.volume / n, sums.diameters / n));
    }
    double longest = remaining;
    if (sources_.births > 0) {
      const double d = treeDiameter(sources_.nucleus);
      longest = std::min(longest, newbornStep(tolerance, sources_.births, sums.number, 2 * sources_.growth / d,
                                              colliding(sources_.nucleus, d)));
    }
    return fastest > 0 ? std::min(longest, tolerance / fastest) : longest;
  }

  void begin(const Sums&, double dt) {
    layer_ = sources_.growth * dt;
    gained_ = 0;
  }
  [[nodiscard]] bool isActive() const { return layer_ > 0; }
  TreeFate grow(Tree& tree, RandomStream&) {
    TreeHead& head = tree.own();
    const double before = head.units[0];
    type_.spheres()->cover(head, layer_);
    type_.measure(head);
    head.rest = 0;
    gained_ += head.units[0] - before;
    return TreeFate::changed;
  }

  void recordInception(double weight, TreeExchange& exchange) const { exchange.units[0] += weight * nucleus()[0]; }
  void recordGrowth(double weight, TreeExchange& exchange, TreeCounters&) const {
    exchange.units[0] += weight * gained_;
  }
  void recordSintering(double, double, TreeExchange&) const {}

 private:
  const PrimaryTrees& type_;
  GivenSources sources_;
  double layer_ = 0, gained_ = 0;  // m; units of one numerical particle's time of growth
};

}  // namespace lampblack::particles
