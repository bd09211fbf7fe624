// Structure of the sorted store against a plain sorted list that is searched from end to end.
#include <gtest/gtest.h>

#include <tuple>
#include <vector>

#include "tests/every_module.hpp"
#include "tests/particles/population/weighted/weighted_test_rates.hpp"

namespace lampblack::test {
namespace {

// The same operations by brute force.
template <class Rates>
class PlainList {
 public:
  using Entry = typename Rates::Entry;
  explicit PlainList(Rates rates) : rates_(rates) {}

  static bool less(const Entry& a, const Entry& b) {
    return std::tuple(a.particle.volume, a.weight) < std::tuple(b.particle.volume, b.weight);
  }
  void insert(const Entry& e) { entries_.insert(std::upper_bound(entries_.begin(), entries_.end(), e, less), e); }
  void remove(const Entry& e) {
    auto at = std::lower_bound(entries_.begin(), entries_.end(), e, less);
    ASSERT_TRUE(at != entries_.end() && !less(e, *at)) << "not there: " << e.particle.volume << ", " << e.weight;
    if constexpr (!Rates::bare) {
      while (at != entries_.end() && at->particle.tag != e.particle.tag && !less(e, *at)) ++at;
      ASSERT_TRUE(at != entries_.end() && at->particle.tag == e.particle.tag);
    }
    entries_.erase(at);
  }
  // The smallest difference and, among equal ones, the smallest weight of the lower one.
  [[nodiscard]] std::pair<double, double> least() const {
    std::pair<double, double> best{1e300, 1e300};
    for (std::size_t k = 0; k + 1 < entries_.size(); ++k) best = std::min(best, key(entries_[k], entries_[k + 1]));
    return best;
  }
  [[nodiscard]] std::pair<double, double> key(const Entry& a, const Entry& b) const {
    const double d = b.particle.volume - a.particle.volume;
    return {rates_.relative ? d / a.particle.volume : d, a.weight};
  }
  // What sums of the rates are, of all pairs.
  [[nodiscard]] double pairs() const {
    double sum = 0;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) sum += rates_.pair(entries_[i], entries_[j]);
    }
    return sum;
  }
  [[nodiscard]] double singles(SingleProcess process) const {
    double sum = 0;
    for (const Entry& e : entries_) sum += rates_.single(process, e);
    return sum;
  }
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }

 private:
  Rates rates_;
  std::vector<Entry> entries_;
};

template <class Rates>
void compare(const SortedStore<Rates>& store, const PlainList<Rates>& list) {
  ASSERT_EQ(store.size(), list.entries().size());
  std::size_t k = 0;
  bool equal = true;
  store.forEach([&](const auto& e) {
    const auto& other = list.entries()[k++];
    equal = equal && e.particle.volume == other.particle.volume && e.weight == other.weight;
  });
  ASSERT_TRUE(equal) << "order or entries differ";
  // Bounds of sums: that they are bounds is what has to hold; the factors say that they are not idle once there are
  // several chunks.
  const double pairs = list.pairs();
  EXPECT_GE(store.pairRate(), pairs * (1 - 1e-12));
  const bool several = list.entries().size() > 200;
  if (several) {
    EXPECT_LE(store.pairRate(), 20 * pairs);
  }
  for (const SingleProcess process : {SingleProcess::breakage, SingleProcess::deposition}) {
    EXPECT_GE(store.singleRate(process), list.singles(process) * (1 - 1e-12));
    if (several) {
      EXPECT_LE(store.singleRate(process), 4 * list.singles(process));
    }
  }
}

// 1e5 random operations on a number of entries that rises and falls between about 0 and 700, so that chunks split and
// join; half of the volumes are small integers, so that equal volumes and differences abound.
template <bool plain>
void randomOperations(bool relative, std::uint64_t seed) {
  using Rates = WeightedTestRates<plain>;
  using Entry = typename Rates::Entry;
  Rates rates;
  rates.relative = relative;
  SortedStore<Rates> store(rates);
  PlainList<Rates> list(rates);
  RandomStream random(seed, 0, 0);
  int tag = 0;
  const auto fresh = [&] {
    Entry e;
    e.particle.volume = random.uniform() < 0.5 ? 1.0 + static_cast<double>(random.below(40)) : 50 * random.uniform();
    e.weight = random.uniform() < 0.3 ? 1 : std::exp(20 * random.uniform() - 10);
    if constexpr (!plain) e.particle.tag = ++tag;
    return e;
  };
  for (int step = 0; step < 100000; ++step) {
    const bool rising = (step / 1500) % 2 == 0;
    const double choice = random.uniform();
    if (list.entries().empty() || choice < (rising ? 0.7 : 0.25)) {
      const Entry e = fresh();
      store.insert(e);
      list.insert(e);
    } else if (choice < 0.80) {
      list.remove(store.takeUniform(random));
    } else if (choice < 0.88) {
      const auto expected = list.least();
      Entry lower, upper, mean;
      const bool merged = store.mergeNearest([&](const Entry& a, const Entry& b) {
        lower = a;
        upper = b;
        mean = a;
        mean.weight = a.weight + b.weight;
        if (a.particle.volume != b.particle.volume) {
          mean.particle.volume = (a.weight * a.particle.volume + b.weight * b.particle.volume) / mean.weight;
        }
        return mean;
      });
      ASSERT_EQ(merged, list.entries().size() >= 2);
      if (merged) {
        ASSERT_EQ(list.key(lower, upper), expected) << "step " << step;
        list.remove(lower);
        list.remove(upper);
        list.insert(mean);
      }
    } else if (choice < 0.92) {
      double heaviest = 0;
      for (const Entry& e : list.entries()) heaviest = std::max(heaviest, e.weight);
      const Entry e = store.takeHeaviest();
      ASSERT_EQ(e.weight, heaviest);
      list.remove(e);
    } else if (choice < 0.95) {
      const Entry like = fresh();
      double nearest = 1e300;
      for (const Entry& e : list.entries()) {
        nearest = std::min(nearest, std::abs(e.particle.volume - like.particle.volume));
      }
      const Entry e = store.takeNearest(like);
      ASSERT_EQ(std::abs(e.particle.volume - like.particle.volume), nearest);
      list.remove(e);
    } else if (choice < 0.98) {
      // As a coagulation leaves them: one of them taken out, with the same weight, or with less; and a new one.
      std::array<double, 2> left{};
      Entry i, j;
      const bool drawn = store.drawPair(random, i, j, [&](const Entry& a, const Entry& b) {
        for (double* part : {&left[0], &left[1]}) *part = 0.5 * static_cast<double>(random.below(3));
        left[0] *= a.weight;
        left[1] *= b.weight;
        return left;
      });
      if (drawn) {
        Entry sum = j;
        sum.particle.volume += i.particle.volume;
        store.expect(sum);
        list.remove(i);
        list.remove(j);
        i.weight = left[0];
        j.weight = left[1];
        for (const Entry& e : {i, j}) {
          if (e.weight > 0) list.insert(e);
        }
        if (random.below(2) == 0) {
          store.insert(sum);
          list.insert(sum);
        }
      }
    } else {
      Entry e;
      const auto process = random.uniform() < 0.5 ? SingleProcess::breakage : SingleProcess::deposition;
      if (store.drawSingle(process, random, e)) list.remove(e);
    }
    if (::testing::Test::HasFatalFailure()) return;
    if (step % 997 == 0) compare(store, list);
    if (::testing::Test::HasFailure()) return;
  }
  compare(store, list);
  // All at once, with a change of order: volumes around 25 fold over.
  std::vector<Entry> before = list.entries();
  for (const Entry& e : before) list.remove(e);
  const auto fold = [](Entry& e) {
    e.particle.volume = 0.5 + std::abs(e.particle.volume - 25);
    return e.particle.volume < 20;
  };
  for (Entry& e : before) {
    if (fold(e)) list.insert(e);
  }
  store.transform(fold);
  compare(store, list);
  // Two tags of the same volume and weight may change places.
  EXPECT_LE(store.bytes() / std::max<std::size_t>(store.size(), 1), 400u);
}

TEST(SortedStore, MatchesAPlainListAfterRandomOperations) {
  randomOperations<true>(true, 1);
  randomOperations<true>(false, 2);
}

TEST(SortedStore, CarriesWhateverAParticleIs) {
  randomOperations<false>(true, 3);
}

TEST(SortedStore, TakesTheNeighbourOfWang2025) {
  using Rates = WeightedTestRates<true>;
  SortedStore<Rates> store{Rates()};
  for (const double v : {1.0, 3.0, 4.0}) store.insert({{v}, 1});
  EXPECT_EQ(store.takeNearest({{2}, 1}).particle.volume, 3);  // both as near: the upper one (eq. 4-16)
  EXPECT_EQ(store.takeNearest({{2}, 1}).particle.volume, 1);
  EXPECT_EQ(store.takeNearest({{2}, 1}).particle.volume, 4);
  EXPECT_EQ(store.size(), 0u);
}

TEST(SortedStore, NeedsAtMost64BytesAParticle) {
  using Rates = WeightedTestRates<true>;
  SortedStore<Rates> store{Rates()};
  RandomStream random(5, 0, 0);
  constexpr std::size_t count = 20000;
  std::vector<Rates::Entry> entries;
  for (std::size_t k = 0; k < count; ++k) entries.push_back({{1 + random.uniform()}, 1});
  store.assign(entries);
  // As many again come and go: chunks split and join.
  for (std::size_t k = 0; k < 4 * count; ++k) {
    (void)store.takeUniform(random);
    store.insert({{1 + random.uniform()}, 1});
  }
  EXPECT_LE(store.bytes(), 64 * count);
}

// Pairs from few volumes in one chunk: what is left of one moves among its like, and the other is still found.
TEST(SortedStore, LeavesThePartnerOfThePairThatWasDrawn) {
  using Rates = WeightedTestRates<true>;
  SortedStore<Rates> store{Rates()};
  PlainList<Rates> list{Rates()};
  RandomStream random(31, 0, 0);
  for (int step = 0; step < 20000; ++step) {
    while (list.entries().size() < 40) {
      const Rates::Entry e{{1.0 + static_cast<double>(random.below(3))}, std::exp(4 * random.uniform())};
      store.insert(e);
      list.insert(e);
    }
    Rates::Entry i, j;
    const bool second = random.below(2) == 0;
    const double part = random.uniform();
    const auto left = [&](const Rates::Entry& a, const Rates::Entry& b) {
      return second ? std::array{part * a.weight, 0.0} : std::array{0.0, part * b.weight};
    };
    if (!store.drawPair(random, i, j, left)) continue;
    list.remove(i);
    list.remove(j);
    Rates::Entry rest = second ? i : j;
    rest.weight *= part;
    list.insert(rest);
    ASSERT_NO_FATAL_FAILURE(compare(store, list)) << step;
  }
}

}  // namespace
}  // namespace lampblack::test
