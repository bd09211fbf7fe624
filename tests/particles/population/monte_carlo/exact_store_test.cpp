#include "particles/population/monte_carlo/exact_store.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::particles {
namespace {

// A kernel without any symmetry to speak of, and weights: pair rates span orders of magnitude.
struct TestRates {
  struct Entry {
    double volume = 0, weight = 1;
  };
  static constexpr bool weighted = true;
  [[nodiscard]] double volume(const Entry& e) const { return e.volume; }
  [[nodiscard]] double weight(const Entry& e) const { return e.weight; }
  [[nodiscard]] std::size_t rank() const { return 1; }
  [[nodiscard]] CollisionKernel::Terms terms(const Entry&) const { return {}; }  // an exact store asks for none
  [[nodiscard]] double weightFactor() const { return 1; }
  [[nodiscard]] double pair(const Entry& a, const Entry& b) const {
    return std::max(a.weight, b.weight) * std::pow(std::cbrt(a.volume) + std::cbrt(b.volume), 3);
  }
  [[nodiscard]] double single(SingleProcess process, const Entry& e) const {
    return process == SingleProcess::breakage ? e.volume * e.volume : 0;
  }
  [[nodiscard]] bool active(SingleProcess process) const { return process == SingleProcess::breakage; }
};

using Store = ExactStore<TestRates>;
static_assert(EntryStore<Store>);

std::vector<TestRates::Entry> entriesOf(const Store& store) {
  std::vector<TestRates::Entry> entries;
  store.forEach([&](const TestRates::Entry& e) { entries.push_back(e); });
  return entries;
}

double enumeratedPairRate(const Store& store) {
  const auto entries = entriesOf(store);
  double sum = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    for (std::size_t j = i + 1; j < entries.size(); ++j) sum += store.rates().pair(entries[i], entries[j]);
  }
  return sum;
}

Store storeOf(std::size_t count, RandomStream& random) {
  Store store{TestRates{}};
  for (std::size_t k = 0; k < count; ++k) store.insert({std::exp(6 * random.uniform()), 1 + random.uniform()});
  return store;
}

TEST(ExactStore, KeepsTheTotalOfAllPairsThroughManyChanges) {
  RandomStream random(1, 2, 3);
  Store store = storeOf(60, random);
  for (int event = 0; event < 3000; ++event) {
    TestRates::Entry a, b;
    ASSERT_TRUE(store.drawPair(random, a, b));
    store.insert({a.volume + b.volume, a.weight});
    store.insert({std::exp(6 * random.uniform()), b.weight});
    if (event % 7 == 0) {
      ASSERT_TRUE(store.drawSingle(SingleProcess::breakage, random, a));
      store.insert({0.5 * a.volume, a.weight});
    }
    if (event % 11 == 0) store.insert(store.takeUniform(random));
    if (event % 1000 == 999) {
      store.transform([](TestRates::Entry& e) {
        e.volume *= 0.5;
        return e.volume > 1;
      });
    }
    ASSERT_NEAR(store.pairRate() / enumeratedPairRate(store), 1, 1e-12);
  }
}

TEST(ExactStore, ForgetsTheLargestRateWithinAsManyChangesAsEntries) {
  // A giant leaves rounding errors of the size of its own rates behind, until the rows are computed afresh.
  RandomStream random(1, 2, 3);
  Store store = storeOf(40, random);
  store.insert({1e16, 1});
  EXPECT_GT(store.pairRate(), 1e17);
  TestRates::Entry giant;
  while (giant.volume < 1e15) {
    ASSERT_TRUE(store.drawSingle(SingleProcess::breakage, random, giant));
  }
  for (int k = 0; k < 30; ++k) {
    (void)store.pairRate();
    store.insert(store.takeUniform(random));
  }
  EXPECT_NEAR(store.pairRate() / enumeratedPairRate(store), 1, 1e-12);
}

TEST(ExactStore, DrawsPairsInProportionToTheirRates) {
  RandomStream random(4, 5, 6);
  const std::vector<double> volumes = {1, 1.5, 4, 30, 200};
  Store store{TestRates{}};
  for (const double v : volumes) store.insert({v, 1 / v});
  const double total = store.pairRate();
  std::map<std::pair<double, double>, int> count;
  const int draws = 40000;
  for (int k = 0; k < draws; ++k) {
    TestRates::Entry a, b;
    ASSERT_TRUE(store.drawPair(random, a, b));
    ++count[std::minmax(a.volume, b.volume)];
    store.insert(a);
    store.insert(b);
  }
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    for (std::size_t j = i + 1; j < volumes.size(); ++j) {
      const double p = TestRates{}.pair({volumes[i], 1 / volumes[i]}, {volumes[j], 1 / volumes[j]}) / total;
      const double z = (count[{volumes[i], volumes[j]}] - draws * p) / std::sqrt(draws * p * (1 - p));
      EXPECT_LT(std::abs(z), 3.5) << volumes[i] << " " << volumes[j];
    }
  }
}

TEST(ExactStore, DrawsOneInProportionToItsRate) {
  RandomStream random(7, 8, 9);
  Store store{TestRates{}};
  for (const double v : {1.0, 2.0, 3.0}) store.insert({v, 1});
  EXPECT_DOUBLE_EQ(store.singleRate(SingleProcess::breakage), 14);
  EXPECT_EQ(store.singleRate(SingleProcess::deposition), 0);
  std::array<int, 4> count{};
  const int draws = 20000;
  for (int k = 0; k < draws; ++k) {
    TestRates::Entry e;
    ASSERT_TRUE(store.drawSingle(SingleProcess::breakage, random, e));
    ++count[static_cast<std::size_t>(e.volume)];
    store.insert(e);
  }
  for (std::size_t v = 1; v <= 3; ++v) {
    const double p = static_cast<double>(v * v) / 14;
    EXPECT_LT(std::abs(count[v] - draws * p) / std::sqrt(draws * p * (1 - p)), 3.5);
  }
}

TEST(ExactStore, IsSortedByVolumeThenWeight) {
  RandomStream random(1, 1, 1);
  Store store{TestRates{}};
  for (int k = 0; k < 200; ++k) {
    store.insert({static_cast<double>(random.below(8) + 1), static_cast<double>(random.below(4) + 1)});
  }
  const auto entries = entriesOf(store);
  for (std::size_t k = 1; k < entries.size(); ++k) {
    EXPECT_LE(std::pair(entries[k - 1].volume, entries[k - 1].weight), std::pair(entries[k].volume, entries[k].weight));
  }
}

TEST(ExactStore, HasNoPairInAPopulationOfOne) {
  RandomStream random(1, 1, 1);
  Store store{TestRates{}};
  EXPECT_EQ(store.pairRate(), 0);
  store.insert({2, 3});
  EXPECT_EQ(store.pairRate(), 0);
  TestRates::Entry a, b;
  EXPECT_FALSE(store.drawPair(random, a, b));
  EXPECT_EQ(store.size(), 1u);
}

}  // namespace
}  // namespace lampblack::particles
