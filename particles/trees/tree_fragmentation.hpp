// Trees of soot break at their necks while they are oxidised: how often by the law of all aggregates of soot
// (SootFragmentation), of as many primaries as equalPrimaries() says; where is drawn, in proportion to 1 - s of each
// neck, s being its sintering level: a point contact is the weakest there can be, all point contacts are equal, and one
// that has closed does not break. docs/theory/primary_trees.md, "Soot".
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/trees/primary_trees.hpp"

namespace lampblack::particles {

class TreeFragmentation {
 public:
  // Of soot.
  explicit TreeFragmentation(const PrimaryTrees& type) : type_(type), law_(type.material().soot()->fragmentation) {}

  // Whether trees can break at all.
  [[nodiscard]] bool isActive() const { return law_.active && law_.factor > 0; }
  // How often a tree breaks, 1/s per kg of carbon that is oxidised on a m2 in a second.
  [[nodiscard]] double perOxidation(const TreeHead& tree) const {
    return tree.count > 1 && isActive() ? law_.perOxidation(equalPrimaries(tree))[0] : 0;
  }
  // Breaks a tree, and what it breaks into, over dt (s) at `oxidation` (kg/m2/s), as often as that happens: each part
  // at its own rate from the moment it is one. The tree becomes one of the parts, the others are added to `parts`.
  // Returns how many necks broke.
  std::uint64_t breakUp(Tree& tree, double oxidation, double dt, RandomStream& random, std::vector<Tree>& parts);

 private:
  [[nodiscard]] static std::size_t drawNeck(const Tree& tree, RandomStream& random);

  const PrimaryTrees& type_;
  const SootFragmentation& law_;
  std::vector<std::pair<Tree, double>> waiting_;  // parts, and the time (s) that each has left
};

}  // namespace lampblack::particles
