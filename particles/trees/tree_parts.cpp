#include "particles/trees/tree_parts.hpp"

#include <numeric>

namespace lampblack::particles {

// Of a part that hangs together, a neck of the whole joins what its two sides have of it, and no other neck of the part
// does: its primaries in their order, each neck behind the last of them on its left, are a tree again.
std::vector<Tree> partsOfTree(const PrimaryTrees& type, const Tree& whole, std::span<const char> holds) {
  const auto primaries = whole.primaries();
  const auto necks = whole.necks();
  const std::size_t count = whole.count();
  std::vector<std::size_t> part(count);
  std::iota(part.begin(), part.end(), std::size_t{0});
  const auto partOf = [&](std::size_t i) {
    while (part[i] != i) i = part[i] = part[part[i]];
    return i;
  };
  for (std::size_t k = 0; k < necks.size(); ++k)
    if (holds[k] != 0) part[partOf(necks[k].left)] = partOf(necks[k].right);
  std::vector<Tree> parts;
  std::vector<std::uint32_t> before(count + 1);  // primaries of the part before each
  for (std::size_t root = 0; root < count; ++root) {
    if (partOf(root) != root || !(primaries[root].diameter > 0)) continue;
    before[0] = 0;
    for (std::size_t i = 0; i < count; ++i) before[i + 1] = before[i] + (partOf(i) == root ? 1 : 0);
    TreeHead* tree = type.pool().allocate(before[count]);
    Tree handle(tree);
    tree->count = before[count];
    for (std::size_t i = 0; i < count; ++i)
      if (partOf(i) == root) primariesOf(tree)[before[i]] = primaries[i];
    for (std::size_t k = 0; k < necks.size(); ++k) {
      TreeNeck neck = necks[k];
      if (holds[k] == 0 || partOf(neck.left) != root) continue;
      neck.left = before[neck.left];
      neck.right = before[neck.right];
      neck.first = before[neck.first];
      neck.last = before[neck.last + 1] - 1;
      necksOf(tree)[before[k + 1] - 1] = neck;
    }
    if (TreeSpheres* spheres = type.spheres()) {
      for (std::size_t i = 0; i < count; ++i) {
        if (partOf(i) != root) continue;
        AggregateSphere& s = spheresOf(tree)[before[i]];
        s = whole.spheres()[i];
        const bool isJoined = before[i] > 0;
        s.parent = isJoined ? before[s.parent] : 0;
        s.neck = isJoined ? s.neck : 0;
      }
      spheres->close(*tree);
    }
    type.measure(*tree);
    tree->time = whole.head().time;
    parts.push_back(std::move(handle));
  }
  return parts;
}

std::vector<Tree> sidesOfNeck(const PrimaryTrees& type, const Tree& whole, std::size_t neck) {
  std::vector<char> holds(whole.count() - 1, 1);
  holds[neck] = 0;
  return partsOfTree(type, whole, holds);
}

}  // namespace lampblack::particles
