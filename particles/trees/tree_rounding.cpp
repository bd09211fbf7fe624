#include "particles/trees/tree_rounding.hpp"

#include <algorithm>

#include "particles/population/model/surface_volume.hpp"

namespace lampblack::particles {

void roundTree(const PrimaryTrees& type, TreeHead& tree, std::vector<double>& change, double piece,
               std::span<const std::uint32_t> changed) {
  if (TreeSpheres* spheres = type.spheres()) {
    spheres->follow(tree);
    type.measure(tree);
    tree.rest = 0;
    return;
  }
  const TreeMaterial& m = type.material();
  TreePrimary* primaries = primariesOf(&tree);
  if (type.bySurface()) {
    const double before = tree.volume, after = m.volume(primaries->units), gain = std::max(change[0], 0.0) * piece;
    const double ratio = tree.surface / tree.surfaces;
    const double n = primariesAfter(ratio * ratio * ratio, before, gain, std::max(before + gain - after, 0.0));
    primaries->diameter = treeDiameter(after);
    tree.surface = primarySurface(primaries->diameter) * cubeRoot(n);
    type.measure(tree);
    tree.rest = 0;
    return;
  }
  TreeNeck* necks = necksOf(&tree);
  const double gain = 2 * m.smoothing * piece;
  bool shrinks = false, isEachGrown = !changed.empty() && gain > 0;
  const auto round = [&](std::size_t i) {
    TreePrimary& p = primaries[i];
    const double volume = m.volume(p.units);
    const double before = p.diameter;
    const bool isLess = change[i] < 0;
    shrinks = shrinks || isLess;
    change[i] = isLess ? 0 : change[i] * (gain / before);  // m2
    isEachGrown = isEachGrown && change[i] > 0;
    p.diameter = volume > 0 ? treeDiameter(volume) : 0;
  };
  if (changed.empty())
    for (std::size_t i = 0; i < tree.count; ++i) round(i);
  else
    for (const std::uint32_t i : changed) round(i);
  for (std::uint32_t k = 0; k + 1 < tree.count; ++k) {
    TreeNeck& neck = necks[k];
    if (isEachGrown && !(change[neck.left] + change[neck.right] > 0)) continue;  // between others
    if (!(primaries[neck.left].diameter > 0) && !(primaries[neck.right].diameter > 0)) continue;
    const double sphere = sphereOfNeck(primaries, neck);
    // At the same level where something has shrunk, and the sphere is smaller.
    if (shrinks && sphere < neck.sphere) neck.common *= sphere / neck.sphere;
    neck.sphere = sphere;
    neck.common = std::max(neck.common + change[neck.left] + change[neck.right], neck.sphere);
  }
  type.measure(tree);
  tree.rest = 0;
}

}  // namespace lampblack::particles
