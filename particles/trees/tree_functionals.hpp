// What is told of trees besides sums: a number of each particle, whose mean over the particles, distribution and
// averages over classes are written.
#pragma once

#include <cstddef>
#include <vector>

#include "core/modules.hpp"
#include "particles/stochastic/stochastic_population.hpp"
#include "particles/trees/tree_material.hpp"
#include "particles/trees/tree_pool.hpp"

namespace lampblack::particles {

class TreeFunctionals {
 public:
  enum Which : std::size_t {
    collisionDiameter,
    sphereDiameter,
    // Of an aggregate of n_r primaries of 6V/S (Shekar, Smith, Kraft, Wagner 2011, eq. 19), by the law of soot's
    // aggregates (SootAggregate::mobilityFactor); a sphere's is its own.
    mobilityDiameter,
    primaries,
    primaryDiameter,  // mean of the particle
    sinteringLevel,   // mean of the particle; of one primary 1
    elementRatio      // atoms of the material's first element over those of its second, as Si:O; of soot H:C
  };

  explicit TreeFunctionals(const TreeMaterial& material);
  // Materials of one element have no ratio.
  [[nodiscard]] std::size_t size() const { return elementRatio + (hasRatio() ? 1 : 0); }
  [[nodiscard]] bool hasRatio() const { return !second_.empty(); }
  [[nodiscard]] const std::vector<ParticleFunctional>& all() const { return all_; }
  // SI; of no atoms of the second element infinite.
  [[nodiscard]] double of(const TreeHead& tree, std::size_t which) const;

 private:
  std::vector<ParticleFunctional> all_;
  std::vector<double> first_, second_;  // atoms in a unit of each component
};

}  // namespace lampblack::particles
