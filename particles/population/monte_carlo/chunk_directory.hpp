// Which chunk of a sorted store an entry belongs to: the lower boundaries (volume, weight) of all chunks in order, in
// blocks of up to 64 below one array of block boundaries. A search is a binary search over blocks and one pass over a
// block; a chunk that comes or goes moves part of a block, and every few dozen times a block comes or goes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::particles {

class ChunkDirectory {
 public:
  // One chunk, which takes every key.
  void reset(std::uint32_t slot) {
    blocks_.assign(1, Block{});
    free_.clear();
    tops_.assign(1, Top{-infinity, -infinity, 0});
    blockOf_.clear();
    blocks_[0].size = 1;
    blocks_[0].volume[0] = blocks_[0].weight[0] = -infinity;
    blocks_[0].slot[0] = slot;
    own(slot, 0);
  }

  // The last chunk whose boundary is not above the key.
  [[nodiscard]] std::uint32_t find(double volume, double weight) const {
    std::size_t first = 0, count = tops_.size();
    while (count > 1) {
      const std::size_t half = count / 2;
      const Top& top = tops_[first + half];
      if (top.volume < volume || (top.volume == volume && top.weight <= weight)) first += half;
      count -= half;
    }
    const Block& block = blocks_[tops_[first].block];
    std::uint64_t below = 0;
    for (std::uint32_t k = 0; k < width; ++k) {  // infinite where not in use
      below += static_cast<std::uint64_t>(block.volume[k] < volume) |
               (static_cast<std::uint64_t>(block.volume[k] == volume) &
                static_cast<std::uint64_t>(block.weight[k] <= weight));
    }
    return block.slot[below - 1];
  }

  void insertAfter(std::uint32_t before, std::uint32_t slot, double volume, double weight) {
    if (blocks_[blockOf_[before]].size == width) split(blockOf_[before]);
    const std::uint32_t b = blockOf_[before];
    Block& block = blocks_[b];
    const std::uint32_t at = block.indexOf(before) + 1;
    for (std::uint32_t k = block.size; k > at; --k) block.copy(k, block, k - 1);
    ++block.size;
    block.volume[at] = volume;
    block.weight[at] = weight;
    block.slot[at] = slot;
    own(slot, b);
  }

  // Not the first chunk.
  void erase(std::uint32_t slot) {
    const std::uint32_t b = blockOf_[slot];
    Block& block = blocks_[b];
    const std::uint32_t at = block.indexOf(slot);
    --block.size;
    for (std::uint32_t k = at; k < block.size; ++k) block.copy(k, block, k + 1);
    block.volume[block.size] = block.weight[block.size] = infinity;
    if (block.size == 0) {
      tops_.erase(tops_.begin() + static_cast<std::ptrdiff_t>(topOf(b)));
      free_.push_back(b);
    } else if (at == 0) {
      tops_[topOf(b)] = Top{block.volume[0], block.weight[0], b};
    }
  }

  [[nodiscard]] std::size_t bytes() const {
    return blocks_.capacity() * sizeof(Block) + tops_.capacity() * sizeof(Top) +
           (blockOf_.capacity() + free_.capacity()) * sizeof(std::uint32_t);
  }

 private:
  static constexpr std::uint32_t width = 64;
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  struct Block {
    std::array<double, width> volume, weight;
    std::array<std::uint32_t, width> slot{};
    std::uint32_t size = 0;
    Block() {
      volume.fill(infinity);
      weight.fill(infinity);
    }
    [[nodiscard]] std::uint32_t indexOf(std::uint32_t s) const {
      std::uint32_t k = 0;
      while (slot[k] != s) ++k;
      return k;
    }
    void copy(std::uint32_t to, const Block& other, std::uint32_t from) {
      volume[to] = other.volume[from];
      weight[to] = other.weight[from];
      slot[to] = other.slot[from];
    }
  };
  struct Top {
    double volume, weight;
    std::uint32_t block;
  };

  void own(std::uint32_t slot, std::uint32_t block) {
    if (slot >= blockOf_.size()) blockOf_.resize(slot + 1);
    blockOf_[slot] = block;
  }
  [[nodiscard]] std::size_t topOf(std::uint32_t block) const {
    std::size_t k = 0;
    while (tops_[k].block != block) ++k;
    return k;
  }
  void split(std::uint32_t b) {
    std::uint32_t fresh;
    if (free_.empty()) {
      fresh = static_cast<std::uint32_t>(blocks_.size());
      blocks_.emplace_back();
    } else {
      fresh = free_.back();
      free_.pop_back();
      blocks_[fresh] = Block();
    }
    Block &lower = blocks_[b], &upper = blocks_[fresh];
    upper.size = width / 2;
    lower.size = width - upper.size;
    for (std::uint32_t k = 0; k < upper.size; ++k) {
      upper.copy(k, lower, lower.size + k);
      blockOf_[upper.slot[k]] = fresh;
      lower.volume[lower.size + k] = lower.weight[lower.size + k] = infinity;
    }
    tops_.insert(tops_.begin() + static_cast<std::ptrdiff_t>(topOf(b) + 1),
                 Top{upper.volume[0], upper.weight[0], fresh});
  }

  std::vector<Block> blocks_;
  std::vector<std::uint32_t> free_;
  std::vector<Top> tops_;               // in order
  std::vector<std::uint32_t> blockOf_;  // of a chunk
};

}  // namespace lampblack::particles
