#include "particles/trees/tree_pool.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>

#include "core/errors.hpp"

namespace lampblack::particles {
namespace {

// Capacities grow by an eighth, so that hardly any room is lost.
const std::vector<std::uint32_t>& capacities() {
  static const std::vector<std::uint32_t> all = [] {
    std::vector<std::uint32_t> list;
    for (std::uint32_t n = 1; n < (1U << 30U); n += std::max(1U, n / 8)) list.push_back(n);
    return list;
  }();
  return all;
}

}  // namespace

std::size_t TreePool::blockBytes(std::size_t capacity) const {
  std::size_t bytes = headBytes + capacity * sizeof(TreePrimary) + (capacity - 1) * sizeof(TreeNeck);
  if (hasSpheres_) bytes += capacity * sizeof(AggregateSphere);
  return (bytes + 15) / 16 * 16;
}

// At the beginning of its own aligned memory, which the blocks follow. A free block begins with a pointer to the next.
struct TreePool::Slab {
  Slab *before = nullptr, *behind = nullptr;
  std::byte* fresh = nullptr;  // never used from here on
  void* freed = nullptr;
  std::uint32_t used = 0, places = 0, size = 0;  // size: its class
};

TreePool::TreePool(bool hasSpheres) : hasSpheres_(hasSpheres), open_(capacities().size(), nullptr) {}

// All trees are gone: their owners live shorter.
TreePool::~TreePool() {
  for (void* region : regions_) munmap(region, regionBytes);
}

// Memory of the system's own, which goes back to it whatever else the program keeps.
void* TreePool::slabMemory() {
  if (free_.empty()) {
    void* region = mmap(nullptr, regionBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (region == MAP_FAILED) throw std::bad_alloc();
    regions_.push_back(region);
    const auto start = reinterpret_cast<std::uintptr_t>(region);
    const std::uintptr_t first = (start + slabBytes - 1) / slabBytes * slabBytes;
    for (std::uintptr_t at = first; at + slabBytes <= start + regionBytes; at += slabBytes)
      free_.push_back(reinterpret_cast<void*>(at));
    std::reverse(free_.begin(), free_.end());
  }
  void* memory = free_.back();
  free_.pop_back();
  bytes_ += slabBytes;
  return memory;
}

std::size_t TreePool::classOf(std::size_t primaries) {
  const auto& all = capacities();
  return static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), primaries) - all.begin());
}

TreeHead* TreePool::allocate(std::size_t primaries) {
  if (primaries > capacities().back()) throw NumericsError("particles: a tree of more than 1e9 primaries");
  const std::size_t size = classOf(primaries), capacity = capacities()[size], block = blockBytes(capacity);
  std::byte* place = nullptr;
  if (block > slabBytes / 8) {  // too large to share a slab
    place = static_cast<std::byte*>(std::malloc(block));
    if (place == nullptr) throw std::bad_alloc();
    bytes_ += block;
  } else {
    Slab* slab = open_[size];
    if (slab == nullptr) {
      void* memory = slabMemory();
      slab = new (memory) Slab;
      constexpr std::size_t head = (sizeof(Slab) + 15) / 16 * 16;
      slab->fresh = static_cast<std::byte*>(memory) + head;
      slab->places = static_cast<std::uint32_t>((slabBytes - head) / block);
      slab->size = static_cast<std::uint32_t>(size);
      open_[size] = slab;
    }
    if (slab->freed != nullptr) {
      place = static_cast<std::byte*>(slab->freed);
      slab->freed = *static_cast<void**>(slab->freed);
    } else {
      place = slab->fresh;
      slab->fresh += block;
    }
    if (++slab->used == slab->places) {  // full
      open_[size] = slab->behind;
      if (slab->behind != nullptr) slab->behind->before = nullptr;
      slab->behind = nullptr;
    }
  }
  auto* head = new (place) TreeHead;
  head->pool = this;
  head->holders = 1;
  head->capacity = static_cast<std::uint32_t>(capacity);
  return head;
}

void TreePool::copy(const TreeHead& from, TreeHead& to) {
  auto* source = const_cast<TreeHead*>(&from);
  std::memcpy(static_cast<void*>(primariesOf(&to)), primariesOf(source), from.count * sizeof(TreePrimary));
  std::memcpy(static_cast<void*>(necksOf(&to)), necksOf(source), (from.count - 1) * sizeof(TreeNeck));
  if (from.pool->hasSpheres())
    std::memcpy(static_cast<void*>(spheresOf(&to)), spheresOf(source), from.count * sizeof(AggregateSphere));
  TreePool* pool = to.pool;
  const std::uint32_t capacity = to.capacity;
  to = from;
  to.pool = pool;
  to.capacity = capacity;
  to.holders = 1;
}

void TreePool::release(TreeHead* head) {
  const std::size_t block = blockBytes(head->capacity);
  if (block > slabBytes / 8) {
    bytes_ -= block;
    std::free(head);
    return;
  }
  auto* slab = reinterpret_cast<Slab*>(reinterpret_cast<std::uintptr_t>(head) & ~std::uintptr_t{slabBytes - 1});
  Slab*& first = open_[slab->size];
  if (slab->used-- == slab->places) {  // was full
    slab->behind = first;
    if (first != nullptr) first->before = slab;
    first = slab;
  }
  if (slab->used == 0) {
    (slab->before != nullptr ? slab->before->behind : first) = slab->behind;
    if (slab->behind != nullptr) slab->behind->before = slab->before;
    bytes_ -= slabBytes;
    free_.push_back(slab);
    return;
  }
  *reinterpret_cast<void**>(head) = slab->freed;
  slab->freed = head;
}

}  // namespace lampblack::particles
