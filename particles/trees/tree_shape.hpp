// Sizes of primaries, necks and trees (Shekar, Smith, Kraft, Wagner 2011, eqs. 11-20, 42, 43), inline as growth and
// sintering ask for them all the time. Lengths in m.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/cube_root.hpp"
#include "core/modules.hpp"
#include "particles/collisions/sphere.hpp"
#include "particles/trees/tree.hpp"

namespace lampblack::particles {

// What a particle is: primaries that share surface; or its volume and surface alone (surface_volume.hpp), as one
// primary of its volume with a surface of its own; or primaries that are overlapping spheres in space (TreeSpheres).
enum class TreeShape { primaries, surfaceVolume, spheres };

// Two equal spheres in point contact have a sphere's surface over theirs of 2^(-1/3), where the sintering level is 0.
inline constexpr double touching = 0.79370052598409973738;
// From this level on (eq. 44) two primaries are one.
inline constexpr double fusedLevel = 0.95;
// The surface of a neck over the sphere's at which that is so.
inline constexpr double fusedRatio = 1 / (fusedLevel * (1 - touching) + touching);

// What diameter the number of primaries is raised from in the diameter of collision (eq. 17): their mean (eq. 18), or
// 6 V/S of the aggregate, by which a sphere that has sintered is a sphere (Lavvas, Sander, Kraft, Imanaka 2011). Or, of
// spheres in space, the diameter of the sphere with their mean shadow along three lines at right angles; or that of
// their bounding sphere, where only those that touch on a line collide.
enum class CollisionSize { primaries, volumeToSurface, shadow, lines };

// Volumes of trees are normal numbers by far, and the root is asked for all the time.
[[nodiscard, gnu::always_inline]] inline double treeDiameter(double volume) {
  return normalCubeRoot(6 / constants::pi * volume);
}
[[nodiscard, gnu::always_inline]] inline double treeSphere(double volume) {  // m2
  const double d = treeDiameter(volume);
  return constants::pi * d * d;
}
[[nodiscard]] inline double primaryVolume(double diameter) {
  return constants::pi / 6 * diameter * diameter * diameter;
}
[[nodiscard]] inline double primarySurface(double diameter) {
  return constants::pi * diameter * diameter;
}

// Eq. 42, not below zero, where unequal primaries begin above it, and growth leaves rounding.
[[nodiscard]] inline double sinteringLevel(const TreeNeck& neck) {
  return std::clamp((neck.sphere / neck.common - touching) / (1 - touching), 0.0, 1.0);
}
// The common surface at a level.
[[nodiscard]] inline double commonSurface(double sphere, double level) {
  return sphere / (level * (1 - touching) + touching);
}

// Whether its two primaries are one.
[[nodiscard, gnu::always_inline]] inline bool isFused(const TreeNeck& neck) {
  return neck.common <= neck.sphere * fusedRatio;
}

// Diameter of collision of a tree from its sums and its surface (eqs. 17-19): n_r = S^3 / (36 pi V^2) is the ratio of
// the surfaces to the third power.
[[nodiscard]] inline double collisionOfSurface(const TreeHead& tree, double inverseDimension, CollisionSize size) {
  const double ratio = tree.surface / treeSphere(tree.volume);
  const double diameter =
      size == CollisionSize::primaries ? tree.diameters / tree.count : 6 * tree.volume / tree.surface;
  return diameter * std::pow(ratio, 3 * inverseDimension);
}
// Surface and diameter of collision of a tree from its sums (eqs. 15-19).
inline void shapeTree(TreeHead& tree, double inverseDimension, CollisionSize size) {
  if (tree.count == 1) {
    tree.surface = tree.surfaces;
    tree.collision = tree.diameters;
    return;
  }
  const double n = tree.count, root = 1 / cubeRoot(n), level = tree.levels / (n - 1);
  const double sphere = treeSphere(tree.volume);
  tree.surface = sphere / (level * (1 - root) + root);
  tree.collision = collisionOfSurface(tree, inverseDimension, size);
}

// How many equal primaries of 6 V/S in point contact have its volume and surface, n_r = S^3 / (36 pi V^2) (eq. 19).
[[nodiscard]] inline double equalPrimaries(const TreeHead& tree) {
  return tree.volume / primaryVolume(6 * tree.volume / tree.surface);
}

// Whether there is surface to sinter: necks, or by volume and surface more than the sphere's.
[[nodiscard, gnu::always_inline]] inline bool isAggregate(const TreeHead& tree) {
  return tree.count > 1 || tree.surface > tree.surfaces;
}
// Whether it has surface that is behind the clock (s): what may wait for ever has nothing to sinter.
[[nodiscard]] inline bool waitsForSintering(const TreeHead& tree, double clock) {
  return isAggregate(tree) && tree.time < clock && std::isfinite(tree.rest);
}
// What results say of a tree: its primaries, by volume and surface those equal ones; their mean diameter; its mean
// sintering level, by volume and surface the sphere's surface over its own.
[[nodiscard]] inline double primariesOfTree(const TreeHead& tree) {
  return tree.count > 1 || !isAggregate(tree) ? tree.count : equalPrimaries(tree);
}
[[nodiscard]] inline double meanPrimaryDiameter(const TreeHead& tree) {
  return tree.count > 1 || !isAggregate(tree) ? tree.diameters / tree.count : 6 * tree.volume / tree.surface;
}
[[nodiscard]] inline double meanSinteringLevel(const TreeHead& tree) {
  if (tree.count > 1) return tree.levels / (tree.count - 1.0);
  return isAggregate(tree) ? tree.surfaces / tree.surface : 1;
}

// By volume and surface: from the surface, which is the sphere's at least. A trace more is a sphere's too.
inline constexpr double traceOfSurface = 1e-9;
inline void shapeBySurface(TreeHead& tree, double inverseDimension) {
  if (!(tree.surface > (1 + traceOfSurface) * tree.surfaces)) tree.surface = tree.surfaces;
  const double ratio = tree.surface / tree.surfaces;
  tree.collision = tree.diameters / ratio * std::pow(ratio, 3 * inverseDimension);
}

// Sums over primaries and necks afresh, from those that are up to date; and what follows from them.
inline void sumTree(TreeHead& tree) {
  // Four sums of each side by side: none waits for the one before it.
  constexpr std::size_t together = 4;
  struct {
    TreeUnits units{};
    double diameters = 0, squares = 0, cubes = 0, levels = 0;
  } part[together];
  const TreePrimary* primaries = primariesOf(&tree);
  const auto addPrimary = [&](std::size_t l, const TreePrimary& one) {
    const double d = one.diameter;
    for (std::size_t c = 0; c < mostTreeComponents; ++c) part[l].units[c] += one.units[c];
    part[l].diameters += d;
    part[l].squares += d * d;
    part[l].cubes += d * d * d;
  };
  std::size_t i = 0, k = 0;
  for (; i + together <= tree.count; i += together)
    for (std::size_t l = 0; l < together; ++l) addPrimary(l, primaries[i + l]);
  for (; i < tree.count; ++i) addPrimary(0, primaries[i]);
  const TreeNeck* necks = necksOf(&tree);
  for (; k + together < tree.count; k += together)
    for (std::size_t l = 0; l < together; ++l) part[l].levels += sinteringLevel(necks[k + l]);
  for (; k + 1 < tree.count; ++k) part[0].levels += sinteringLevel(necks[k]);
  const auto sum = [&](auto of) { return (of(part[0]) + of(part[1])) + (of(part[2]) + of(part[3])); };
  for (std::size_t c = 0; c < mostTreeComponents; ++c)
    tree.units[c] = sum([c](const auto& one) { return one.units[c]; });
  tree.diameters = sum([](const auto& one) { return one.diameters; });
  tree.surfaces = constants::pi * sum([](const auto& one) { return one.squares; });
  tree.volume = constants::pi / 6 * sum([](const auto& one) { return one.cubes; });
  tree.levels = sum([](const auto& one) { return one.levels; });
}
inline void measureTree(TreeHead& tree, double inverseDimension, CollisionSize size) {
  sumTree(tree);
  shapeTree(tree, inverseDimension, size);
}

// The most that a neck can have: both primaries in point contact (eq. 9).
[[nodiscard]] inline double touchingSurface(const TreePrimary* primaries, const TreeNeck& neck) {
  return primarySurface(primaries[neck.left].diameter) + primarySurface(primaries[neck.right].diameter);
}
// The sphere of the two primaries of a neck, and the cube of its diameter.
[[nodiscard, gnu::always_inline]] inline double cubeOfNeck(const TreePrimary* primaries, const TreeNeck& neck) {
  const double l = primaries[neck.left].diameter, r = primaries[neck.right].diameter;
  return l * l * l + r * r * r;
}
[[nodiscard]] inline double sphereOfNeck(const TreePrimary* primaries, const TreeNeck& neck) {
  return primarySurface(normalCubeRoot(cubeOfNeck(primaries, neck)));
}

// Lengths of which the cubes are cube(k), take(k, length), k below n: in vector lanes, to the bits of one alone.
template <class Cube, class Take>
void takeCubeRoots(std::size_t n, Cube cube, Take take) {
  constexpr std::size_t block = 64;
  double lengths[block];
  for (std::size_t first = 0; first < n; first += block) {
    const std::size_t count = std::min(block, n - first);
    for (std::size_t k = 0; k < count; ++k) lengths[k] = cube(first + k);
    for (std::size_t k = 0; k < count; ++k) lengths[k] = normalCubeRoot(lengths[k]);
    for (std::size_t k = 0; k < count; ++k) take(first + k, lengths[k]);
  }
}

}  // namespace lampblack::particles
