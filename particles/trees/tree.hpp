// A particle as a tree of primaries: a handle to a block of a TreePool. Copies share the block until one is to change.
#pragma once

#include <span>
#include <utility>

#include "core/modules.hpp"
#include "particles/trees/tree_pool.hpp"

namespace lampblack::particles {

class Tree {
 public:
  Tree() = default;
  // Of a block with a holder, who hands it over.
  explicit Tree(TreeHead* block) : head_(block) {}
  Tree(const Tree& other) : head_(other.head_) {
    if (head_ != nullptr) ++head_->holders;
  }
  Tree(Tree&& other) noexcept : head_(std::exchange(other.head_, nullptr)) {}
  Tree& operator=(const Tree& other) {
    Tree(other).swap(*this);
    return *this;
  }
  Tree& operator=(Tree&& other) noexcept {
    Tree(std::move(other)).swap(*this);
    return *this;
  }
  ~Tree() {
    if (head_ != nullptr && --head_->holders == 0) head_->pool->release(head_);
  }
  void swap(Tree& other) noexcept { std::swap(head_, other.head_); }

  [[nodiscard]] bool empty() const { return head_ == nullptr; }
  [[nodiscard]] const TreeHead& head() const { return *head_; }
  [[nodiscard]] std::size_t count() const { return head_->count; }
  [[nodiscard]] std::span<const TreePrimary> primaries() const { return {primariesOf(head_), head_->count}; }
  [[nodiscard]] std::span<const TreeNeck> necks() const { return {necksOf(head_), std::size_t{head_->count} - 1}; }

  // Of a pool that has them.
  [[nodiscard]] std::span<const AggregateSphere> spheres() const { return {spheresOf(head_), head_->count}; }

  // For changes, seen by this handle alone and with room for so many primaries.
  TreeHead& own(std::size_t room = 0) {
    if (head_->holders == 1 && room <= head_->capacity) return *head_;
    TreeHead* block = head_->pool->allocate(std::max<std::size_t>(room, head_->count));
    TreePool::copy(*head_, *block);
    Tree(block).swap(*this);
    return *head_;
  }
  // As own(), for a block that is too large for what it holds.
  void fit();

 private:
  TreeHead* head_ = nullptr;
};

inline void Tree::fit() {
  if (head_->count * 5 > head_->capacity * 4 || head_->capacity < 3) return;
  Tree small(head_->pool->allocate(head_->count));
  TreeHead* block = small.head_;
  if (block->capacity >= head_->capacity) return;
  TreePool::copy(*head_, *block);
  small.swap(*this);
}

}  // namespace lampblack::particles
