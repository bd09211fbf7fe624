// A store of entries of equal weight with events in O(log of the number of classes), whatever the number of entries:
// composition and rejection (Slepoy, Thompson, Plimpton 2008) over classes of size. A class holds the entries whose
// volumes have the same exponent and leading bits of the mantissa, in no order, and one bound for each of the factors
// of the majorant and each rate of one particle. As all members of a class have the same bounds,
// - the sums over the population are sums over classes of count * bound, in a tree (SumTree) that does not drift,
// - a member is drawn in proportion to its bound by drawing a class and then any of its members,
// - the acceptance of a pair is its rate over the majorant made of the two classes' bounds.
// Entries are taken out by moving the last one of the class into the gap, and put in at the end: there is no index of
// particles, and an event touches the two entries it draws and ends of classes that are in the cache anyway.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/store.hpp"
#include "particles/population/monte_carlo/sum_tree.hpp"

namespace lampblack::particles {

template <EntryRates Rates>
class ClassStore {
  static_assert(!Rates::weighted, "the bounds of a class are of entries with the same weight");

 public:
  using Entry = typename Rates::Entry;

  explicit ClassStore(Rates rates) : rates_(std::move(rates)), rank_(rates_.rank()), sums_(componentsOf(rates_)) {
    std::size_t component = 1 + 2 * rank_;
    for (std::size_t k = 0; k < singleProcesses; ++k) {
      if (rates_.active(static_cast<SingleProcess>(k))) single_[k] = component++;
    }
    components_ = component;
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = slots_.capacity() * sizeof(slots_[0]) + sums_.bytes() + bounds_.capacity() * sizeof(bounds_[0]) +
                      classes_.capacity() * sizeof(classes_[0]) + moving_.capacity() * sizeof(moving_[0]);
    for (const auto& members : classes_) sum += members.capacity() * sizeof(Entry);
    return sum;
  }
  [[nodiscard]] Rates& rates() { return rates_; }
  [[nodiscard]] const Rates& rates() const { return rates_; }
  [[nodiscard]] std::size_t classes() const { return classes_.size(); }

  void clear() {
    size_ = 0;
    classes_.clear();
    bounds_.clear();
    slots_.clear();
    sums_.reset(1);
  }
  // Inserts `count` entries, entryOf(0) first; the sums are computed once at the end.
  template <class EntryOf>
  void insertAll(std::size_t count, EntryOf entryOf) {
    for (std::size_t k = 0; k < count; ++k) {
      Entry entry = entryOf(k);
      const std::size_t slot = slotOf(rates_.volume(entry));
      raiseBounds(slot, entry);
      classes_[slot].push_back(std::move(entry));
    }
    size_ += count;
    for (std::size_t slot = 0; slot < classes_.size(); ++slot) update(slot);
  }
  [[gnu::always_inline]] void insert(const Entry& entry, std::size_t copies = 1) {
    const std::size_t slot = slotOf(rates_.volume(entry));
    for (std::size_t k = 0; k < copies; ++k) classes_[slot].push_back(entry);
    size_ += copies;
    raiseBounds(slot, entry);
    update(slot);
  }

  // Of which the terms are known.
  [[gnu::always_inline]] void insert(const Entry& entry, const CollisionKernel::Terms& terms) {
    const std::size_t slot = slotOf(rates_.volume(entry));
    classes_[slot].push_back(entry);
    ++size_;
    raiseBounds(slot, terms);
    raiseSingleBounds(slot, entry);
    update(slot);
  }

  [[nodiscard]] double pairRate() const {
    double sum = 0;
    for (std::size_t r = 0; r < rank_; ++r) sum += pairRate(r);
    return sum;
  }
  // Only where pairRate() > 0.
  bool drawPair(RandomStream& random, Entry& i, Entry& j) {
    double x = random.uniform() * pairRate();
    std::size_t r = 0;
    for (; r + 1 < rank_ && x >= pairRate(r); ++r) x -= pairRate(r);
    Place first, second;
    if (!findMember(1 + r, x / sums_.total(1 + rank_ + r), random, first)) return false;
    if (!findMember(1 + rank_ + r, random.uniform() * sums_.total(1 + rank_ + r), random, second)) return false;
    if (first.slot == second.slot && first.index == second.index) return false;
    const Entry& a = classes_[first.slot][first.index];
    const Entry& b = classes_[second.slot][second.index];
    double majorant = 0;
    for (std::size_t k = 1; k <= rank_; ++k) {
      majorant +=
          bound(first.slot, k) * bound(second.slot, k + rank_) + bound(second.slot, k) * bound(first.slot, k + rank_);
    }
    const double rate = rates_.pair(a, b);
    checkBound(rate, majorant);
    if (rate < majorant && random.uniform() * majorant >= rate) return false;
    i = a;
    j = b;
    // The one behind first, so that what fills a gap is not the other one.
    if (first.slot == second.slot && first.index < second.index) std::swap(first, second);
    remove(first);
    remove(second);
    return true;
  }

  [[nodiscard]] double singleRate(SingleProcess process) const {
    const std::size_t component = single_[static_cast<std::size_t>(process)];
    return component > 0 ? sums_.total(component) : 0.0;
  }
  // Only where singleRate(process) > 0.
  bool drawSingle(SingleProcess process, RandomStream& random, Entry& entry) {
    const std::size_t component = single_[static_cast<std::size_t>(process)];
    Place at;
    if (!findMember(component, random.uniform() * sums_.total(component), random, at)) return false;
    const Entry& candidate = classes_[at.slot][at.index];
    const double rate = rates_.single(process, candidate), most = bound(at.slot, component);
    if (rate < most && random.uniform() * most >= rate) return false;
    entry = candidate;
    remove(at);
    return true;
  }

  // Of at least one.
  Entry takeUniform(RandomStream& random) {
    const Place at = uniformPlace(random);
    Entry entry = classes_[at.slot][at.index];
    remove(at);
    return entry;
  }
  // Puts in a copy of one drawn uniformly, of at least one, and returns it.
  Entry copyUniform(RandomStream& random) {
    const Place at = uniformPlace(random);
    auto& members = classes_[at.slot];
    members.push_back(Entry(members[at.index]));
    ++size_;
    update(at.slot);
    return members.back();
  }
  // A second copy of every entry.
  void duplicate();
  // Keeps size() / 2 entries (rounded down): every subset of so many has the same probability. Each entry is kept or
  // not by the toss of a coin, the larger of the two parts stays, and of that so many are taken as it is too large.
  void discardHalf(RandomStream& random);

  // For a method that draws from several stores (hybrid_method.hpp). Components of the bounds: 0 is one for each entry,
  // 1 + r is p_r, 1 + rank + r is q_r, and one for each single process that is active.
  struct Place {
    std::size_t slot, index;
  };
  [[nodiscard]] std::size_t components() const { return components_; }
  [[nodiscard]] std::size_t component(SingleProcess process) const {
    return single_[static_cast<std::size_t>(process)];
  }
  [[nodiscard]] double total(std::size_t component) const { return sums_.total(component); }
  // Where `x` in [0, total) of a component falls; false where rounding led to a class without members.
  [[nodiscard]] bool findMember(std::size_t component, double x, Place& at) const {
    at.slot = sums_.find(component, x);
    if (at.slot >= classes_.size() || classes_[at.slot].empty()) return false;
    const std::size_t count = classes_[at.slot].size();
    const double index = x / bound(at.slot, component);
    at.index = index < static_cast<double>(count) ? static_cast<std::size_t>(index) : count - 1;
    return true;
  }
  [[nodiscard]] const Entry& entry(const Place& at) const { return classes_[at.slot][at.index]; }
  [[nodiscard]] double bound(const Place& at, std::size_t component) const { return bound(at.slot, component); }
  // Of two in one class the later one first: the last of the class moves to the gap.
  Entry take(const Place& at) {
    Entry entry = classes_[at.slot][at.index];
    remove(at);
    return entry;
  }

  template <class F>
  void forEach(F f) const {
    for (const auto& members : classes_) {
      for (const Entry& entry : members) f(entry);
    }
  }
  // All entries in contiguous pieces, for loops that are to be vectorised: f(std::span<const Entry>).
  template <class F>
  void forEachRun(F f) const {
    for (const auto& members : classes_) {
      if (!members.empty()) f(std::span<const Entry>(members));
    }
  }
  // f may change an entry and drops it by returning false. Bounds and classes are made afresh, after `then` has seen
  // the entries that stay, as a span.
  template <class F, class Then>
  void transform(F f, Then then);
  template <class F>
  void transform(F f) {
    transform(f, [](std::span<const Entry>) {});
  }
  // The same for some of the entries only, `which`: their places in the order of forEach(), each once, ascending.
  // f(Entry&, k) -> bool, of the one at the place which[k]. The bounds of what is left hold, but may be wider than
  // those made afresh.
  template <class F>
  void transformSome(std::span<const std::uint32_t> which, F f);
  // Bounds as the entries have them, when rates() are others than before, and what a store has that was made of these
  // entries in their order.
  void refresh();

 private:
  static constexpr int mantissaBits = 2;  // four classes for each factor of two in volume
  static constexpr std::uint16_t none = 0xffff;

  static std::size_t componentsOf(const Rates& rates) {
    std::size_t count = 1 + 2 * rates.rank();
    for (std::size_t k = 0; k < singleProcesses; ++k) count += rates.active(static_cast<SingleProcess>(k)) ? 1 : 0;
    return count;
  }

  [[nodiscard]] double pairRate(std::size_t r) const { return sums_.total(1 + r) * sums_.total(1 + rank_ + r); }
  [[nodiscard]] double bound(std::size_t slot, std::size_t component) const {
    return bounds_[slot * sums_.blocks() + component / SumTree::lanes].x[component % SumTree::lanes];
  }

  // Always inline: the compiler thinks the whole too large, and the calls would cost a third of an event.
  [[nodiscard, gnu::always_inline]] static std::uint64_t keyOf(double volume) {
    return std::bit_cast<std::uint64_t>(volume) >> (52 - mantissaBits);
  }
  [[nodiscard, gnu::always_inline]] std::size_t slotOf(double volume) {
    const std::uint64_t key = keyOf(volume);
    const std::uint64_t k = key - firstKey_;
    if (k < slots_.size() && slots_[k] != none) return slots_[k];
    return newSlot(key);
  }
  std::size_t newSlot(std::uint64_t key) {
    if (slots_.empty()) firstKey_ = key;
    if (key < firstKey_) {
      slots_.insert(slots_.begin(), firstKey_ - key, none);
      firstKey_ = key;
    }
    if (key - firstKey_ >= slots_.size()) slots_.resize(key - firstKey_ + 1, none);
    const std::size_t slot = classes_.size();
    slots_[key - firstKey_] = static_cast<std::uint16_t>(slot);
    classes_.emplace_back();
    bounds_.resize(classes_.size() * sums_.blocks());
    if (classes_.size() > sums_.leaves()) {
      sums_.reset(2 * sums_.leaves());
      for (std::size_t k = 0; k < classes_.size(); ++k) update(k);
    }
    return slot;
  }

  // No store hardly ever: update() is going to load all bounds at once.
  [[gnu::always_inline]] void raise(std::size_t slot, std::size_t component, double value) {
    auto& x = bounds_[slot * sums_.blocks() + component / SumTree::lanes].x;
    if (value > x[component % SumTree::lanes]) [[unlikely]]
      x[component % SumTree::lanes] = value;
  }
  [[gnu::always_inline]] void raiseBounds(std::size_t slot, const CollisionKernel::Terms& terms) {
    raise(slot, 0, 1);
    for (std::size_t r = 0; r < rank_; ++r) {
      raise(slot, 1 + r, terms.p[r]);
      raise(slot, 1 + rank_ + r, terms.q[r]);
    }
  }
  [[gnu::always_inline]] void raiseBounds(std::size_t slot, const Entry& entry) {
    if (rank_ > 0)
      raiseBounds(slot, rates_.terms(entry));
    else
      raise(slot, 0, 1);
    raiseSingleBounds(slot, entry);
  }
  [[gnu::always_inline]] void raiseSingleBounds(std::size_t slot, const Entry& entry) {
    if (components_ == 1 + 2 * rank_) return;
    for (std::size_t k = 0; k < singleProcesses; ++k) {
      if (single_[k] > 0) raise(slot, single_[k], singleBound(rates_, static_cast<SingleProcess>(k), entry));
    }
  }
  [[gnu::always_inline]] void update(std::size_t slot) {
    sums_.set(slot, static_cast<double>(classes_[slot].size()), &bounds_[slot * sums_.blocks()]);
  }

  // The same by a second random number: the member is known without waiting for the remainder of the first.
  [[nodiscard, gnu::always_inline]] bool findMember(std::size_t component, double x, RandomStream& random,
                                                    Place& at) const {
    at.slot = sums_.find(component, x);
    if (at.slot >= classes_.size() || classes_[at.slot].empty()) return false;
    at.index = static_cast<std::size_t>(random.below(classes_[at.slot].size()));
    return true;
  }
  [[nodiscard, gnu::always_inline]] Place uniformPlace(RandomStream& random) const {
    // Numbers are exact, and their remainder is a place in the class.
    double x = random.uniform() * static_cast<double>(size_);
    const std::size_t slot = sums_.find(0, x);
    return {slot, static_cast<std::size_t>(x)};
  }

  [[gnu::always_inline]] void remove(const Place& at) {
    auto& members = classes_[at.slot];
    members[at.index] = std::move(members.back());
    members.pop_back();
    --size_;
    update(at.slot);
    if (members.empty() || members.size() < members.capacity() / 4) release(at.slot);
  }
  void release(std::size_t slot);

  Rates rates_;
  std::size_t rank_, components_ = 1, size_ = 0;
  std::array<std::size_t, singleProcesses> single_{};  // component of each process; zero: off
  std::uint64_t firstKey_ = 0;
  std::vector<std::uint16_t> slots_;  // of the keys from firstKey_ on
  std::vector<std::vector<Entry>> classes_;
  std::vector<SumTree::Lanes> bounds_;  // of each class: 1, p_r, q_r, single rates
  std::vector<Entry> moving_;           // from one class to another, in transformSome()
  SumTree sums_;
};

}  // namespace lampblack::particles

#include "core/modules.hpp"
#include "particles/population/monte_carlo/class_store_changes.hpp"
