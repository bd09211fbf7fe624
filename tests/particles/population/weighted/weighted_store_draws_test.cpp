// What the stores of weighted particles draw has the law that the rates say, bounds, trees and bundles notwithstanding.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "particles/population/monte_carlo/two_level_store.hpp"
#include "tests/every_module.hpp"
#include "tests/particles/population/weighted/weighted_test_rates.hpp"

namespace lampblack::test {
namespace {

using Rates = WeightedTestRates<true>;
using Entry = Rates::Entry;

// 300 entries over two decades of volume and three of weight, in a store that has seen insertions and removals, so that
// bounds are neither fresh nor equal.
template <class Store>
std::vector<Entry> populate(Store& store, RandomStream& random) {
  std::vector<Entry> entries;
  for (int k = 0; k < 300; ++k) {
    entries.push_back({{std::exp(4.6 * random.uniform())}, std::exp(6.9 * random.uniform())});
    store.insert(entries.back());
    store.insert({{std::exp(4.6 * random.uniform())}, 50});
  }
  std::vector<Entry> back;
  while (store.size() > 0) {
    const Entry e = store.takeUniform(random);
    if (e.weight != 50) back.push_back(e);
    if (back.size() == 10) {
      for (const Entry& b : back) store.insert(b);
      back.clear();
      if (store.size() == 300) break;
    }
  }
  return entries;
}

// With f degrees of freedom chi square has the variance 2f; above f + 4 sqrt(2f) it is less likely than 1e-4.
void expectFits(const std::vector<double>& counts, const std::vector<double>& probabilities, double total) {
  double chiSquare = 0, freedom = -1;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double expected = probabilities[k] * total;
    if (expected < 10) continue;
    chiSquare += (counts[k] - expected) * (counts[k] - expected) / expected;
    ++freedom;
  }
  EXPECT_GT(freedom, 10);
  EXPECT_LT(chiSquare, freedom + 4 * std::sqrt(2 * freedom));
}

std::size_t groupOf(const Entry& e) {
  const auto byVolume = static_cast<std::size_t>(std::log(e.particle.volume));               // 0 to 4
  const auto byWeight = static_cast<std::size_t>(std::log(std::max(e.weight, 1.0)) / 2.31);  // 0 to 2
  return 3 * byVolume + std::min<std::size_t>(byWeight, 2);
}

constexpr std::size_t groups = 15;
std::size_t cell(const Entry& i, const Entry& j) {
  const std::size_t a = groupOf(i), b = groupOf(j);
  return std::min(a, b) * groups + std::max(a, b);
}

template <class Store>
class WeightedStoreDraws : public testing::Test {};
using Stores = testing::Types<SortedStore<Rates>, TwoLevelStore<Rates>>;
TYPED_TEST_SUITE(WeightedStoreDraws, Stores);

TYPED_TEST(WeightedStoreDraws, PairsComeAtTheirRates) {
  for (const bool constantKernel : {true, false}) {
    Rates rates;
    rates.constantKernel = constantKernel;
    TypeParam store(rates);
    RandomStream random(11, 0, 0);
    const std::vector<Entry> entries = populate(store, random);
    ASSERT_EQ(store.size(), entries.size());
    std::vector<double> probability(groups * groups, 0.0), counts(groups * groups, 0.0);
    double sum = 0;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double rate = rates.pair(entries[i], entries[j]);
        probability[cell(entries[i], entries[j])] += rate;
        sum += rate;
      }
    }
    for (double& p : probability) p /= sum;
    constexpr int attempts = 200000;
    double accepted = 0, expected = 0, variance = 0;
    for (int k = 0; k < attempts; ++k) {
      const double chance = sum / store.pairRate();  // changes as bounds do
      ASSERT_LE(chance, 1 + 1e-12);
      expected += chance;
      variance += chance * (1 - chance);
      Entry i, j;
      if (!store.drawPair(random, i, j)) continue;
      ++accepted;
      counts[cell(i, j)] += 1;
      store.insert(i);
      store.insert(j);
    }
    EXPECT_LT(std::abs(accepted - expected), 3.3 * std::sqrt(variance));
    expectFits(counts, probability, accepted);
  }
}

TYPED_TEST(WeightedStoreDraws, SinglesComeAtTheirRates) {
  TypeParam store{Rates()};
  RandomStream random(12, 0, 0);
  const std::vector<Entry> entries = populate(store, random);
  for (const SingleProcess process : {SingleProcess::breakage, SingleProcess::deposition}) {
    std::map<double, std::size_t> index;
    std::vector<double> probability, counts(entries.size(), 0.0);
    double sum = 0;
    for (const Entry& e : entries) {
      index[e.particle.volume] = probability.size();
      probability.push_back(store.rates().single(process, e));
      sum += probability.back();
    }
    for (double& p : probability) p /= sum;
    double accepted = 0, expected = 0, variance = 0;
    for (int k = 0; k < 200000; ++k) {
      const double chance = sum / store.singleRate(process);
      expected += chance;
      variance += chance * (1 - chance);
      Entry e;
      if (!store.drawSingle(process, random, e)) continue;
      ++accepted;
      counts[index.at(e.particle.volume)] += 1;
      store.insert(e);
    }
    EXPECT_LE(std::abs(accepted - expected), 3.3 * std::sqrt(std::max(variance, 0.0)) + 1e-6);  // or all are
    expectFits(counts, probability, accepted);
  }
}

// Most of the number in a few small entries, among which large ones that stand for few move: bundles of meetings, whose
// sum comes at the rate of the pair.
class Bundles : public testing::TestWithParam<double> {};
// Bounded by the share of the volume, and by that of what the small ones stand for.
INSTANTIATE_TEST_SUITE_P(Shares, Bundles, testing::Values(0.1, 0.9));

TEST_P(Bundles, HaveTheRatesOfTheirMeetings) {
  const Rates rates;
  TwoLevelStore<Rates> store(rates);
  const double share = GetParam();
  store.setBundledGrowth(share);
  std::vector<Entry> entries;
  RandomStream random(13, 0, 0);
  for (int k = 20; k-- > 0;) entries.push_back({{1 + 0.05 * k}, 2000 + 100.0 * k});
  for (int k = 0; k < 60; ++k) entries.push_back({{std::exp(9 * random.uniform())}, std::exp(3 * random.uniform())});
  store.assign(entries);
  std::map<double, std::size_t> index;
  for (const Entry& e : entries) index.emplace(e.particle.volume, index.size());
  std::vector<double> taken(entries.size() * entries.size()), squares(taken.size()), expected(taken.size());
  constexpr int attempts = 400000;
  double bundled = 0, largest = 0;
  for (int k = 0; k < attempts; ++k) {
    Entry i, j;
    if (!store.drawPair(random, i, j)) continue;
    const double times = store.collected();
    const std::size_t a = index.at(i.particle.volume), b = index.at(j.particle.volume);
    const std::size_t pair = std::min(a, b) * entries.size() + std::max(a, b);
    taken[pair] += times;
    squares[pair] += times * times;
    if (times > 1) {
      EXPECT_LE(times * j.particle.volume, share * i.particle.volume * (1 + 1e-12));
      EXPECT_LE(times * i.weight, 0.5 * j.weight * (1 + 1e-12));
      ++bundled;
    }
    largest = std::max(largest, times);
    store.insert(j);
    store.insert(i);
  }
  EXPECT_GT(bundled, 1000);
  EXPECT_GT(largest, 50);
  double worst = 0;
  for (std::size_t a = 0; a < entries.size(); ++a)
    for (std::size_t b = a + 1; b < entries.size(); ++b) {
      const std::size_t i = index.at(entries[a].particle.volume), j = index.at(entries[b].particle.volume);
      const std::size_t pair = std::min(i, j) * entries.size() + std::max(i, j);
      const double mean = attempts * rates.pair(entries[a], entries[b]) / store.pairRate();
      if (squares[pair] < 30 * taken[pair] / std::max(1.0, mean)) continue;
      const double events = taken[pair] * taken[pair] / std::max(squares[pair], 1.0);
      if (events > 40) worst = std::max(worst, std::abs(taken[pair] - mean) / std::sqrt(squares[pair]));
    }
  EXPECT_LT(worst, 4.6);  // of some thousand pairs
}

// Whatever places the two of a pair have, the last ones too.
TEST(TwoLevelStore, KeepsWhatWasNotDrawn) {
  RandomStream random(15, 0, 0);
  for (int k = 0; k < 200; ++k) {
    TwoLevelStore<Rates> store{Rates()};
    for (const double v : {3.0, 1.0, 2.0}) store.insert({{v}, 1.0});
    Entry i, j;
    while (!store.drawPair(random, i, j)) {
    }
    ASSERT_EQ(store.size(), 1U);
    store.sort();
    store.forEach(
        [&](const Entry& left) { EXPECT_EQ(left.particle.volume, 6.0 - i.particle.volume - j.particle.volume); });
  }
}

TEST(TwoLevelStore, SettlesInOrderOfVolumeThenWeight) {
  TwoLevelStore<Rates> store{Rates()};
  for (const auto& [volume, weight] : {std::pair{3.0, 1.0}, {1.0, 5.0}, {2.0, 1.0}, {1.0, 4.0}})
    store.insert({{volume}, weight});
  store.sort();
  std::vector<std::pair<double, double>> found;
  store.forEach([&](const Entry& e) { found.emplace_back(e.particle.volume, e.weight); });
  EXPECT_EQ(found, (std::vector<std::pair<double, double>>{{1.0, 4.0}, {1.0, 5.0}, {2.0, 1.0}, {3.0, 1.0}}));
}

TEST(TwoLevelStore, MergesTheNearestNeighbours) {
  TwoLevelStore<Rates> many{Rates()}, one{Rates()};
  RandomStream random(14, 0, 0);
  for (int k = 0; k < 200; ++k) {
    const Entry e{{std::exp(4.6 * random.uniform())}, 1 + std::floor(5 * random.uniform())};
    many.insert(e);
    one.insert(e);
  }
  const auto mean = [](const Entry& a, const Entry& b) {
    const double w = a.weight + b.weight;
    return Entry{{(a.weight * a.particle.volume + b.weight * b.particle.volume) / w}, w};
  };
  EXPECT_EQ(many.mergeDownTo(120, mean), 80U);
  while (one.size() > 120) ASSERT_TRUE(one.mergeNearest(mean));
  std::vector<double> volumes;
  many.forEach([&](const Entry& e) { volumes.push_back(e.particle.volume); });
  EXPECT_TRUE(std::ranges::is_sorted(volumes));
  std::size_t k = 0;
  one.forEach([&](const Entry& e) { EXPECT_EQ(e.particle.volume, volumes.at(k++)); });
}

}  // namespace
}  // namespace lampblack::test
