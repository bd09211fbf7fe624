// Two primaries become one.
#include "particles/trees/tree_fusing.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "numerics/index_lanes.hpp"

namespace lampblack::particles {
namespace {

void unite(TreePrimary& primary, const TreeUnits& units, const TreeMaterial& material) {
  for (std::size_t c = 0; c < mostTreeComponents; ++c) primary.units[c] += units[c];
  primary.diameter = treeDiameter(material.volume(primary.units));
}

// A neck of a primary that is larger than before keeps its level.
void carryOn(const TreePrimary* primaries, TreeNeck& neck) {
  const double level = sinteringLevel(neck);
  neck.sphere = sphereOfNeck(primaries, neck);
  neck.common = commonSurface(neck.sphere, level);
  // Of a small primary and one that has grown the level in point contact is above that of equals.
  const bool isBurnt = !(primaries[neck.left].diameter > 0 && primaries[neck.right].diameter > 0);
  if (!isBurnt) neck.common = std::min(neck.common, touchingSurface(primaries, neck));
}

}  // namespace

bool absorb(TreeHead& tree, std::uint32_t at, const TreeUnits& units, const TreeMaterial& material) {
  TreePrimary* primaries = primariesOf(&tree);
  TreeNeck* necks = necksOf(&tree);
  unite(primaries[at], units, material);
  bool isSettled = true;
  for (std::uint32_t k = 0; k + 1 < tree.count; ++k) {
    if ((necks[k].left != at) & (necks[k].right != at)) continue;
    carryOn(primaries, necks[k]);
    isSettled = isSettled && !isFused(necks[k]);
  }
  return isSettled;
}

std::size_t fuseNeck(TreeHead& tree, std::size_t k, const TreeMaterial& material) {
  TreePrimary* primaries = primariesOf(&tree);
  TreeNeck* necks = necksOf(&tree);
  const TreeNeck gone = necks[k];
  const std::uint32_t first = gone.first, last = gone.last, a = gone.left, b = gone.right;
  const auto middle = static_cast<std::uint32_t>(k);
  const std::uint32_t before = b - (middle + 1);  // primaries of the right part before b

  // The joined primary, and which necks know it.
  unite(primaries[a], primaries[b].units, material);

  // Right part before b, left part, right part behind b; the same for the necks in between.
  std::rotate(primaries + first, primaries + middle + 1, primaries + b);
  std::copy(primaries + b + 1, primaries + tree.count, primaries + b);
  std::copy(necks + k + 1, necks + tree.count - 1, necks + k);  // without the neck itself
  std::rotate(necks + first, necks + k, necks + k + before);
  --tree.count;

  // Without branches, as a tree may have thousands of necks.
  const std::uint32_t back = middle + 1 - first;  // by how much the right part before b comes forward
  const auto place = [=](std::uint32_t i) {       // of a primary, b being a
    i = i == b ? a : i;
    std::uint32_t to = i - 1;
    to = i < b ? i - back : to;
    to = i <= middle ? i + before : to;
    return i < first ? i : to;
  };
  const auto renumber = [&](TreeNeck& neck) {  // whether the neck was one of the two primaries'
    const std::uint32_t begin = neck.first, end = neck.last, left = neck.left, right = neck.right;
    neck.left = place(left);
    neck.right = place(right);
    // Ranges: of the left part as its primaries; of the right part, b stands for the whole left part; around both.
    const bool ofLeft = (begin >= first) & (end <= middle), ofRight = (begin > middle) & (end <= last);
    std::uint32_t newBegin = begin > last ? begin - 1 : begin, newEnd = end >= last ? end - 1 : end;
    newBegin = ofRight ? (begin <= b ? begin - back : begin - 1) : newBegin;
    newEnd = ofRight ? (end < b ? end - back : end - 1) : newEnd;
    neck.first = ofLeft ? begin + before : newBegin;
    neck.last = ofLeft ? end + before : newEnd;
    return (left == a) | (left == b) | (right == a) | (right == b);
  };
  // The same where b is the first of the right part, as where a single primary was joined: a takes its place, and the
  // left part the place of a range that begins with it.
  const auto renumberBehind = [=](TreeNeck& neck) {
    static_assert(offsetof(TreeNeck, last) == offsetof(TreeNeck, left) + 3 * sizeof(std::int32_t));
    const auto lane = [](std::uint32_t i) { return static_cast<std::int32_t>(i); };
    const IndexLanes seen = loadIndices(&neck.left);
    const IndexLanes isA = seen == lane(a), isB = seen == lane(b);
    const IndexLanes forB{lane(a), lane(a), lane(first), lane(b) - 1};
    const IndexLanes now = isB ? forB : seen + (seen > lane(b));  // a mask is -1
    storeIndices(&neck.left, now);
    const IndexLanes either = isA | isB;
    return (either[0] | either[1]) != 0;
  };
  const bool isBehind = before == 0;
  std::size_t from = isBehind ? k : 0;
  constexpr std::uint32_t together = 256;
  std::array<std::uint32_t, together> touched;
  for (std::uint32_t start = 0; start + 1 < tree.count; start += together) {
    std::size_t count = 0;
    const std::uint32_t stop = std::min(start + together, tree.count - 1);
    const auto renumberAll = [&](const auto& one) {
      for (std::uint32_t n = start; n < stop; ++n) {
        touched[count] = n;
        count += one(necks[n]) ? 1 : 0;
      }
    };
    if (isBehind)
      renumberAll(renumberBehind);
    else
      renumberAll(renumber);
    for (std::size_t t = 0; t < count; ++t) carryOn(primaries, necks[touched[t]]);
    if (count > 0) from = std::min<std::size_t>(from, touched[0]);
  }
  return from;
}

}  // namespace lampblack::particles
