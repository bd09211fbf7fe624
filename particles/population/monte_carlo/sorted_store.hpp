// Weighted entries kept in order of volume, then weight, in chunks of up to 64, so that neighbours in volume are found
// and merged in O(log N). Trees over the chunks hold sums of their bounds, from which pairs and single entries are
// drawn, and the smallest difference between neighbours.
//
// Pairs: sum_r of (w_i + w_j) [p_r(i) q_r(j) + p_r(j) q_r(i)] over unordered pairs is sum_r of
// (sum w p_r) (sum q_r) + (sum p_r) (sum w q_r) over ordered ones, self-pairs being fictitious. One partner is drawn by
// weight times bound, the other by bound alone: the chunk from a tree, the entry within the chunk. The sums are over
// bounds that hold for a whole chunk and are renewed only when few per cent off, which acceptance makes up for exactly.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "particles/population/monte_carlo/chunk_directory.hpp"
#include "particles/population/monte_carlo/chunk_trees.hpp"
#include "particles/population/monte_carlo/sorted_chunk.hpp"
#include "particles/population/monte_carlo/store.hpp"

namespace lampblack::particles {

// The rates say in addition how neighbours are compared, which extremes are needed, what is known of the terms, what
// part of pair() is that of the weights, and decide an attempt: accepts(i, j, m, u) is pair(i, j) > u * weightFactor *
// (w_i + w_j) * m.
template <class R>
concept SortedRates = EntryRates<R> && requires(const R rates, const typename R::Entry entry, double x) {
  { R::bare } -> std::convertible_to<bool>;                  // the particle is its volume
  { rates.entry(x, x) } -> std::same_as<typename R::Entry>;  // where bare
  { rates.relativeDifference() } -> std::same_as<bool>;      // Wang (2025), eq. 5-12 instead of 5-11
  { rates.merges() } -> std::same_as<bool>;                  // mergeNearest() may be called
  { rates.keepsHeaviest() } -> std::same_as<bool>;           // takeHeaviest() may be called
  { rates.monotone() } -> std::same_as<bool>;  // terms and single rates are largest at an end of a range of volumes
  { rates.weightPart(entry, entry) } -> std::convertible_to<double>;
  { rates.accepts(entry, entry, x, x) } -> std::same_as<bool>;
};

template <SortedRates Rates>
class SortedStore {
 public:
  using Entry = typename Rates::Entry;

  explicit SortedStore(Rates rates);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] const Rates& rates() const { return rates_; }
  // After the rates changed: all bounds anew, the kernel's majorant tuned to the population. O(N).
  template <class F>
  void changeRates(F&& change);

  void clear();
  void insert(const Entry& entry, std::size_t copies = 1);
  // Fetches into the cache what inserting this will need.
  void expect(const Entry& entry) { fetch(2, rates_.volume(entry), rates_.weight(entry)); }
  // Replaces everything; O(N) where the entries come in order.
  void assign(std::vector<Entry> entries);

  [[nodiscard]] double pairRate() const { return pairRate_; }
  bool drawPair(RandomStream& random, Entry& first, Entry& second) {
    return drawPair(random, first, second, [](const Entry&, const Entry&) { return std::array{0.0, 0.0}; });
  }
  // The same for events that leave something of the pair: left(first, second) says which weights stay, none of them
  // above what there was. What stays mostly keeps its place.
  template <class Left>
  bool drawPair(RandomStream& random, Entry& first, Entry& second, Left&& left);
  [[nodiscard]] double singleRate(SingleProcess process) const {
    const std::size_t quantity = singleQuantity_[static_cast<std::size_t>(process)];
    return quantity == unused ? 0 : sums_.total(quantity);
  }
  bool drawSingle(SingleProcess process, RandomStream& random, Entry& entry);
  [[nodiscard]] Entry takeUniform(RandomStream& random);

  // Takes out the two neighbours with the smallest difference, of equal differences the one whose lower particle has
  // the smallest weight (Wang 2025, section 5.2.6), and inserts meanOf(lower, upper). False with fewer than two
  // entries.
  template <class MeanOf>
  bool mergeNearest(MeanOf&& meanOf);
  // Takes out the entry whose volume is nearest to that of `like`, as seen from where `like` would be (Wang 2025, eqs.
  // 4-16, 4-17: the upper one when both are as near). There is one at least.
  [[nodiscard]] Entry takeNearest(const Entry& like);
  [[nodiscard]] Entry takeHeaviest();

  // In order, f(const Entry&).
  template <class F>
  void forEach(F&& f) const;
  // f(Entry&) -> bool, false drops the entry. O(N), or O(N log N) where the order changes.
  template <class F>
  void transform(F&& f);

 private:
  using Chunk = SortedChunk<decltype(Entry::particle), Rates::bare>;
  using Slot = std::uint32_t;
  struct Place {
    Slot slot;
    std::uint32_t at;
  };
  static constexpr Slot none = Chunk::none;
  static constexpr std::size_t unused = ~std::size_t{0};
  static constexpr std::uint32_t filled = 52, sparse = 26;  // entries of a chunk when built, and when joined
  static constexpr std::uint32_t countSlack = 4;
  static constexpr double weightSlack = 1.0625;

  [[nodiscard]] Entry entryAt(const Chunk& chunk, std::uint32_t at) const {
    if constexpr (Rates::bare)
      return rates_.entry(chunk.volume(at), chunk.weight(at));
    else
      return {chunk.particles[at], chunk.weight(at)};
  }
  [[nodiscard]] Slot locate(double volume, double weight) const;

  // Two random numbers find a pair. Both are drawn two attempts ahead, so that what they will most likely find is in
  // the cache by then: first the sums over its chunks, then the chunks. What they do find is up to the sums of that
  // time.
  struct PairDraw {
    double x = 0, y = 0;  // uniform in (0, 1)
  };
  // One of the two partners, or the group of chunks that it is in, and how far from its start.
  struct Found {
    std::size_t at;
    double distance;
  };
  struct Partners {
    std::size_t term;               // r
    bool q;                         // whether the weighted sum is that of q
    std::size_t weighted, counted;  // quantities of the sums
    Found heavy, other;             // distances from the start of everything
  };
  [[nodiscard]] Partners locate(const PairDraw& draw) const;
  static PairDraw drawTwo(RandomStream& random) {
    const double x = random.uniform();
    return {x, random.uniform()};
  }
  PairDraw nextDraw(RandomStream& random);
  void fetch(std::size_t which, double volume, double weight);
  // Out of its chunk; joinIfSparse() is due.
  void erase(Place place);
  bool lessen(Place place, double weight);  // where it is, if the order allows that
  void eraseTwo(Place place);               // this one and the next, in one chunk; the smallest difference gets stale
  void joinIfSparse(Slot slot);
  Entry take(Place place);

  // Structure: sorted_store_chunks.hpp.
  Slot makeChunk();
  void link(Slot after, Slot fresh);
  void split(Slot slot);
  bool join(Slot slot);
  void absorbNext(Slot slot);

  // Summaries: sorted_store_sums.hpp.
  void touched(Slot slot);
  void publish(Slot slot);
  void forget(Slot slot);
  void findBounds(Chunk& chunk);
  bool raiseBounds(Chunk& chunk, const Entry& entry);
  void refreshPairRate();
  [[nodiscard]] bool raise(Chunk& chunk, const Entry& entry) const;
  void consider(Chunk& chunk, std::uint32_t at) {
    if (!rates_.merges()) return;
    if (rates_.relativeDifference())
      chunk.template consider<true>(at);
    else
      chunk.template consider<false>(at);
  }
  void findLeast(Chunk& chunk) {
    if (!rates_.merges()) return;
    if (rates_.relativeDifference())
      chunk.template findLeast<true>();
    else
      chunk.template findLeast<false>();
  }
  void setLeast(Slot slot) {
    if (!rates_.merges()) return;
    const LeastOfChunks::Key& key = chunks_[slot].least;
    if (!(key == least_.key(slot))) least_.set(slot, key);
  }
  void setHeaviest(Slot slot) { heaviest_.set(slot, {-chunks_[slot].heaviest, 0}); }

  Rates rates_;
  std::size_t rank_;
  std::array<std::size_t, singleProcesses> singleQuantity_;
  std::size_t quantities_;
  std::vector<Chunk> chunks_;
  std::vector<Slot> free_;
  Slot first_ = 0;
  std::size_t size_ = 0;
  std::array<Slot, 2> recent_{0, 0};  // chunks where something was taken out; what replaces it is likely to go there
  std::array<Slot, 3> expected_{};    // chunks that were fetched for what will be put in
  ChunkDirectory directory_;
  // For each r: count p, count q, weight p, weight q; then count times single rates that are active.
  SumsOfChunks sums_;
  double pairRate_ = 0;
  std::array<double, 2 * CollisionKernel::largestRank> pairParts_{};  // without the factor, running sums
  struct {
    bool drawn = false;
    PairDraw next, afterNext;
    Partners partners{};  // of afterNext as things stood: their groups
  } ahead_;
  LeastOfChunks least_, heaviest_;
};

}  // namespace lampblack::particles

#include "core/modules.hpp"
#include "particles/population/monte_carlo/sorted_store_chunks.hpp"
#include "particles/population/monte_carlo/sorted_store_draws.hpp"
#include "particles/population/monte_carlo/sorted_store_sums.hpp"
