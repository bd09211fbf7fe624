#include "particles/trees/tree_burning.hpp"

#include <algorithm>
#include <numeric>

#include "particles/trees/tree_sintering.hpp"

namespace lampblack::particles {
namespace {

bool isBurnt(const TreePrimary& primary) {
  return !(primary.diameter > 0);
}

}  // namespace

void joinOverBurnt(const PrimaryTrees& type, Tree& handle) {
  TreeHead& tree = handle.own();
  while (true) {
    const TreePrimary* primaries = primariesOf(&tree);
    const TreeNeck* necks = necksOf(&tree);
    // The closest contact of a burnt primary with one that is there: as long as there is one of each, there is one.
    std::size_t closest = tree.count;
    for (std::size_t k = 0; k + 1 < tree.count; ++k) {
      if (isBurnt(primaries[necks[k].left]) == isBurnt(primaries[necks[k].right])) continue;
      if (closest == tree.count || necks[k].common > necks[closest].common) closest = k;
    }
    if (closest == tree.count) break;
    fuseNeck(tree, closest, type.material());
  }
  type.measure(tree);
  tree.rest = 0;
  handle.fit();
}

// Of a part that hangs together, a neck of the whole joins what its two sides have of it, and no other neck of the part
// does: its primaries in their order, each neck behind the last of them on its left, are a tree again.
std::vector<Tree> partsAroundBurnt(const PrimaryTrees& type, const Tree& whole) {
  const auto primaries = whole.primaries();
  const auto necks = whole.necks();
  const std::size_t count = whole.count();
  std::vector<std::size_t> part(count);
  std::iota(part.begin(), part.end(), std::size_t{0});
  const auto partOf = [&](std::size_t i) {
    while (part[i] != i) i = part[i] = part[part[i]];
    return i;
  };
  const auto holds = [&](const TreeNeck& neck) {
    return !isBurnt(primaries[neck.left]) && !isBurnt(primaries[neck.right]);
  };
  for (const TreeNeck& neck : necks)
    if (holds(neck)) part[partOf(neck.left)] = partOf(neck.right);
  std::vector<Tree> parts;
  std::vector<std::uint32_t> before(count + 1);  // primaries of the part before each
  for (std::size_t root = 0; root < count; ++root) {
    if (partOf(root) != root || isBurnt(primaries[root])) continue;
    before[0] = 0;
    for (std::size_t i = 0; i < count; ++i) before[i + 1] = before[i] + (partOf(i) == root ? 1 : 0);
    TreeHead* tree = type.pool().allocate(before[count]);
    Tree handle(tree);
    tree->count = before[count];
    for (std::size_t i = 0; i < count; ++i)
      if (partOf(i) == root) primariesOf(tree)[before[i]] = primaries[i];
    for (std::size_t k = 0; k < necks.size(); ++k) {
      TreeNeck neck = necks[k];
      if (!holds(neck) || partOf(neck.left) != root) continue;
      neck.left = before[neck.left];
      neck.right = before[neck.right];
      neck.first = before[neck.first];
      neck.last = before[neck.last + 1] - 1;
      necksOf(tree)[before[k + 1] - 1] = neck;
    }
    type.measure(*tree);
    tree->time = whole.head().time;
    parts.push_back(std::move(handle));
  }
  return parts;
}

}  // namespace lampblack::particles
