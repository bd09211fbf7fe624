// Entries with the exact rates of all pairs by the plain bookkeeping of Wang (2025, eqs. 5-17, 5-18; Kruis, Maisels,
// Fissan 2000): each entry has a row, the sum of its rates with all others, and an entry that comes or goes costs one
// loop over the others. A pair is drawn by the inverse method, row then partner, so that no jump is fictitious. O(N) a
// change and independent of every majorant: the reference of the other stores, which have the same law.
//
// Entries are sorted by volume, then weight. Rows are changed by additions and subtractions, whose rounding errors
// would pile up: all rows are computed afresh after as many changes as there are entries, which doubles the cost at
// most and keeps the error of a row below N epsilon of the largest value it had in between. The total is summed from
// the rows whenever they changed, and a drawn row is summed afresh.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "particles/population/monte_carlo/store.hpp"

namespace lampblack::particles {

template <EntryRates Rates>
class ExactStore {
 public:
  using Entry = typename Rates::Entry;

  explicit ExactStore(Rates rates) : rates_(std::move(rates)) {}

  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = entries_.capacity() * sizeof(Entry) + rows_.capacity() * sizeof(double);
    for (const auto& single : singles_) sum += single.capacity() * sizeof(double);
    return sum;
  }
  [[nodiscard]] Rates& rates() { return rates_; }
  [[nodiscard]] const Rates& rates() const { return rates_; }

  void clear() {
    entries_.clear();
    for (auto& single : singles_) single.clear();
    outdated();
  }
  void insert(Entry entry) {
    const std::size_t at = insertionIndex(entry);
    if (rowsValid_) {
      double row = 0;
      for (std::size_t k = 0; k < size(); ++k) {
        const double rate = rates_.pair(entry, entries_[k]);
        rows_[k] += rate;
        row += rate;
      }
      rows_.insert(position(rows_, at), row);
      changed();
    }
    for (std::size_t process = 0; process < singleProcesses; ++process) {
      if (!active(process)) continue;
      singles_[process].insert(position(singles_[process], at),
                               rates_.single(static_cast<SingleProcess>(process), entry));
    }
    entries_.insert(position(entries_, at), std::move(entry));
  }

  [[nodiscard]] double pairRate() const {
    refresh();
    if (!total_) {
      double sum = 0;
      for (const double row : rows_) sum += row;
      total_ = std::max(0.5 * sum, 0.0);
    }
    return *total_;
  }
  template <class Left>
  bool drawPair(RandomStream& random, Entry& first, Entry& second, Left&& left) {
    if (!drawPair(random, first, second)) return false;
    const std::array<double, 2> weights = left(first, second);
    const auto putBack = [this](Entry entry, double weight) {
      entry.weight = weight;
      insert(std::move(entry));
    };
    if (weights[0] > 0) putBack(first, weights[0]);
    if (weights[1] > 0) putBack(second, weights[1]);
    return true;
  }
  bool drawPair(RandomStream& random, Entry& first, Entry& second) {
    if (!(pairRate() > 0)) return false;
    const auto i = drawFrom(rows_, random);
    // The row afresh, and where in it the second random number falls.
    std::vector<double>& rates = work_;
    rates.resize(size());
    for (std::size_t k = 0; k < size(); ++k) rates[k] = k == *i ? 0 : rates_.pair(entries_[*i], entries_[k]);
    const auto j = drawFrom(rates, random);
    if (!j) return false;  // a row that was nothing but rounding errors
    // The later one first: the place of the other does not change.
    Entry late = take(std::max(*i, *j)), early = take(std::min(*i, *j));
    first = std::move(*i < *j ? early : late);
    second = std::move(*i < *j ? late : early);
    return true;
  }

  [[nodiscard]] double singleRate(SingleProcess process) const {
    double sum = 0;
    for (const double rate : singles_[static_cast<std::size_t>(process)]) sum += rate;
    return sum;
  }
  bool drawSingle(SingleProcess process, RandomStream& random, Entry& entry) {
    const auto i = drawFrom(singles_[static_cast<std::size_t>(process)], random);
    if (!i) return false;
    entry = take(*i);
    return true;
  }
  [[nodiscard]] Entry takeUniform(RandomStream& random) { return take(static_cast<std::size_t>(random.below(size()))); }

  // Neighbours in the order of volumes, by looking at all of them; what each does is said in sorted_store.hpp.
  template <class MeanOf>
  bool mergeNearest(MeanOf&& meanOf) {
    if (size() < 2) return false;
    const auto difference = [&](std::size_t k) {
      const double v = rates_.volume(entries_[k]), d = rates_.volume(entries_[k + 1]) - v;
      return std::pair(rates_.relativeDifference() ? d / v : d, rates_.weight(entries_[k]));
    };
    std::size_t best = 0;
    for (std::size_t k = 1; k + 1 < size(); ++k) {
      if (difference(k) < difference(best)) best = k;
    }
    const Entry upper = take(best + 1), lower = take(best);
    insert(meanOf(lower, upper));
    return true;
  }
  [[nodiscard]] Entry takeNearest(const Entry& like) {
    const auto place = std::lower_bound(entries_.begin(), entries_.end(), like,
                                        [this](const Entry& a, const Entry& b) { return less(a, b); });
    const auto at = static_cast<std::size_t>(place - entries_.begin());
    if (at == size()) return take(at - 1);
    if (at == 0) return take(0);
    const double below = rates_.volume(like) - rates_.volume(entries_[at - 1]);
    const double above = rates_.volume(entries_[at]) - rates_.volume(like);
    return take(below < above ? at - 1 : at);
  }
  [[nodiscard]] Entry takeHeaviest() {
    std::size_t best = 0;
    for (std::size_t k = 1; k < size(); ++k) {
      if (rates_.weight(entries_[k]) > rates_.weight(entries_[best])) best = k;
    }
    return take(best);
  }

  template <class F>
  void forEach(F&& f) const {
    for (const Entry& entry : entries_) f(entry);
  }
  // All rates are computed afresh.
  template <class F>
  void transform(F&& f) {
    std::vector<Entry> before = std::move(entries_);
    entries_.clear();
    entries_.reserve(before.size());
    for (Entry& entry : before) {
      if (f(entry)) entries_.push_back(std::move(entry));
    }
    std::sort(entries_.begin(), entries_.end(), [this](const Entry& a, const Entry& b) { return less(a, b); });
    outdated();
    for (std::size_t process = 0; process < singleProcesses; ++process) {
      singles_[process].clear();
      if (!active(process)) continue;
      for (const Entry& entry : entries_) {
        singles_[process].push_back(rates_.single(static_cast<SingleProcess>(process), entry));
      }
    }
  }

 private:
  [[nodiscard]] bool less(const Entry& a, const Entry& b) const {
    const double va = rates_.volume(a), vb = rates_.volume(b);
    return va < vb || (va == vb && rates_.weight(a) < rates_.weight(b));
  }
  [[nodiscard]] std::size_t insertionIndex(const Entry& entry) const {
    const auto at = std::upper_bound(entries_.begin(), entries_.end(), entry,
                                     [this](const Entry& a, const Entry& b) { return less(a, b); });
    return static_cast<std::size_t>(at - entries_.begin());
  }
  [[nodiscard]] bool active(std::size_t process) const { return rates_.active(static_cast<SingleProcess>(process)); }
  template <class T>
  static auto position(std::vector<T>& values, std::size_t at) {
    return values.begin() + static_cast<std::ptrdiff_t>(at);
  }

  Entry take(std::size_t at) {
    Entry entry = std::move(entries_[at]);
    entries_.erase(position(entries_, at));
    if (rowsValid_) {
      rows_.erase(position(rows_, at));
      for (std::size_t k = 0; k < size(); ++k) rows_[k] -= rates_.pair(entry, entries_[k]);
      changed();
    }
    for (auto& single : singles_) {
      if (!single.empty()) single.erase(position(single, at));
    }
    return entry;
  }

  // An index in proportion to values, which rounding errors may leave below zero; nothing where none is positive.
  static std::optional<std::size_t> drawFrom(const std::vector<double>& values, RandomStream& random) {
    double sum = 0;
    for (const double value : values) sum += std::max(value, 0.0);
    if (!(sum > 0)) return std::nullopt;
    double rest = random.uniform() * sum;
    std::optional<std::size_t> last;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (!(values[k] > 0)) continue;
      last = k;
      if ((rest -= values[k]) < 0) break;
    }
    return last;
  }

  void changed() const {
    total_.reset();
    ++changes_;
  }
  void outdated() {
    rowsValid_ = false;
    total_.reset();
  }
  // Rows are kept from the first question on: without coagulation nobody asks.
  void refresh() const {
    if (rowsValid_ && changes_ <= std::max<std::size_t>(size(), leastChanges)) return;
    rows_.assign(size(), 0.0);
    for (std::size_t i = 0; i < size(); ++i) {
      for (std::size_t j = i + 1; j < size(); ++j) {
        const double rate = rates_.pair(entries_[i], entries_[j]);
        rows_[i] += rate;
        rows_[j] += rate;
      }
    }
    rowsValid_ = true;
    changes_ = 0;
    total_.reset();
  }

  static constexpr std::size_t leastChanges = 16;

  Rates rates_;
  std::vector<Entry> entries_;
  std::array<std::vector<double>, singleProcesses> singles_;
  std::vector<double> work_;
  mutable std::vector<double> rows_;
  mutable std::optional<double> total_;
  mutable bool rowsValid_ = false;
  mutable std::size_t changes_ = 0;
};

}  // namespace lampblack::particles
