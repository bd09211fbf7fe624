#include "particles/trees/packed_tree.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "core/errors.hpp"
#include "core/packed_doubles.hpp"
#include "particles/trees/tree_shape.hpp"

namespace lampblack::particles {
namespace {

// Sums as they are: joined trees have added them up in another order than they are measured in.
struct Sums {
  double length, count;
  TreeUnits units;
  double volume, diameters, surfaces, levels, surface, collision, sintering, time, rest;
};
// Of its four places two in a value, which is exact up to that many primaries.
struct Neck {
  double common, sides, range;
};
struct Sphere {
  Vector3 centre;
  double radius, neck;
};
constexpr double mostPlaces = 1 << 26;
double bothPlaces(std::uint32_t first, std::uint32_t second) {
  return first * mostPlaces + second;
}
template <class T>
constexpr std::size_t valuesOf = sizeof(T) / sizeof(double);

// Of primaries the units of their material; their spheres where they have places in space.
std::size_t lengthOfRow(std::size_t primaries, const TreeMaterial& material, bool hasSpheres) {
  return valuesOf<GivenParticle> + valuesOf<Sums> + primaries * material.components.size() +
         (primaries - 1) * valuesOf<Neck> + (hasSpheres ? primaries * valuesOf<Sphere> : 0);
}

void setSums(TreeHead& tree, const Sums& h) {
  tree.units = h.units;
  tree.volume = h.volume;
  tree.diameters = h.diameters;
  tree.surfaces = h.surfaces;
  tree.levels = h.levels;
  tree.surface = h.surface;
  tree.collision = h.collision;
  tree.sintering = h.sintering;
  tree.time = h.time;
  tree.rest = h.rest;
}

InputError damaged() {
  return InputError("particles: the saved state of trees is damaged");
}

}  // namespace

std::size_t lengthOfRow(const Tree& tree, const TreeMaterial& material) {
  return lengthOfRow(tree.count(), material, tree.head().pool->hasSpheres());
}

void packSums(const Tree& tree, double number, const TreeMaterial& material, std::vector<double>& to) {
  const TreeHead& h = tree.head();
  // So many equal spheres have its volume and its surface: S^3 / (36 pi V^2).
  const double ratio = std::max(1.0, h.surface / treeSphere(h.volume));
  packDoubles(to, GivenParticle{h.volume * material.density, 0, ratio * ratio * ratio, number});
  const auto length = static_cast<double>(lengthOfRow(h.count, material, h.pool->hasSpheres()));
  packDoubles(to, Sums{length, static_cast<double>(h.count), h.units, h.volume, h.diameters, h.surfaces, h.levels,
                       h.surface, h.collision, h.sintering, h.time, h.rest});
}

void packTree(const Tree& tree, double number, const TreeMaterial& material, std::vector<double>& to) {
  if (!(static_cast<double>(tree.count()) < mostPlaces))
    throw NumericsError("particles: a tree of more than 6.7e7 primaries");
  packSums(tree, number, material, to);
  const std::size_t before = valuesOf<GivenParticle> + valuesOf<Sums>, components = material.components.size();
  const bool hasSpheres = tree.head().pool->hasSpheres();
  double* place = addRow(to, lengthOfRow(tree.count(), material, hasSpheres) - before).data();
  for (const TreePrimary& primary : tree.primaries()) place = std::copy_n(primary.units.begin(), components, place);
  for (const TreeNeck& n : tree.necks())
    for (const double value : {n.common, bothPlaces(n.left, n.right), bothPlaces(n.first, n.last)}) *place++ = value;
  if (!hasSpheres) return;
  for (const AggregateSphere& s : tree.spheres())
    for (const double value : {s.centre[0], s.centre[1], s.centre[2], s.radius, s.neck}) *place++ = value;
}

Tree unpackTree(std::span<const double> rows, TreePool& pool, const TreeMaterial& material) {
  PackedDoubles state(rows);
  state.next<GivenParticle>();
  const auto h = state.next<Sums>();
  const auto most = static_cast<double>(rows.size());
  if (!(h.count >= 1) || !(h.count <= most)) throw damaged();
  const auto count = static_cast<std::size_t>(h.count);
  if (static_cast<double>(lengthOfRow(count, material, pool.hasSpheres())) != h.length || !(h.length <= most))
    throw damaged();
  const auto index = [](double x) { return static_cast<std::uint32_t>(x); };
  const auto first = [&](double both) { return index(both / mostPlaces); };
  const auto second = [&](double both) { return index(both - mostPlaces * first(both)); };
  TreeHead* tree = pool.allocate(count);
  Tree handle(tree);
  tree->count = index(h.count);
  TreePrimary* primaries = primariesOf(tree);
  TreeNeck* necks = necksOf(tree);
  for (std::uint32_t i = 0; i < tree->count; ++i) {
    primaries[i].units = {};
    std::ranges::copy(state.nextRow(material.components.size()), primaries[i].units.begin());
  }
  takeCubeRoots(
      count, [&](std::size_t i) { return 6 / constants::pi * material.volume(primaries[i].units); },
      [&](std::size_t i, double diameter) { primaries[i].diameter = diameter; });
  for (std::uint32_t k = 0; k + 1 < tree->count; ++k) {
    const auto n = state.next<Neck>();
    for (const double both : {n.sides, n.range})
      if (!(both >= 0) || !(both < mostPlaces * mostPlaces)) throw damaged();
    TreeNeck neck{n.common, 0, first(n.sides), second(n.sides), first(n.range), second(n.range)};
    if (std::max({neck.left, neck.right, neck.first, neck.last}) >= tree->count) throw damaged();
    necks[k] = neck;
  }
  takeCubeRoots(
      count - 1, [&](std::size_t k) { return cubeOfNeck(primaries, necks[k]); },
      [&](std::size_t k, double diameter) { necks[k].sphere = primarySurface(diameter); });
  for (std::uint32_t i = 0; pool.hasSpheres() && i < tree->count; ++i) {
    const auto s = state.next<Sphere>();
    const std::uint32_t parent = i == 0 ? 0 : necks[i - 1].left;
    if (!(s.radius > 0) || !(s.neck >= 0 && s.neck < s.radius * s.radius)) throw damaged();
    if (i > 0 && (parent >= i || necks[i - 1].right != i)) throw damaged();
    spheresOf(tree)[i] = {s.centre, s.radius, material.volume(primaries[i].units), s.neck, parent};
  }
  setSums(*tree, h);
  return handle;
}

TreeHead headOfPackedTree(const double* row) {
  const auto h = PackedDoubles({row + packedParticle, valuesOf<Sums>}).next<Sums>();
  TreeHead tree;
  tree.count = static_cast<std::uint32_t>(h.count);
  setSums(tree, h);
  return tree;
}

}  // namespace lampblack::particles
