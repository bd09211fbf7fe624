// Trees as rows: what is unpacked is what was packed, to the last bit, in rows as long as they are said to be.
#include "particles/trees/packed_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/errors.hpp"
#include "particles/trees/tree_population.hpp"
#include "tests/every_module.hpp"

namespace lampblack::particles {
namespace {

// Trees of some tens of primaries that differ in size.
TreeOptions packedSilica() {
  TreeOptions options;
  options.material = silica();
  options.material.sintering.prefactor = 1e-10;
  options.particles = 100;
  return options;
}

std::vector<Tree> grownTrees(TreePopulation& population) {
  const std::array<double, 2> concentrations{3e-8, 0};
  population.fill({2107, 3960, 398}, 1e17);
  population.advance({{1173, 101325, 0.29, 4.6e-5, 0.028014}, concentrations}, 0.05);
  population.applyDeferred();
  return population.trees();
}

void expectSameTree(const Tree& a, const Tree& b) {
  ASSERT_EQ(a.count(), b.count());
  EXPECT_EQ(a.head().units, b.head().units);
  EXPECT_EQ(a.head().collision, b.head().collision);
  for (std::size_t i = 0; i < a.count(); ++i) {
    EXPECT_EQ(a.primaries()[i].units, b.primaries()[i].units);
    EXPECT_EQ(a.primaries()[i].diameter, b.primaries()[i].diameter);
  }
  for (std::size_t k = 0; k + 1 < a.count(); ++k) {
    const TreeNeck &m = a.necks()[k], &n = b.necks()[k];
    EXPECT_EQ(std::tie(m.common, m.left, m.right, m.first, m.last),
              std::tie(n.common, n.left, n.right, n.first, n.last));
  }
}

TEST(PackedTree, IsTheSameTree) {
  const TreeOptions options = packedSilica();
  TreePopulation population(options);
  std::size_t largest = 0;
  PrimaryTrees type(options.material, options.size);
  for (const Tree& tree : grownTrees(population)) {
    std::vector<double> row;
    packTree(tree, 2.0, options.material, row);
    const std::size_t n = tree.count();
    EXPECT_EQ(row.size(), 18 + 3 * n + 3 * (n - 1));
    EXPECT_EQ(treeRows.lengthOf(row.data()), row.size());
    expectSameTree(unpackTree(row, type.pool(), options.material), tree);
    largest = std::max(largest, n);
  }
  EXPECT_GT(largest, 10U);
}

TEST(PackedTree, OfPlacesThatAreNoneIsDamaged) {
  const TreeOptions options = packedSilica();
  TreePopulation population(options);
  const std::vector<Tree> trees = grownTrees(population);
  const auto tree = std::ranges::find_if(trees, [](const Tree& one) { return one.count() > 1; });
  ASSERT_NE(tree, trees.end());
  PrimaryTrees type(options.material, options.size);
  std::vector<double> row;
  packTree(*tree, 1.0, options.material, row);
  for (const double places :
       {-1.0, 1e300, static_cast<double>(tree->count()), 67108864.0 * static_cast<double>(tree->count())}) {
    std::vector<double> damaged = row;
    damaged.back() = places;
    EXPECT_THROW((void)unpackTree(damaged, type.pool(), options.material), InputError) << places;
  }
}

}  // namespace
}  // namespace lampblack::particles
