// What methods with equal weights do to a whole store: by the store's own means where it has some, else by those of
// every EntryStore.
#pragma once

#include <span>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/store.hpp"

namespace lampblack::particles::store_operations {

// Inline, so that the entry need not go through memory.
template <class Store>
[[gnu::always_inline]] inline void insert(Store& store, const typename Store::Entry& entry, std::size_t copies) {
  if constexpr (requires { store.insert(entry, copies); }) {
    store.insert(entry, copies);
  } else {
    for (std::size_t k = 0; k < copies; ++k) store.insert(entry);
  }
}

// The store as made of its entries alone, in their order, by the rates as they are now.
template <class Store>
void refresh(Store& store) {
  if constexpr (requires { store.refresh(); }) {
    store.refresh();
  } else {
    store.transform([](const auto&) { return true; });
  }
}

// A second copy of every entry.
template <class Store>
void duplicate(Store& store) {
  if constexpr (requires { store.duplicate(); }) {
    store.duplicate();
  } else {
    std::vector<typename Store::Entry> entries;
    store.forEach([&](const auto& entry) { entries.push_back(entry); });
    for (const auto& entry : entries) store.insert(entry);
  }
}

// Keeps size() / 2 entries (rounded down), any subset with the same probability.
template <class Store>
void discardHalf(Store& store, RandomStream& random) {
  if constexpr (requires { store.discardHalf(random); }) {
    store.discardHalf(random);
  } else {
    const std::size_t keep = store.size() / 2;
    while (store.size() > keep) (void)store.takeUniform(random);
  }
}

// Puts in a copy of one entry drawn uniformly and returns it.
template <class Store>
typename Store::Entry copyUniform(Store& store, RandomStream& random) {
  if constexpr (requires { store.copyUniform(random); }) {
    return store.copyUniform(random);
  } else {
    const auto entry = store.takeUniform(random);
    store.insert(entry);
    store.insert(entry);
    return entry;
  }
}

// f(std::span<const Entry>) for pieces that make up the store.
template <class Store, class F>
void forEachRun(const Store& store, F f) {
  if constexpr (requires { store.forEachRun(f); }) {
    store.forEachRun(f);
  } else {
    store.forEach([&](const auto& entry) { f(std::span(&entry, 1)); });
  }
}

}  // namespace lampblack::particles::store_operations
