#include "particles/trees/tree_burning.hpp"

#include "particles/trees/tree_parts.hpp"
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
    if (TreeSpheres* spheres = type.spheres()) {
      spheres->fuse(tree, closest);
      type.measure(tree);
    } else {
      fuseNeck(tree, closest, type.material());
    }
  }
  type.measure(tree);
  tree.rest = 0;
  handle.fit();
}

std::vector<Tree> partsAroundBurnt(const PrimaryTrees& type, const Tree& whole) {
  const auto primaries = whole.primaries();
  std::vector<char> holds;
  holds.reserve(whole.count());
  for (const TreeNeck& neck : whole.necks())
    holds.push_back(isBurnt(primaries[neck.left]) || isBurnt(primaries[neck.right]) ? 0 : 1);
  return partsOfTree(type, whole, holds);
}

}  // namespace lampblack::particles
