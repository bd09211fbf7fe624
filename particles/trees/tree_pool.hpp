// Room for trees: blocks of a few sizes in slabs of one size each, so that a tree that grows or goes leaves a place for
// the next, and a slab without trees is one for any size. A block holds a head, then primaries, then necks, one behind
// the other; where trees have places in space, then their spheres. Trees of one pool share blocks by counting their
// holders; not to be used by several threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/modules.hpp"
#include "particles/spheres/sphere_aggregate.hpp"
#include "particles/trees/tree_material.hpp"

namespace lampblack::particles {

// A sphere of the material.
struct TreePrimary {
  TreeUnits units{};
  double diameter = 0;  // m, of its volume
};

// Two primaries in contact. Primaries stand in the order of the tree of collisions: the neck behind the k-th primary is
// the collision that joined primaries `first`..k with k+1..`last`.
struct TreeNeck {
  double common = 0;  // m2, C_ij (eq. 8)
  double sphere = 0;  // m2, of the sphere of both volumes (eq. 43)
  std::uint32_t left = 0, right = 0;
  std::uint32_t first = 0, last = 0;
};

class TreePool;

// What rates ask of a tree, kept up to date (SI): sums over primaries and necks, and what follows from them.
struct TreeHead {
  TreePool* pool = nullptr;
  std::uint32_t holders = 0;
  std::uint32_t count = 0;  // primaries
  std::uint32_t capacity = 0;
  TreeUnits units{};
  double volume = 0, diameters = 0, surfaces = 0, levels = 0;
  double surface = 0;    // m2 (eq. 15)
  double collision = 0;  // m (eq. 17)
  double sintering = 0;  // m2/s, by which the necks lose surface (eq. A.6)
  double time = 0;       // s of the population's clock, up to which the necks have sintered
  double rest = 0;       // s, for which they may wait from there
};

class TreePool {
 public:
  // `hasSpheres`: whether blocks have room for spheres.
  explicit TreePool(bool hasSpheres = false);
  ~TreePool();
  TreePool(const TreePool&) = delete;
  TreePool& operator=(const TreePool&) = delete;

  // Room for at least so many primaries, with one holder; nothing but pool, holders and capacity is set.
  TreeHead* allocate(std::size_t primaries);
  void release(TreeHead* block);
  [[nodiscard]] bool hasSpheres() const { return hasSpheres_; }
  // Primaries, necks and spheres of one block to another with room for them; the head as well, but for what says which
  // block it is, and for its one holder.
  static void copy(const TreeHead& from, TreeHead& to);
  [[nodiscard]] std::size_t bytes() const { return bytes_; }  // of all slabs

  static constexpr std::size_t headBytes = (sizeof(TreeHead) + 15) / 16 * 16;

 private:
  struct Slab;
  static constexpr std::size_t slabBytes = 64 * 1024, regionBytes = 64 * slabBytes;
  void* slabMemory();
  [[nodiscard]] std::size_t blockBytes(std::size_t capacity) const;
  bool hasSpheres_;
  static std::size_t classOf(std::size_t primaries);
  std::vector<Slab*> open_;            // of each class: slabs with room, linked
  std::vector<void*> regions_, free_;  // regions are cut into slabs
  std::size_t bytes_ = 0;
};

inline TreePrimary* primariesOf(TreeHead* head) {
  return reinterpret_cast<TreePrimary*>(reinterpret_cast<std::byte*>(head) + TreePool::headBytes);
}
inline TreeNeck* necksOf(TreeHead* head) {
  return reinterpret_cast<TreeNeck*>(primariesOf(head) + head->capacity);
}
// One of each primary, of a pool that has them: its parent is the left primary of the neck before it, its neck that
// one.
inline AggregateSphere* spheresOf(TreeHead* head) {
  return reinterpret_cast<AggregateSphere*>(necksOf(head) + head->capacity - 1);
}

}  // namespace lampblack::particles
