// Weighted entries in one flat array without order: for the small populations of many cells, where a sorted structure
// costs more than it saves. A pair is drawn by two walks over sums of bounds (FactoredSums), and what coagulated goes
// back to the places it came from, so that an event touches two entries and two blocks. The bounds are those of each
// entry itself, which turns down fewer pairs than bounds of whole chunks (SortedStore). O(N / 32 + 32) an event;
// neighbours in volume are merged many at once (NeighbourMerger), O(N log N).
//
// Small particles may be taken up in bundles (setBundledGrowth, BundleLimits): then each r of the kernel's bound
// sum_r w_j [p_r(i) q_r(j) + q_r(i) p_r(j)] is summed with the one drawn by weight, j, small or not; its partner counts
// once, or where j is small once a bundle.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "core/random.hpp"
#include "particles/population/monte_carlo/bundle_limits.hpp"
#include "particles/population/monte_carlo/factored_sums.hpp"
#include "particles/population/monte_carlo/neighbour_merger.hpp"
#include "particles/population/monte_carlo/sorted_store.hpp"
#include "particles/population/monte_carlo/volume_order.hpp"

namespace lampblack::particles {

template <SortedRates Rates>
class TwoLevelStore {
 public:
  using Entry = typename Rates::Entry;

  explicit TwoLevelStore(Rates rates)
      : rates_(std::move(rates)), rank_(rates_.rank()), sums_(2 * rank_ + activeSingles()) {
    singleValue_.fill(unused);
    std::size_t value = 2 * rank_;
    for (std::size_t process = 0; process < singleProcesses; ++process)
      if (rates_.active(static_cast<SingleProcess>(process))) singleValue_[process] = value++;
  }

  [[nodiscard]] std::size_t size() const { return entries_.size() - holes_; }
  [[nodiscard]] std::size_t bytes() const { return entries_.capacity() * sizeof(Entry) + sums_.bytes(); }
  [[nodiscard]] const Rates& rates() const { return rates_; }
  // The share of its volume that a particle may gain from small particles in one event; zero: no bundles. Only where a
  // pair coagulates at the larger of its weights.
  void setBundledGrowth(double share) { bundledGrowth_ = share; }
  // How many of the second particle each of the first takes up in the event that was drawn last.
  [[nodiscard]] double collected() const { return collected_; }

  // After the rates changed: all bounds anew, the kernel's majorant tuned to the population. O(N).
  template <class F>
  void changeRates(F&& change) {
    closeHoles();
    isMeasured_ = false;
    change(rates_);
  }
  // In order of volume, then weight, without what events leave behind, holes and rounding errors of sums: what follows
  // depends on the entries alone, and so does what forEach() shows.
  void sort() {
    closeHoles();
    order_.sort(entries_, rates_);
    isMeasured_ = false;
  }

  void clear() {
    entries_.clear();
    holes_ = 0;
    isMeasured_ = false;
  }
  void insert(const Entry& entry, std::size_t copies = 1) {
    for (; copies > 0; --copies) {
      if (holes_ > 0) {
        const std::size_t at = hole_[--holes_];
        entries_[at] = entry;
        if (isMeasured_) sums_.set(at, valuesOf(entry), factorsOf(entry));
      } else {
        entries_.push_back(entry);
        if (isMeasured_) sums_.append(valuesOf(entry), factorsOf(entry));
      }
      countChange();
    }
  }
  // Replaces everything.
  void assign(std::vector<Entry> entries) {
    entries_ = std::move(entries);
    holes_ = 0;
    isMeasured_ = false;
  }

  // Rates of what was taken out are in the sum until something goes in or is drawn: a bound all the same.
  [[nodiscard]] double pairRate() const {
    measure();
    double sum = 0;
    for (std::size_t part = 0; part < 4 * rank_; ++part) sum += product(part);
    return rates_.weightFactor() * sum;
  }
  bool drawPair(RandomStream& random, Entry& first, Entry& second) {
    return drawPair(random, first, second, [](const Entry&, const Entry&) { return std::array{0.0, 0.0}; });
  }
  // left(first, second) says which weights stay in.
  template <class Left>
  bool drawPair(RandomStream& random, Entry& first, Entry& second, Left&& left);

  [[nodiscard]] double singleRate(SingleProcess process) const {
    measure();
    const std::size_t value = singleValue_[static_cast<std::size_t>(process)];
    return value == unused ? 0 : sums_.total(value, once);
  }
  bool drawSingle(SingleProcess process, RandomStream& random, Entry& entry) {
    closeHoles();
    const double rate = singleRate(process);
    if (!(rate > 0)) return false;
    const std::size_t value = singleValue_[static_cast<std::size_t>(process)];
    const std::size_t at = sums_.find(value, once, random.uniform() * rate);
    if (at >= entries_.size()) return false;
    if (!(rates_.single(process, entries_[at]) > random.uniform() * sums_.value(value, at))) return false;
    entry = take(at);
    return true;
  }
  [[nodiscard]] Entry takeUniform(RandomStream& random) {
    closeHoles();
    return take(static_cast<std::size_t>(random.below(entries_.size())));
  }

  // NeighbourMerger.
  template <class MeanOf>
  std::size_t mergeDownTo(std::size_t count, MeanOf&& meanOf) {
    closeHoles();
    const std::size_t merged = merger_.mergeDownTo(count, entries_, rates_, meanOf);
    if (merged > 0) isMeasured_ = false;
    return merged;
  }
  template <class MeanOf>
  bool mergeNearest(MeanOf&& meanOf) {
    return size() >= 2 && mergeDownTo(size() - 1, meanOf) > 0;
  }
  // By looking at all; what each does is said in sorted_store.hpp.
  [[nodiscard]] Entry takeNearest(const Entry& like) {
    closeHoles();
    const double volume = rates_.volume(like);
    std::size_t best = 0;
    const auto distance = [&](std::size_t k) { return std::abs(rates_.volume(entries_[k]) - volume); };
    for (std::size_t k = 1; k < entries_.size(); ++k) {
      const double d = distance(k), least = distance(best);
      if (d < least || (d == least && rates_.volume(entries_[k]) > rates_.volume(entries_[best]))) best = k;
    }
    return take(best);
  }
  [[nodiscard]] Entry takeHeaviest() {
    closeHoles();
    std::size_t best = 0;
    for (std::size_t k = 1; k < entries_.size(); ++k)
      if (rates_.weight(entries_[k]) > rates_.weight(entries_[best])) best = k;
    return take(best);
  }

  template <class F>
  void forEach(F&& f) const {
    for (std::size_t k = 0; k < entries_.size(); ++k)
      if (!isHole(k)) f(entries_[k]);
  }
  // f(Entry&) -> bool, false drops the entry.
  template <class F>
  void transform(F&& f) {
    closeHoles();
    std::size_t kept = 0;
    for (Entry& entry : entries_)
      if (f(entry)) {
        if (&entries_[kept] != &entry) entries_[kept] = entry;
        ++kept;
      }
    entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(kept), entries_.end());
    isMeasured_ = false;
  }

 private:
  // What p and q of an entry are summed with.
  enum Factor : std::size_t { once, perBundle, weightOfOthers, weightOfSmall, factors };
  using Sums = FactoredSums<2 * CollisionKernel::largestRank + singleProcesses, factors>;
  static constexpr std::size_t unused = ~std::size_t{0};
  static constexpr std::size_t leastChanges = 64;  // before sums are renewed

  [[nodiscard]] std::size_t activeSingles() const {
    std::size_t count = 0;
    for (std::size_t process = 0; process < singleProcesses; ++process)
      count += rates_.active(static_cast<SingleProcess>(process)) ? 1 : 0;
    return count;
  }

  // The pair rate is a sum of 4 products for each r: the one drawn by weight is small or not, and has p or q; the
  // other has what is left.
  struct Part {
    std::size_t weighted, counted;  // values: p_r or q_r
    Factor weight, count;
  };
  static Part partOf(std::size_t part) {
    const std::size_t p = part / 4 * 2, q = p + 1;
    const bool isSmall = part % 4 >= 2, isQ = part % 2 == 1;
    return {isQ ? q : p, isQ ? p : q, isSmall ? weightOfSmall : weightOfOthers, isSmall ? perBundle : once};
  }
  [[nodiscard]] double product(std::size_t part) const {
    const Part of = partOf(part);
    return sums_.total(of.weighted, of.weight) * sums_.total(of.counted, of.count);
  }
  [[nodiscard]] bool isSmall(const Entry& entry) const {
    return limits_.isSmall(rates_.volume(entry), rates_.weight(entry));
  }
  [[nodiscard]] double bundleOf(const Entry& entry) const {
    return limits_.bundle(rates_.volume(entry), rates_.weight(entry));
  }
  [[nodiscard]] bool accepts(std::size_t i, std::size_t j, double bundle, double u) const;

  [[nodiscard]] bool isHole(std::size_t at) const {
    for (std::size_t k = 0; k < holes_; ++k)
      if (hole_[k] == at) return true;
    return false;
  }
  void stayOrGo(std::size_t at, double weight) {
    if (weight > 0) {
      entries_[at].weight = weight;
      sums_.setFactors(at, factorsOf(entries_[at]));
      countChange();
    } else {
      hole_[holes_++] = at;
    }
  }
  // What came out and did not go back: the last entries go there.
  void closeHoles() {
    if (holes_ == 2 && hole_[0] > hole_[1]) std::swap(hole_[0], hole_[1]);
    while (holes_ > 0) remove(hole_[--holes_]);  // the later one first
  }
  void remove(std::size_t at) {
    if (isMeasured_) sums_.replaceByLast(at);
    entries_[at] = entries_.back();
    entries_.pop_back();
    countChange();
  }
  [[nodiscard]] Entry take(std::size_t at) {
    const Entry entry = entries_[at];
    remove(at);
    return entry;
  }
  void countChange() {
    if (++changes_ <= entries_.size() + leastChanges || !isMeasured_) return;
    sums_.renew();
    changes_ = 0;
  }

  [[nodiscard]] typename Sums::Values valuesOf(const Entry& entry) const {
    typename Sums::Values values;
    const CollisionKernel::Terms terms = rank_ > 0 ? rates_.terms(entry) : CollisionKernel::Terms{};
    for (std::size_t r = 0; r < rank_; ++r) {
      values[2 * r] = terms.p[r];
      values[2 * r + 1] = terms.q[r];
    }
    for (std::size_t process = 0; process < singleProcesses; ++process)
      if (singleValue_[process] != unused)
        values[singleValue_[process]] = singleBound(rates_, static_cast<SingleProcess>(process), entry);
    return values;
  }
  [[nodiscard]] typename Sums::Factors factorsOf(const Entry& entry) const {
    const double weight = rates_.weight(entry);
    const bool small = isSmall(entry);
    return {1.0, 1.0 / bundleOf(entry), small ? 0.0 : weight, small ? weight : 0.0};
  }
  // All bounds and sums anew, where they are not those of the entries.
  void measure() const {
    if (isMeasured_) return;
    isMeasured_ = true;
    changes_ = 0;
    findLimits();
    sums_.resize(entries_.size());
    for (std::size_t at = 0; at < entries_.size(); ++at)
      sums_.place(at, valuesOf(entries_[at]), factorsOf(entries_[at]));
    sums_.renew();
  }
  void findLimits() const {
    if (!(bundledGrowth_ > 0)) return;
    volumes_.clear();
    weights_.clear();
    for (const Entry& entry : entries_) {
      volumes_.push_back(rates_.volume(entry));
      weights_.push_back(rates_.weight(entry));
    }
    limits_.find(bundledGrowth_, volumes_, weights_);
  }

  Rates rates_;
  std::size_t rank_;
  std::array<std::size_t, singleProcesses> singleValue_{};
  double bundledGrowth_ = 0, collected_ = 1;
  std::vector<Entry> entries_;
  std::array<std::size_t, 2> hole_{};  // places whose entries are out
  std::size_t holes_ = 0;
  VolumeOrder<Rates> order_;
  NeighbourMerger<Rates> merger_;
  // Bounds are found when somebody asks: not each of many changes to all entries is followed by an event.
  mutable bool isMeasured_ = false;
  mutable std::size_t changes_ = 0;
  mutable Sums sums_;
  mutable BundleLimits limits_;
  mutable std::vector<double> volumes_, weights_;
};

template <SortedRates Rates>
template <class Left>
bool TwoLevelStore<Rates>::drawPair(RandomStream& random, Entry& first, Entry& second, Left&& left) {
  closeHoles();
  measure();
  double total = 0;
  for (std::size_t part = 0; part < 4 * rank_; ++part) total += product(part);
  if (size() < 2 || !(total > 0)) return false;
  // Which product of sums; what is left of the random number finds the partner drawn by weight.
  double x = random.uniform() * total;
  std::size_t part = 0;
  for (; part + 1 < 4 * rank_; ++part) {
    const double of = product(part);
    if (x < of) break;
    x -= of;
  }
  const Part of = partOf(part);
  const double counted = sums_.total(of.counted, of.count);
  if (!(counted > 0)) return false;
  std::size_t i = sums_.find(of.counted, of.count, random.uniform() * counted);
  std::size_t j = sums_.find(of.weighted, of.weight, x / counted);
  if (i >= entries_.size() || j >= entries_.size() || i == j) return false;
  if (isSmall(entries_[i]) && bundleOf(entries_[j]) > 1) std::swap(i, j);  // i collects
  const double bundle = isSmall(entries_[j]) ? bundleOf(entries_[i]) : 1.0;
  if (!accepts(i, j, bundle, random.uniform())) return false;
  first = entries_[i];
  second = entries_[j];
  collected_ = bundle;
  const std::array<double, 2> weights = left(first, second);
  stayOrGo(i, weights[0]);
  stayOrGo(j, weights[1]);
  return true;
}

// Whether an attempt at a pair becomes an event, u being uniform: with the ratio of its rate to that of attempts.
template <SortedRates Rates>
bool TwoLevelStore<Rates>::accepts(std::size_t i, std::size_t j, double bundle, double u) const {
  const auto &of = sums_.factorsOf(i), &with = sums_.factorsOf(j);
  const double attempts = rates_.weightFactor() * (of[weightOfOthers] + of[weightOfSmall] * with[perBundle] +
                                                   with[weightOfOthers] + with[weightOfSmall] * of[perBundle]);
  // Weights decide first: they are cheap.
  if (!(rates_.weightPart(entries_[i], entries_[j]) > u * attempts * bundle)) return false;
  double majorant = 0;
  for (std::size_t p = 0; p < 2 * rank_; p += 2)
    majorant += sums_.value(p, i) * sums_.value(p + 1, j) + sums_.value(p + 1, i) * sums_.value(p, j);
  return rates_.pair(entries_[i], entries_[j]) > u * attempts * bundle * majorant;
}

}  // namespace lampblack::particles
