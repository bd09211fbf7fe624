// What the sorted store draws has the law that the rates say, bounds and trees notwithstanding.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <vector>

#include "tests/every_room.hpp"
#include "tests/particles/population/weighted/weighted_test_rates.hpp"

namespace lampblack::test {
namespace {

using Rates = WeightedTestRates<true>;
using Entry = Rates::Entry;

// 300 entries over two decades of volume and three of weight, in a store that has seen insertions and removals, so that
// bounds are neither fresh nor equal.
std::vector<Entry> populate(SortedStore<Rates>& store, RandomStream& random) {
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

TEST(SortedStoreDraws, PairsComeAtTheirRates) {
  for (const bool constantKernel : {true, false}) {
    Rates rates;
    rates.constantKernel = constantKernel;
    SortedStore<Rates> store(rates);
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

TEST(SortedStoreDraws, SinglesComeAtTheirRates) {
  SortedStore<Rates> store{Rates()};
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
    EXPECT_LT(std::abs(accepted - expected), 3.3 * std::sqrt(variance));
    expectFits(counts, probability, accepted);
  }
}

}  // namespace
}  // namespace lampblack::test
