// What the tests of trees share: a material without chemistry to speak of, trees of given primaries, and the invariants
// of a tree.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "particles/trees/primary_trees.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {

// Hot nitrogen with what silica comes of.
struct Nitrogen {
  std::vector<double> concentrations = {0, 0};  // mol/m3, of the precursor and the product
  [[nodiscard]] ParticleGas gas() const {
    CarrierGas carrier{1173, 101325, 0, 4.6e-5, 0.028014};
    carrier.density = carrier.pressure * carrier.meanMolecularWeight / (constants::gasConstant * carrier.temperature);
    return {carrier, concentrations};
  }
};

// Units of silica of a sphere of the diameter (m).
inline TreeUnits spherical(const TreeMaterial& material, double diameter) {
  TreeUnits units{1, 1.9, 0.2};
  const double factor = constants::pi / 6 * std::pow(diameter, 3) / material.volume(units);
  for (double& number : units) number *= factor;
  return units;
}

// Primaries of these diameters joined in a row, each with the tree before it.
inline Tree joinedTree(const PrimaryTrees& type, const std::vector<double>& diameters, RandomStream& random) {
  Tree tree = type.make(spherical(type.material(), diameters[0]));
  for (std::size_t i = 1; i < diameters.size(); ++i)
    tree = type.coagulated(std::move(tree), type.make(spherical(type.material(), diameters[i])), random);
  return tree;
}

// All trees become the first, any two at a time.
inline void joinAtRandom(const PrimaryTrees& type, std::vector<Tree>& trees, RandomStream& random) {
  while (trees.size() > 1) {
    std::swap(trees[random.below(trees.size())], trees.back());
    Tree one = std::move(trees.back());
    trees.pop_back();
    Tree& other = trees[random.below(trees.size())];
    other = type.coagulated(std::move(other), std::move(one), random);
  }
}

// That all primaries hang together by as few necks as can be, that ranges are nested, and that sums are those of parts.
inline void expectTree(const PrimaryTrees& type, const Tree& tree) {
  const auto necks = tree.necks();
  const auto n = static_cast<std::uint32_t>(tree.count());
  std::vector<std::uint32_t> group(n);
  for (std::uint32_t i = 0; i < n; ++i) group[i] = i;
  std::size_t whole = 0;
  for (std::uint32_t k = 0; k + 1 < n; ++k) {
    const TreeNeck& neck = necks[k];
    ASSERT_LE(neck.first, k);
    ASSERT_GT(neck.last, k);
    ASSERT_LT(neck.last, n);
    EXPECT_TRUE(neck.left >= neck.first && neck.left <= k);
    EXPECT_TRUE(neck.right > k && neck.right <= neck.last);
    whole += neck.first == 0 && neck.last + 1 == n;
    for (std::uint32_t other = 0; other < k; ++other) {
      const TreeNeck& one = necks[other];
      const bool isApart = one.last < neck.first || neck.last < one.first;
      const bool isInside =
          (one.first >= neck.first && one.last <= neck.last) || (neck.first >= one.first && neck.last <= one.last);
      EXPECT_TRUE(isApart || isInside);
    }
    const std::uint32_t from = group[neck.left], to = group[neck.right];
    EXPECT_NE(from, to) << "a ring";
    for (std::uint32_t& g : group)
      if (g == from) g = to;
    EXPECT_NEAR(neck.sphere / sphereOfNeck(tree.primaries().data(), neck), 1, 1e-12);
  }
  EXPECT_EQ(whole, n > 1 ? 1U : 0U);
  EXPECT_EQ(std::set<std::uint32_t>(group.begin(), group.end()).size(), 1U);
  Tree copy = tree;
  TreeHead& head = copy.own();
  type.measure(head);
  EXPECT_NEAR(head.volume / tree.head().volume, 1, 1e-12);
  EXPECT_NEAR(head.collision / tree.head().collision, 1, 1e-12);
  EXPECT_NEAR(head.surface / tree.head().surface, 1, 1e-12);
}

}  // namespace lampblack::test
