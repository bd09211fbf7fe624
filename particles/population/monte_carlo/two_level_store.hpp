// Weighted entries in one flat array without order, with sums of their bounds over blocks of neighbouring places: for
// the small populations of many cells, where a sorted structure costs more than it saves. A pair is drawn by two walks
// over the sums of blocks and of one block each, and what coagulated goes back to the places it came from, so that an
// event touches two entries and two blocks. The bounds are those of each entry itself, which turns down fewer pairs
// than bounds of whole chunks (SortedStore). O(N / 32 + 32) an event; neighbours in volume are merged many at once
// (mergeDownTo), O(N log N).
//
// Several at once (setShareAtOnce). A large particle that stands for few meets the small ones that most of the number
// is made of very often, and each meeting changes it by next to nothing. Such meetings are then drawn in bundles: the
// event of a collector i with a small particle j stands for g_i of them and happens 1/g_i times as often. g_i is so
// small that the g_i small ones are no more than the given share of the volume of i, and that they take no more than
// half of what j stands for. Number and mass have the right mean, each event keeps mass; the growth of the second
// moment by these meetings is too large by at most half that share. Small are those up to the volume within which nine
// tenths of the number lie and that stand for many; both limits are found where all bounds are.
//
// Sums are changed by differences and made anew after as many changes as there are entries, so that rounding errors do
// not pile up; a walk that ends beyond the last entry for such an error is a fictitious event.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "core/cube_root.hpp"
#include "core/random.hpp"
#include "core/rooms.hpp"
#include "particles/population/monte_carlo/sorted_store.hpp"

namespace lampblack::particles {

template <SortedRates Rates>
class TwoLevelStore {
 public:
  using Entry = typename Rates::Entry;

  explicit TwoLevelStore(Rates rates) : rates_(std::move(rates)), rank_(rates_.rank()) {
    quantities_ = groups * rank_;
    singleQuantity_.fill(unused);
    for (std::size_t process = 0; process < singleProcesses; ++process)
      if (rates_.active(static_cast<SingleProcess>(process))) singleQuantity_[process] = quantities_++;
  }

  [[nodiscard]] std::size_t size() const { return entries_.size() - holes_; }
  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = entries_.capacity() * sizeof(Entry);
    for (std::size_t k = 0; k < quantities_; ++k)
      sum += (bounds_[k].capacity() + blocks_[k].capacity()) * sizeof(double);
    return sum;
  }
  [[nodiscard]] const Rates& rates() const { return rates_; }
  // The share of a particle's volume that it may take up at once, zero: one by one. Only where a pair coagulates at
  // the larger of its weights.
  void setShareAtOnce(double share) { shareAtOnce_ = share; }
  // How many of the second particle each of the first takes up in the event that was drawn last.
  [[nodiscard]] double collected() const { return collected_; }

  // After the rates changed: all bounds anew, the kernel's majorant tuned to the population. O(N).
  template <class F>
  void changeRates(F&& change) {
    closeHoles();
    change(rates_);
    isMeasured_ = false;
  }

  // Puts what events have left out of order in order, so that nothing depends on the way that led here.
  void settle() {
    closeHoles();
    if (sort()) isMeasured_ = false;
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
        const bool isSame = rates_.volume(entries_[at]) == rates_.volume(entry);
        entries_[at] = entry;
        setBounds(at, isSame);
        countChange();
        continue;
      }
      entries_.push_back(entry);
      if (!isMeasured_) continue;
      isSmall_.push_back(0);
      bundle_.push_back(1.0);
      const std::size_t at = entries_.size() - 1;
      for (std::size_t k = 0; k < quantities_; ++k) {
        bounds_[k].push_back(0.0);
        if (at % block == 0) blocks_[k].push_back(0.0);
      }
      setBounds(at, false);
      countChange();
    }
  }
  // Replaces everything, in order of volume, then weight.
  void assign(std::vector<Entry> entries) {
    entries_ = std::move(entries);
    holes_ = 0;
    sort();
    isMeasured_ = false;
  }

  // Those of what was taken out are in the rates until something goes in or is drawn: a bound all the same.
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
  bool drawPair(RandomStream& random, Entry& first, Entry& second, Left&& left) {
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
    const double counted = totals_[countedOf(part)];
    if (!(counted > 0)) return false;
    std::size_t i = find(countedOf(part), random.uniform() * counted);
    std::size_t j = find(weightedOf(part), x / counted);
    if (i >= entries_.size() || j >= entries_.size() || i == j) return false;
    double majorant = 0;
    for (std::size_t s = 0; s < rank_; ++s)
      majorant +=
          bounds_[groups * s][i] * bounds_[groups * s + 1][j] + bounds_[groups * s + 1][i] * bounds_[groups * s][j];
    if (isSmall_[i] != 0 && bundle_[j] > 1) std::swap(i, j);  // i collects
    const double bundle = isSmall_[j] != 0 ? bundle_[i] : 1.0;
    if (!accepts(i, j, bundle, majorant, random.uniform())) return false;
    first = entries_[i];
    second = entries_[j];
    collected_ = bundle;
    const std::array<double, 2> weights = left(first, second);
    stayOrGo(i, weights[0]);
    stayOrGo(j, weights[1]);
    return true;
  }

  [[nodiscard]] double singleRate(SingleProcess process) const {
    measure();
    const std::size_t quantity = singleQuantity_[static_cast<std::size_t>(process)];
    return quantity == unused ? 0 : totals_[quantity];
  }
  bool drawSingle(SingleProcess process, RandomStream& random, Entry& entry) {
    closeHoles();
    const double rate = singleRate(process);
    if (!(rate > 0)) return false;
    const std::size_t quantity = singleQuantity_[static_cast<std::size_t>(process)];
    const std::size_t at = find(quantity, random.uniform() * rate);
    if (at >= entries_.size()) return false;
    if (!(rates_.single(process, entries_[at]) > random.uniform() * bounds_[quantity][at])) return false;
    entry = take(at);
    return true;
  }
  [[nodiscard]] Entry takeUniform(RandomStream& random) {
    closeHoles();
    return take(static_cast<std::size_t>(random.below(entries_.size())));
  }

  // As mergeNearest() of SortedStore, until `count` are left: what merges are the neighbours with the smallest
  // difference, of equal differences the pair whose lower particle has the smallest weight. Returns how many merged.
  template <class MeanOf>
  std::size_t mergeDownTo(std::size_t count, MeanOf&& meanOf);
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
  // f(Entry&) -> bool, false drops the entry. In order of volume afterwards.
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
    sort();
    isMeasured_ = false;
  }

 private:
  static constexpr std::size_t block = 32;
  static constexpr std::size_t unused = ~std::size_t{0};
  static constexpr std::size_t mostQuantities = 8 * CollisionKernel::largestRank + singleProcesses;
  // Of the events that are left: more of them do not pay for the sums.
  static constexpr double heavyPart = 0.05, worthwhile = 0.8;

  // Of each r: p and q of an entry; both over its bundle; both times its weight where it is not small, and where it is.
  static constexpr std::size_t groups = 8;
  // Of a part: which r, whether the weighted sum is that of the small ones, and whether it is that of q.
  static std::size_t weightedOf(std::size_t part) { return groups * (part / 4) + 4 + part % 4; }
  static std::size_t countedOf(std::size_t part) {
    const bool ofSmall = part % 4 >= 2, isQ = part % 2 == 1;
    return groups * (part / 4) + (ofSmall ? 2 : 0) + (isQ ? 0 : 1);
  }
  [[nodiscard]] double product(std::size_t part) const { return totals_[weightedOf(part)] * totals_[countedOf(part)]; }
  // Whether an attempt at a pair becomes an event, u being uniform: with the ratio of its rate to that of attempts.
  [[nodiscard]] bool accepts(std::size_t i, std::size_t j, double bundle, double majorant, double u) const {
    const double wi = rates_.weight(entries_[i]), wj = rates_.weight(entries_[j]);
    const double attempts =
        rates_.weightFactor() * ((isSmall_[i] != 0 ? wi / bundle_[j] : wi) + (isSmall_[j] != 0 ? wj / bundle_[i] : wj));
    // Weights decide first: they are cheap.
    if (!(rates_.weightPart(entries_[i], entries_[j]) > u * attempts * bundle)) return false;
    return rates_.pair(entries_[i], entries_[j]) > u * attempts * bundle * majorant;
  }

  [[nodiscard]] bool less(const Entry& a, const Entry& b) const {
    const double va = rates_.volume(a), vb = rates_.volume(b);
    return va < vb || (va == vb && rates_.weight(a) < rates_.weight(b));
  }
  bool sort() const {  // whether they were not
    const auto inOrder = [this](const Entry& a, const Entry& b) { return less(a, b); };
    if (std::is_sorted(entries_.begin(), entries_.end(), inOrder)) return false;
    std::stable_sort(entries_.begin(), entries_.end(), inOrder);
    return true;
  }
  [[nodiscard]] bool isHole(std::size_t at) const {
    for (std::size_t k = 0; k < holes_; ++k)
      if (hole_[k] == at) return true;
    return false;
  }

  void stayOrGo(std::size_t at, double weight) {
    if (weight > 0) {
      entries_[at].weight = weight;
      setBounds(at, true);
      countChange();
    } else {
      hole_[holes_++] = at;
    }
  }
  // What came out and did not go back: the last entries go there.
  void closeHoles() {
    if (holes_ == 0) return;
    if (holes_ == 2 && hole_[0] > hole_[1]) std::swap(hole_[0], hole_[1]);
    while (holes_ > 0) remove(hole_[--holes_]);  // the later one first
  }
  void remove(std::size_t at) {
    const std::size_t last = entries_.size() - 1;
    for (std::size_t k = 0; isMeasured_ && k < quantities_; ++k) {
      change(k, at, bounds_[k][last]);
      change(k, last, 0.0);
      bounds_[k].pop_back();
      if (last % block == 0) blocks_[k].pop_back();
    }
    entries_[at] = entries_[last];
    if (isMeasured_) {
      isSmall_[at] = isSmall_[last];
      bundle_[at] = bundle_[last];
      isSmall_.pop_back();
      bundle_.pop_back();
    }
    entries_.pop_back();
  }
  [[nodiscard]] Entry take(std::size_t at) {
    const Entry entry = entries_[at];
    remove(at);
    return entry;
  }

  void change(std::size_t quantity, std::size_t at, double value) const {
    const double by = value - bounds_[quantity][at];
    bounds_[quantity][at] = value;
    blocks_[quantity][at / block] += by;
    totals_[quantity] += by;
  }
  // What an entry has: whether it is small, how many small ones it takes up at once, and what the sums are made of.
  struct Bounds {
    bool isSmall;
    double bundle;
    std::array<double, mostQuantities> values;
  };
  void boundsOf(std::size_t at, const CollisionKernel::Terms& terms, Bounds& out) const {
    const Entry& entry = entries_[at];
    const double weight = rates_.weight(entry), volume = rates_.volume(entry);
    out.isSmall = smallVolume_ > 0 && volume <= smallVolume_ && weight >= heavyWeight_;
    out.bundle =
        smallVolume_ > 0
            ? std::max(1.0, std::floor(std::min(shareAtOnce_ * volume / smallVolume_, 0.5 * heavyWeight_ / weight)))
            : 1.0;
    for (std::size_t r = 0; r < rank_; ++r) {
      double* of = &out.values[groups * r];
      const double p = terms.p[r], q = terms.q[r];
      of[0] = p;
      of[1] = q;
      of[2] = p / out.bundle;
      of[3] = q / out.bundle;
      of[4] = out.isSmall ? 0.0 : weight * p;
      of[5] = out.isSmall ? 0.0 : weight * q;
      of[6] = out.isSmall ? weight * p : 0.0;
      of[7] = out.isSmall ? weight * q : 0.0;
    }
    for (std::size_t process = 0; process < singleProcesses; ++process)
      if (singleQuantity_[process] != unused)
        out.values[singleQuantity_[process]] = singleBound(rates_, static_cast<SingleProcess>(process), entry);
  }
  // `isSame`: nothing but the weight is another.
  void setBounds(std::size_t at, bool isSame) const {
    CollisionKernel::Terms terms;
    if (isSame) {
      for (std::size_t r = 0; r < rank_; ++r) {
        terms.p[r] = bounds_[groups * r][at];
        terms.q[r] = bounds_[groups * r + 1][at];
      }
    } else if (rank_ > 0) {
      terms = rates_.terms(entries_[at]);
    }
    Bounds found;
    boundsOf(at, terms, found);
    isSmall_[at] = found.isSmall ? 1 : 0;
    bundle_[at] = found.bundle;
    for (std::size_t k = 0; k < quantities_; ++k)
      if (found.values[k] != bounds_[k][at]) change(k, at, found.values[k]);
  }
  void countChange() {
    if (++changes_ > entries_.size() + leastChanges) sumUp();
  }
  // All bounds and sums anew, where they are not those of the entries.
  void measure() const {
    if (isMeasured_) return;
    isMeasured_ = true;
    sort();
    const std::size_t n = entries_.size();
    isSmall_.assign(n, 0);
    bundle_.assign(n, 1.0);
    findSmall();
    for (std::size_t k = 0; k < quantities_; ++k) {
      bounds_[k].resize(n);
      blocks_[k].resize((n + block - 1) / block);
    }
    Bounds found;
    for (std::size_t at = 0; at < n; ++at) {
      boundsOf(at, rank_ > 0 ? rates_.terms(entries_[at]) : CollisionKernel::Terms{}, found);
      isSmall_[at] = found.isSmall ? 1 : 0;
      bundle_[at] = found.bundle;
      for (std::size_t k = 0; k < quantities_; ++k) bounds_[k][at] = found.values[k];
    }
    sumUp();
  }
  // Of entries in order: the limits, of some that leave a tenth to six tenths of the number beyond, with which the
  // fewest events are to be expected where collision rates go with the square of the collector's diameter.
  void findSmall() const {
    smallVolume_ = heavyWeight_ = 0;
    if (!(shareAtOnce_ > 0)) return;
    const std::size_t n = entries_.size();
    work_.resize(3 * n);
    double *area = work_.data(), *volume = area + n, *perWeight = volume + n;
    double number = 0, all = 0, upTo = 0, squares = 0, least = worthwhile;
    for (std::size_t k = 0; k < n; ++k) {
      const double weight = rates_.weight(entries_[k]);
      volume[k] = rates_.volume(entries_[k]);
      perWeight[k] = 1 / weight;
      const double d = cubeRoot(volume[k]);
      area[k] = d * d;
      all += area[k];
      number += weight;
    }
    std::size_t at = 0;
    for (const double share : {0.4, 0.6, 0.75, 0.9}) {
      for (; at < n && upTo < share * number; ++at) {
        const double weight = rates_.weight(entries_[at]);
        upTo += weight;
        squares += weight * weight;
      }
      if (at == 0) return;
      const double small = volume[at - 1], heavy = heavyPart * squares / upTo;
      const double perSmall = shareAtOnce_ / small, half = 0.5 * heavy;
      double bundled = 0;
      for (std::size_t k = 0; k < n; ++k)
        bundled += area[k] / std::max(1.0, std::min(perSmall * volume[k], half * perWeight[k]));
      const double expected = 1 - upTo / number * (1 - bundled / all);
      if (!(expected < least)) continue;
      least = expected;
      smallVolume_ = small;
      heavyWeight_ = heavy;
    }
  }
  void sumUp() const {
    changes_ = 0;
    for (std::size_t k = 0; k < quantities_; ++k) {
      totals_[k] = 0;
      for (std::size_t b = 0; b < blocks_[k].size(); ++b) {
        double sum = 0;
        const std::size_t end = std::min((b + 1) * block, entries_.size());
        for (std::size_t at = b * block; at < end; ++at) sum += bounds_[k][at];
        blocks_[k][b] = sum;
        totals_[k] += sum;
      }
    }
  }
  // The entry in whose part of the sum `x` falls; behind the last for a rounding error.
  [[nodiscard]] std::size_t find(std::size_t quantity, double x) const {
    const std::vector<double>& sums = blocks_[quantity];
    std::size_t b = 0;
    for (; b < sums.size() && x >= sums[b]; ++b) x -= sums[b];
    if (b == sums.size()) return entries_.size();
    const double* bounds = bounds_[quantity].data();
    const std::size_t end = std::min((b + 1) * block, entries_.size());
    std::size_t at = b * block;
    for (; at < end && x >= bounds[at]; ++at) x -= bounds[at];
    return at < end ? at : entries_.size();
  }

  static constexpr std::size_t leastChanges = 64;

  Rates rates_;
  std::size_t rank_, quantities_ = 0;
  std::array<std::size_t, singleProcesses> singleQuantity_{};
  double shareAtOnce_ = 0, collected_ = 1;
  std::array<std::size_t, 2> hole_{};  // places whose entries are out
  std::size_t holes_ = 0;
  // Bounds are found when somebody asks: not each of many changes to all entries is followed by an event.
  mutable bool isMeasured_ = false;
  mutable std::vector<Entry> entries_;
  mutable std::size_t changes_ = 0;
  mutable std::array<std::vector<double>, mostQuantities> bounds_, blocks_;
  mutable std::array<double, mostQuantities> totals_{};
  mutable double smallVolume_ = 0, heavyWeight_ = 0;  // of small entries: the largest, and the least; 0: none are
  mutable std::vector<char> isSmall_;
  mutable std::vector<double> bundle_, work_;
};

template <SortedRates Rates>
template <class MeanOf>
std::size_t TwoLevelStore<Rates>::mergeDownTo(std::size_t count, MeanOf&& meanOf) {
  closeHoles();
  if (entries_.size() <= count || entries_.size() < 2) return 0;
  sort();
  // A list of neighbours; a pair in the queue is out of date where one of the two has changed since.
  constexpr std::uint32_t none = ~std::uint32_t{0};
  const auto n = static_cast<std::uint32_t>(entries_.size());
  std::vector<std::uint32_t> next(n), previous(n), version(n, 0);
  for (std::uint32_t k = 0; k < n; ++k) {
    previous[k] = k == 0 ? none : k - 1;
    next[k] = k + 1 == n ? none : k + 1;
  }
  struct Pair {
    double difference, weight;
    std::uint32_t lower, upper, lowerVersion, upperVersion;
    bool operator<(const Pair& other) const {  // the largest comes out first
      if (difference != other.difference) return difference > other.difference;
      if (weight != other.weight) return weight > other.weight;
      return lower > other.lower;
    }
  };
  std::vector<Pair> room;
  room.reserve(2 * n);
  std::priority_queue<Pair> pairs(std::less<Pair>(), std::move(room));
  const auto consider = [&](std::uint32_t lower, std::uint32_t upper) {
    if (lower == none || upper == none) return;
    const double v = rates_.volume(entries_[lower]), d = rates_.volume(entries_[upper]) - v;
    pairs.push({rates_.relativeDifference() ? d / v : d, rates_.weight(entries_[lower]), lower, upper, version[lower],
                version[upper]});
  };
  for (std::uint32_t k = 0; k + 1 < n; ++k) consider(k, k + 1);
  std::size_t left = n, merged = 0;
  std::vector<char> isGone(n, 0);
  while (left > std::max<std::size_t>(count, 1)) {
    const Pair pair = pairs.top();
    pairs.pop();
    if (isGone[pair.lower] != 0 || isGone[pair.upper] != 0 || version[pair.lower] != pair.lowerVersion ||
        version[pair.upper] != pair.upperVersion)
      continue;
    // The mean lies between the two, and so in their place among the others.
    entries_[pair.lower] = meanOf(entries_[pair.lower], entries_[pair.upper]);
    ++version[pair.lower];
    isGone[pair.upper] = 1;
    next[pair.lower] = next[pair.upper];
    if (next[pair.lower] != none) previous[next[pair.lower]] = pair.lower;
    consider(previous[pair.lower], pair.lower);
    consider(pair.lower, next[pair.lower]);
    --left;
    ++merged;
  }
  std::size_t kept = 0;
  for (std::uint32_t k = 0; k < n; ++k)
    if (isGone[k] == 0) {
      if (kept != k) entries_[kept] = entries_[k];
      ++kept;
    }
  entries_.erase(entries_.begin() + static_cast<std::ptrdiff_t>(kept), entries_.end());
  isMeasured_ = false;
  return merged;
}

}  // namespace lampblack::particles
