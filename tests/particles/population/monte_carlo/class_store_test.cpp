#include "particles/population/monte_carlo/class_store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/modules.hpp"
#include "test_rates.hpp"

namespace lampblack::particles {
namespace {

using test::TestRates;
using Store = ClassStore<TestRates>;
static_assert(EntryStore<Store>);

constexpr double fiveSigma = 5;

// Standard score of a chi-square, by the cube root of Wilson and Hilferty (1931).
double chiSquareScore(double chiSquare, double freedom) {
  const double spread = 2 / (9 * freedom);
  return (std::cbrt(chiSquare / freedom) - (1 - spread)) / std::sqrt(spread);
}

std::vector<double> volumes(const Store& store) {
  std::vector<double> result;
  store.forEach([&](const TestRates::Entry& e) { result.push_back(e.volume); });
  std::sort(result.begin(), result.end());
  return result;
}

// Volumes over six decades, some in the same class and some equal.
std::vector<double> someVolumes(std::size_t count, RandomStream& random) {
  std::vector<double> result;
  for (std::size_t k = 0; k < count; ++k) result.push_back(std::pow(10.0, 6 * random.uniform() - 3));
  result.push_back(result[0] * 1.001);
  result.push_back(1);
  result.push_back(1.01);
  return result;
}

class ClassStoreOfRank : public testing::TestWithParam<std::size_t> {};

TEST_P(ClassStoreOfRank, DrawsPairsAtTheRatesOfTheKernel) {
  const TestRates rates{GetParam(), true};
  RandomStream random(5, 0, 1);
  Store store(rates);
  const std::vector<double> all = someVolumes(5, random);
  for (const double v : all) store.insert({v});
  std::map<std::pair<double, double>, double> expected, seen;
  double sum = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double rate = rates.pair({all[i]}, {all[j]});
      expected[std::minmax(all[i], all[j])] += rate;
      sum += rate;
    }
  }
  const double majorant = store.pairRate();
  EXPECT_GE(majorant, sum);
  constexpr int attempts = 400000;
  int accepted = 0;
  for (int k = 0; k < attempts; ++k) {
    TestRates::Entry i, j;
    if (!store.drawPair(random, i, j)) continue;
    ++accepted;
    seen[std::minmax(i.volume, j.volume)] += 1;
    ASSERT_EQ(store.size(), all.size() - 2);
    store.insert(i);
    store.insert(j);
  }
  // Every attempt happens at the majorant's rate, so that the accepted ones have the rate of the kernel.
  const double p = sum / majorant;
  EXPECT_LT(std::abs(accepted - attempts * p), fiveSigma * std::sqrt(attempts * p * (1 - p)));
  double chiSquare = 0, freedom = -1;
  for (const auto& [pair, rate] : expected) {
    const double mean = accepted * rate / sum;
    if (mean < 20) continue;  // too few for a chi-square
    chiSquare += std::pow(seen[pair] - mean, 2) / mean;
    ++freedom;
  }
  ASSERT_GT(freedom, 6);
  EXPECT_LT(chiSquareScore(chiSquare, freedom), fiveSigma);
}

TEST_P(ClassStoreOfRank, DrawsSingleParticlesAtTheirRates) {
  const TestRates rates{GetParam(), true};
  RandomStream random(6, 0, 1);
  Store store(rates);
  const std::vector<double> all = someVolumes(12, random);
  for (const double v : all) store.insert({v});
  for (const auto process : {SingleProcess::breakage, SingleProcess::deposition}) {
    double sum = 0, chiSquare = 0, freedom = -1;
    for (const double v : all) sum += rates.single(process, {v});
    EXPECT_GE(store.singleRate(process), sum * (1 - 1e-14));
    std::map<double, double> seen;
    int accepted = 0;
    constexpr int attempts = 200000;
    for (int k = 0; k < attempts; ++k) {
      TestRates::Entry e;
      if (!store.drawSingle(process, random, e)) continue;
      ++accepted;
      seen[e.volume] += 1;
      store.insert(e);
    }
    const double p = std::min(sum / store.singleRate(process), 1.0);
    // Where hardly any attempt fails their number is Poisson distributed: five more than the mean are unlikely enough.
    EXPECT_LE(std::abs(accepted - attempts * p), fiveSigma * std::sqrt(attempts * p * (1 - p)) + 5);
    for (const double v : all) {
      const double mean = accepted * rates.single(process, {v}) / sum;
      if (mean < 20) continue;
      chiSquare += std::pow(seen[v] - mean, 2) / mean;
      ++freedom;
    }
    EXPECT_LT(chiSquareScore(chiSquare, std::max(freedom, 1.0)), fiveSigma);
  }
  EXPECT_EQ(store.singleRate(SingleProcess::condensation), 0);
}

// 1e5 random operations against a plain list; the sums must bound the exact ones and stay within what a class's width
// in volume, 2^(1/4) at most 1.25, allows: factors of the majorant vary by at most 1.25^(2/3+1/2) in a class, and the
// breakage rate by 1.25^1.8.
TEST_P(ClassStoreOfRank, SumsDoNotDriftOverRandomOperations) {
  const TestRates rates{GetParam(), true};
  RandomStream random(7, GetParam(), 1);
  Store store(rates);
  std::vector<double> list;
  const auto drop = [&](double v) {
    const auto at = std::find(list.begin(), list.end(), v);
    ASSERT_NE(at, list.end());
    *at = list.back();
    list.pop_back();
  };
  const auto add = [&](double v) {
    store.insert({v});
    list.push_back(v);
  };
  for (int operation = 0; operation < 100000; ++operation) {
    TestRates::Entry i, j;
    const double u = random.uniform();
    if (list.size() < 3 || (u < 0.35 && list.size() < 300)) {
      add(std::pow(10.0, 6 * random.uniform() - 3));
    } else if (u < 0.6) {
      if (store.drawPair(random, i, j)) {
        drop(i.volume);
        drop(j.volume);
        add(i.volume + j.volume);
      }
    } else if (u < 0.8) {
      if (store.drawSingle(SingleProcess::breakage, random, i)) {
        drop(i.volume);
        store.insert({i.volume / 3}, 3);
        for (int k = 0; k < 3; ++k) list.push_back(i.volume / 3);
      }
    } else if (u < 0.9) {
      drop(store.takeUniform(random).volume);
    } else if (u < 0.999) {
      list.push_back(store.copyUniform(random).volume);
    } else if (list.size() < 300) {
      store.duplicate();
      list.insert(list.end(), list.begin(), list.end());
    } else {
      store.discardHalf(random);
      list = volumes(store);
    }
    ASSERT_EQ(store.size(), list.size());
    if (operation % 5000 != 4999) continue;
    std::sort(list.begin(), list.end());
    ASSERT_EQ(volumes(store), list);
    double sum = 0, breakage = 0;
    std::array<double, 3> p{}, q{};
    for (const double v : list) {
      for (std::size_t r = 0; r < rates.rank(); ++r) p[r] += rates.terms({v}).p[r], q[r] += rates.terms({v}).q[r];
      breakage += rates.single(SingleProcess::breakage, {v});
    }
    for (std::size_t r = 0; r < rates.rank(); ++r) sum += p[r] * q[r];
    EXPECT_GE(store.pairRate(), sum * (1 - 1e-13));
    EXPECT_LE(store.pairRate(), sum * std::pow(1.25, 7.0 / 6));
    EXPECT_GE(store.singleRate(SingleProcess::breakage), breakage * (1 - 1e-13));
    EXPECT_LE(store.singleRate(SingleProcess::breakage), breakage * std::pow(1.25, 1.8));
    EXPECT_NEAR(store.singleRate(SingleProcess::deposition), 3.0 * static_cast<double>(list.size()), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Ranks, ClassStoreOfRank, testing::Values(1, 2));

TEST(ClassStore, TakesUniformly) {
  RandomStream random(8, 0, 1);
  Store store(TestRates{2, true});
  const std::vector<double> all = someVolumes(12, random);
  for (const double v : all) store.insert({v});
  std::map<double, double> seen;
  constexpr int draws = 60000;
  for (int k = 0; k < draws; ++k) {
    const auto e = store.takeUniform(random);
    seen[e.volume] += 1;
    store.insert(e);
  }
  double chiSquare = 0;
  const double mean = draws / static_cast<double>(all.size());
  for (const double v : all) chiSquare += std::pow(seen[v] - mean, 2) / mean;
  EXPECT_LT(chiSquareScore(chiSquare, static_cast<double>(all.size()) - 1), fiveSigma);
}

TEST(ClassStore, DiscardingHalfGivesEverySubsetTheSameProbability) {
  RandomStream random(9, 0, 1);
  std::map<std::vector<double>, double> seen;
  constexpr int draws = 20000;
  for (int k = 0; k < draws; ++k) {
    Store store(TestRates{1, false});
    for (const double v : {1.0, 1.01, 1.02, 5.0, 6.5}) store.insert({v});
    store.discardHalf(random);
    ASSERT_EQ(store.size(), 2u);
    seen[volumes(store)] += 1;
  }
  ASSERT_EQ(seen.size(), 10u);  // 5 over 2
  double chiSquare = 0;
  for (const auto& [subset, count] : seen) chiSquare += std::pow(count - draws / 10.0, 2) / (draws / 10.0);
  EXPECT_LT(chiSquareScore(chiSquare, 9), fiveSigma);
}

TEST(ClassStore, TransformChangesAndDropsAndMakesBoundsAfresh) {
  RandomStream random(10, 0, 1);
  Store store(TestRates{1, true});
  for (int k = 1; k <= 100; ++k) store.insert({static_cast<double>(k)});
  store.transform([](TestRates::Entry& e) {
    e.volume *= 1e-3;
    return e.volume <= 0.05;
  });
  EXPECT_EQ(store.size(), 50u);
  EXPECT_NEAR(volumes(store).back(), 0.05, 1e-15);
  EXPECT_LE(store.pairRate(), 50 * 1.275 * 1.25);
  store.clear();
  EXPECT_EQ(store.size(), 0u);
  EXPECT_EQ(store.pairRate(), 0);
}

// Some entries stay in their class, some go to another one, there or not, and some are dropped: the others are as they
// were, bounds hold, and what is made afresh is as of a store into which the entries came in that order.
TEST_P(ClassStoreOfRank, ChangesSomeEntriesAndLeavesTheOthers) {
  RandomStream random(19, 0, 1);
  Store store(TestRates{GetParam(), true});
  for (const double v : someVolumes(400, random)) store.insert({v});
  for (int round = 0; round < 20; ++round) {
    std::vector<std::uint32_t> which;
    std::vector<double> expected;
    std::vector<double> after;
    std::uint32_t place = 0;
    store.forEach([&](const TestRates::Entry& e) {
      const double u = random.uniform();
      if (u < 0.4) {
        which.push_back(place);
        after.push_back(u < 0.02 ? -e.volume : e.volume * (u < 0.2 ? 1.0001 : u < 0.3 ? 1.7 : 0.5));
      } else {
        expected.push_back(e.volume);
      }
      ++place;
    });
    std::vector<int> seen(which.size(), 0);
    store.transformSome(which, [&](TestRates::Entry& e, std::size_t k) {
      ++seen[k];
      EXPECT_LT(std::abs(std::log(e.volume / std::abs(after[k]))), 0.7);  // the one that was meant
      if (after[k] < 0) return false;
      e.volume = after[k];
      return true;
    });
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(which.size()));
    for (const double v : after)
      if (v > 0) expected.push_back(v);
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(volumes(store), expected);
    ASSERT_EQ(store.size(), expected.size());
    std::vector<TestRates::Entry> entries;
    store.forEach([&](const TestRates::Entry& e) { entries.push_back(e); });
    Store other(TestRates{GetParam(), true});
    other.insertAll(entries.size(), [&](std::size_t k) { return entries[k]; });
    EXPECT_GE(store.pairRate(), other.pairRate() * (1 - 1e-12));
    EXPECT_LE(store.pairRate(), other.pairRate() * 1.4);
    TestRates::Entry i, j;
    for (int k = 0; k < 200; ++k)
      if (store.drawPair(random, i, j)) {  // of a bound that does not hold it would complain
        store.insert(i);
        store.insert(j);
      }
    entries.clear();
    store.forEach([&](const TestRates::Entry& e) { entries.push_back(e); });
    other.clear();
    other.insertAll(entries.size(), [&](std::size_t k) { return entries[k]; });
    store.refresh();
    EXPECT_EQ(store.pairRate(), other.pairRate());
    EXPECT_EQ(store.classes(), other.classes());
    for (const auto process : {SingleProcess::breakage, SingleProcess::deposition})
      EXPECT_EQ(store.singleRate(process), other.singleRate(process));
    RandomStream one(23, 0, 1), two(23, 0, 1);
    for (int k = 0; k < 50; ++k) {
      TestRates::Entry a, b, c, d;
      ASSERT_EQ(store.drawPair(one, a, b), other.drawPair(two, c, d));
      ASSERT_EQ(a.volume, c.volume);
      ASSERT_EQ(b.volume, d.volume);
    }
  }
}

// Bounds of other rates than before.
TEST(ClassStore, IsRefreshedForOtherRates) {
  RandomStream random(29, 0, 1);
  Store store(TestRates{2, false}), other(TestRates{2, false});
  for (const double v : someVolumes(100, random)) store.insert({v});
  store.rates().scale = other.rates().scale = 3;
  store.refresh();
  std::vector<TestRates::Entry> entries;
  store.forEach([&](const TestRates::Entry& e) { entries.push_back(e); });
  other.insertAll(entries.size(), [&](std::size_t k) { return entries[k]; });
  EXPECT_EQ(store.pairRate(), other.pairRate());
  store.rates().scale = other.rates().scale = 1;  // smaller ones, too
  store.refresh();
  other.refresh();
  EXPECT_EQ(store.pairRate(), other.pairRate());
}

// Coalescing 64:1 leaves classes behind; a sphere may take at most 64 bytes.
TEST(ClassStore, MemoryFollowsTheNumberOfEntries) {
  RandomStream random(11, 0, 1);
  Store store(TestRates{2, true});
  constexpr std::size_t full = 20000;
  for (std::size_t k = 0; k < full; ++k) store.insert({1});
  std::size_t most = 0;
  for (int doubling = 0; doubling < 6; ++doubling) {
    store.duplicate();
    while (store.size() > full) {
      TestRates::Entry i, j;
      if (store.drawPair(random, i, j)) store.insert({i.volume + j.volume});
    }
    most = std::max(most, store.bytes());
  }
  EXPECT_LT(static_cast<double>(most) / full, 48);
}

}  // namespace
}  // namespace lampblack::particles
