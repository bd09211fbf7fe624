// What changes many entries of a ClassStore at once. Included by class_store.hpp.
#pragma once

#include "core/modules.hpp"
#include "particles/population/monte_carlo/class_store.hpp"

namespace lampblack::particles {

template <EntryRates Rates>
void ClassStore<Rates>::duplicate() {
  for (std::size_t slot = 0; slot < classes_.size(); ++slot) {
    auto& members = classes_[slot];
    const std::size_t count = members.size();
    members.reserve(2 * count);
    for (std::size_t k = 0; k < count; ++k) members.push_back(Entry(members[k]));
    update(slot);
  }
  size_ *= 2;
}

template <EntryRates Rates>
void ClassStore<Rates>::discardHalf(RandomStream& random) {
  const std::size_t keep = size_ / 2;
  std::vector<std::uint64_t> coins((size_ + 63) / 64);
  std::size_t heads = 0;
  for (auto& coin : coins) coin = random.bits();
  if (size_ % 64 != 0) coins.back() &= (std::uint64_t{1} << (size_ % 64)) - 1;
  for (const auto coin : coins) heads += static_cast<std::size_t>(std::popcount(coin));
  const std::uint64_t flip = 2 * heads < size_ ? ~std::uint64_t{0} : 0;
  std::size_t entry = 0;
  for (auto& members : classes_) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < members.size(); ++k, ++entry) {
      members[kept] = members[k];
      kept += ((coins[entry / 64] ^ flip) >> (entry % 64)) & 1;
    }
    members.erase(members.begin() + static_cast<std::ptrdiff_t>(kept), members.end());
    const auto slot = static_cast<std::size_t>(&members - classes_.data());
    update(slot);
    if (members.empty() || members.size() < members.capacity() / 4) release(slot);
  }
  size_ = flip != 0 ? size_ - heads : heads;
  while (size_ > keep) remove(uniformPlace(random));
}

template <EntryRates Rates>
template <class F, class Then>
void ClassStore<Rates>::transform(F f, Then then) {
  std::vector<Entry> entries;
  entries.reserve(size_);
  for (auto& members : classes_)
    entries.insert(entries.end(), std::make_move_iterator(members.begin()), std::make_move_iterator(members.end()));
  clear();
  std::size_t kept = 0;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    if (!f(entries[k])) continue;
    if (kept != k) entries[kept] = std::move(entries[k]);
    ++kept;
  }
  then(std::span<const Entry>(entries.data(), kept));
  insertAll(kept, [&](std::size_t k) { return std::move(entries[k]); });
}

template <EntryRates Rates>
template <class F>
void ClassStore<Rates>::transformSome(std::span<const std::uint32_t> which, F f) {
  moving_.clear();
  std::size_t next = 0, first = 0;
  for (std::size_t slot = 0; slot < classes_.size() && next < which.size(); ++slot) {
    auto& members = classes_[slot];
    const std::size_t end = first + members.size(), begin = next;
    while (next < which.size() && which[next] < end) ++next;
    // The last one first: what fills the gap of one that leaves has been looked at.
    for (std::size_t k = next; k-- > begin;) {
      Entry& entry = members[which[k] - first];
      const std::uint64_t key = keyOf(rates_.volume(entry));
      const bool stays = f(entry, k);
      if (stays && keyOf(rates_.volume(entry)) == key) {
        raiseBounds(slot, entry);
        continue;
      }
      if (stays) moving_.push_back(std::move(entry));
      if (&entry != &members.back()) entry = std::move(members.back());
      members.pop_back();
      --size_;
    }
    first = end;
    if (begin == next) continue;
    update(slot);
    if (members.empty() || members.size() < members.capacity() / 4) release(slot);
  }
  insertAll(moving_.size(), [&](std::size_t k) { return std::move(moving_[k]); });
}

template <EntryRates Rates>
void ClassStore<Rates>::refresh() {
  std::size_t kept = 0;
  std::fill(slots_.begin(), slots_.end(), none);
  for (std::size_t slot = 0; slot < classes_.size(); ++slot) {
    if (classes_[slot].empty()) continue;
    if (kept != slot) std::swap(classes_[kept], classes_[slot]);
    slots_[keyOf(rates_.volume(classes_[kept].front())) - firstKey_] = static_cast<std::uint16_t>(kept);
    ++kept;
  }
  classes_.resize(kept);
  bounds_.assign(kept * sums_.blocks(), SumTree::Lanes{});
  sums_.reset(kept);
  for (std::size_t slot = 0; slot < kept; ++slot) {
    const std::span<const Entry> members(classes_[slot]);
    if constexpr (requires { rates_.largestTerms(members); }) {
      raiseBounds(slot, rank_ > 0 ? rates_.largestTerms(members) : CollisionKernel::Terms{});
      if (components_ > 1 + 2 * rank_)
        for (const Entry& entry : members) raiseSingleBounds(slot, entry);
    } else {
      for (const Entry& entry : members) raiseBounds(slot, entry);
    }
    update(slot);
  }
}

// A population that grows leaves empty classes behind: their memory goes back, and their bounds.
template <EntryRates Rates>
void ClassStore<Rates>::release(std::size_t slot) {
  auto& members = classes_[slot];
  if (members.empty()) {
    SumTree::Lanes* bounds = &bounds_[slot * sums_.blocks()];
    std::fill(bounds, bounds + sums_.blocks(), SumTree::Lanes{});
  }
  if (members.capacity() <= 64) return;
  std::vector<Entry> smaller;
  smaller.reserve(members.capacity() / 2);
  smaller.assign(members.begin(), members.end());
  members.swap(smaller);
}

}  // namespace lampblack::particles
