// Two primaries become one.
#include <algorithm>

#include "particles/trees/tree_sintering.hpp"

namespace lampblack::particles {

void fuseNeck(TreeHead& tree, std::size_t k, const TreeMaterial& material) {
  TreePrimary* primaries = primariesOf(&tree);
  TreeNeck* necks = necksOf(&tree);
  const TreeNeck gone = necks[k];
  const std::uint32_t first = gone.first, last = gone.last, a = gone.left, b = gone.right;
  const auto middle = static_cast<std::uint32_t>(k);
  const std::uint32_t before = b - (middle + 1);  // primaries of the right part before b

  // The joined primary, and which necks know it.
  TreePrimary joined = primaries[a];
  for (std::size_t c = 0; c < mostTreeComponents; ++c) joined.units[c] += primaries[b].units[c];
  joined.diameter = treeDiameter(material.volume(joined.units));
  primaries[a] = joined;

  // Right part before b, left part, right part behind b; the same for the necks in between.
  std::rotate(primaries + first, primaries + middle + 1, primaries + b);
  std::copy(primaries + b + 1, primaries + tree.count, primaries + b);
  std::copy(necks + k + 1, necks + tree.count - 1, necks + k);  // without the neck itself
  std::rotate(necks + first, necks + k, necks + k + before);
  --tree.count;

  const auto place = [&](std::uint32_t i) {  // of a primary, b being a
    if (i == b) i = a;
    if (i < first) return i;
    if (i <= middle) return i + before;
    if (i < b) return i - (middle + 1) + first;
    return i - 1;
  };
  for (std::uint32_t n = 0; n + 1 < tree.count; ++n) {
    TreeNeck& neck = necks[n];
    const bool touches = neck.left == a || neck.left == b || neck.right == a || neck.right == b;
    neck.left = place(neck.left);
    neck.right = place(neck.right);
    // Ranges: of the left part as its primaries; of the right part, b stands for the whole left part; around both.
    const bool ofLeft = neck.first >= first && neck.last <= middle;
    const bool ofRight = neck.first > middle && neck.last <= last;
    if (ofLeft) {
      neck.first += before;
      neck.last += before;
    } else if (ofRight) {
      neck.first = neck.first <= b ? neck.first - (middle + 1) + first : neck.first - 1;
      neck.last = neck.last < b ? neck.last - (middle + 1) + first : neck.last - 1;
    } else {
      if (neck.first > last) --neck.first;
      if (neck.last >= last) --neck.last;
    }
    if (touches) {
      const double level = sinteringLevel(neck);
      neck.sphere = sphereOfNeck(primaries, neck);
      neck.common = commonSurface(neck.sphere, level);
      // Of a small primary and one that has grown the level in point contact is above that of equals.
      const bool isBurnt = !(primaries[neck.left].diameter > 0 && primaries[neck.right].diameter > 0);
      if (!isBurnt) neck.common = std::min(neck.common, touchingSurface(primaries, neck));
    }
  }
}

}  // namespace lampblack::particles
