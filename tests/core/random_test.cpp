// Random streams: the published Philox words, restart, and the statistics a Monte Carlo method leans on. Seeds are
// fixed, so every test either always passes or always fails; the bounds are those a sound generator exceeds with a
// probability below 1e-6 a test.
#include "core/random.hpp"

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/modules.hpp"

namespace lampblack {
namespace {

constexpr std::size_t sampleSize = 200000;
constexpr double fiveSigma = 5.0;  // two-sided probability 5.7e-7
const std::vector<std::uint64_t> seeds{0, 1, 2, 42, 0xdeadbeefcafef00dULL};

std::vector<double> draw(RandomStream stream, std::size_t count = sampleSize) {
  std::vector<double> values(count);
  for (double& v : values) v = stream.uniform();
  return values;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

// Standard score of the correlation of two uniform samples: products of independent deviations have mean 0 and variance
// (1/12)^2.
double correlationScore(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - 0.5) * (b[i] - 0.5);
  return sum * 12.0 / std::sqrt(static_cast<double>(a.size()));
}

// Standard score of a chi-square with `bins` equally likely bins, by the cube root of Wilson and Hilferty (1931).
double chiSquareScore(const std::vector<std::size_t>& count) {
  double total = 0.0;
  for (std::size_t c : count) total += static_cast<double>(c);
  const double expected = total / static_cast<double>(count.size());
  double chiSquare = 0.0;
  for (std::size_t c : count) chiSquare += std::pow(static_cast<double>(c) - expected, 2) / expected;
  const double freedom = static_cast<double>(count.size() - 1);
  const double spread = 2.0 / (9.0 * freedom);
  return (std::cbrt(chiSquare / freedom) - (1.0 - spread)) / std::sqrt(spread);
}

TEST(RandomStream, WordsArePublishedPhilox4x32Of10Rounds) {
  // Known answer of counter 0, key 0 (kat_vectors of Random123: 6627e8d5 e169c58d bc57ac4c 9b00dbd8).
  RandomStream stream(0, 0, 0);
  const std::uint64_t half = std::uint64_t{1} << 63;  // below(2^63) is the word without its last bit
  EXPECT_EQ(stream.below(half), 0xe169c58d6627e8d5ULL >> 1);
  EXPECT_EQ(stream.below(half), 0x9b00dbd8bc57ac4cULL >> 1);
}

TEST(RandomStream, WordsAreThoseOfRandom123BlockByBlock) {
  const std::uint64_t seed = 0x0123456789abcdefULL, owner = 0xfedcba9876543210ULL;
  const std::uint32_t purpose = 0xa5a5a5a5;
  RandomStream stream(seed, owner, purpose);
  // From the start, across the block at which half of the counter's first word is used up, and across those at which
  // all of it is, where the key changes.
  for (const std::uint64_t start :
       {std::uint64_t{0}, (std::uint64_t{1} << 32) - 5, (std::uint64_t{1} << 33) - 32, (std::uint64_t{3} << 33) - 7}) {
    stream.seek(start);
    for (std::uint64_t position = start; position < start + 64; ++position) {
      const r123::Philox4x32::ctr_type counter{{static_cast<std::uint32_t>(position / 2),
                                                static_cast<std::uint32_t>(owner),
                                                static_cast<std::uint32_t>(owner >> 32), purpose}};
      const auto round = static_cast<std::uint32_t>(position >> 33);
      const auto words = r123::Philox4x32{}(
          counter, {{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32) ^ (round << 16)}});
      const std::size_t k = 2 * (position % 2);
      ASSERT_EQ(stream.bits(), words[k] | (static_cast<std::uint64_t>(words[k + 1]) << 32)) << position;
    }
  }
}

TEST(RandomStream, UnitIntervalIsOpenAtBothEnds) {
  EXPECT_GT(openUnitInterval(0), 0.0);
  EXPECT_LT(openUnitInterval(~std::uint64_t{0}), 1.0);
  EXPECT_TRUE(std::isfinite(std::log(openUnitInterval(0))));
  EXPECT_LT(std::log(openUnitInterval(~std::uint64_t{0})), 0.0);
  // The middles of the steps are symmetric about 1/2, to the last bit.
  EXPECT_EQ(openUnitInterval(0), 1.0 - openUnitInterval(~std::uint64_t{0}));
}

TEST(RandomStream, UniformDrawsStayInsideTheOpenInterval) {
  for (double u : draw({7, 3, 1})) {
    ASSERT_GT(u, 0.0);
    ASSERT_LT(u, 1.0);
  }
}

TEST(RandomStream, SameKeyGivesSameNumbers) {
  EXPECT_EQ(draw({5, 6, 7}, 100), draw({5, 6, 7}, 100));
}

TEST(RandomStream, SeekRestoresTheStreamAtAnyPosition) {
  const auto reference = draw({11, 12, 13}, 64);
  for (std::uint64_t position = 0; position < 64; ++position) {
    RandomStream restored(11, 12, 13);
    restored.seek(position);
    EXPECT_EQ(restored.position(), position);
    for (std::size_t i = position; i < reference.size(); ++i) ASSERT_EQ(restored.uniform(), reference[i]);
    EXPECT_EQ(restored.position(), reference.size());
  }
}

TEST(RandomStream, SeekBackwardsRepeatsTheNumbers) {
  RandomStream stream(1, 2, 3);
  for (int i = 0; i < 9; ++i) stream.uniform();
  const auto saved = stream.position();
  const double next = stream.uniform();
  const double afterNext = stream.uniform();
  stream.seek(saved);
  EXPECT_EQ(stream.uniform(), next);
  EXPECT_EQ(stream.uniform(), afterNext);
}

TEST(RandomStream, EveryKindOfDrawAdvancesByOneWord) {
  RandomStream stream(1, 2, 3);
  stream.uniform();
  EXPECT_EQ(stream.position(), 1u);
  stream.exponential(2.0);
  EXPECT_EQ(stream.position(), 2u);
  stream.below(10);
  EXPECT_EQ(stream.position(), 3u);
}

TEST(RandomStream, UniformHasMeanAndVarianceOfTheUniformDistribution) {
  const double n = static_cast<double>(sampleSize);
  for (std::uint64_t seed : seeds) {
    const auto u = draw({seed, 17, 1});
    EXPECT_LT(std::abs(mean(u) - 0.5) * std::sqrt(12.0 * n), fiveSigma) << "seed " << seed;
    // About the exact mean, (u - 1/2)^2 has mean 1/12 and variance 1/80 - 1/144 = 1/180.
    double variance = 0.0;
    for (double v : u) variance += (v - 0.5) * (v - 0.5) / n;
    EXPECT_LT(std::abs(variance - 1.0 / 12.0) * std::sqrt(180.0 * n), fiveSigma) << "seed " << seed;
  }
}

TEST(RandomStream, UniformFillsEqualBinsEqually) {
  for (std::uint64_t seed : seeds) {
    std::vector<std::size_t> count(256, 0);
    for (double u : draw({seed, 3, 2})) ++count[static_cast<std::size_t>(u * 256.0)];
    EXPECT_LT(std::abs(chiSquareScore(count)), fiveSigma) << "seed " << seed;
  }
}

TEST(RandomStream, SuccessivePairsFillThePlane) {
  std::vector<std::size_t> count(16 * 16, 0);
  const auto u = draw({99, 0, 0});
  for (std::size_t i = 0; i + 1 < u.size(); i += 2)
    ++count[static_cast<std::size_t>(u[i] * 16.0) * 16 + static_cast<std::size_t>(u[i + 1] * 16.0)];
  EXPECT_LT(std::abs(chiSquareScore(count)), fiveSigma);
}

TEST(RandomStream, StreamsThatDifferInOneKeyAreIndependent) {
  const std::uint64_t high = std::uint64_t{1} << 32;
  const auto base = draw({10, 20, 30});
  const std::vector<RandomStream> others{{11, 20, 30},        {10, 21, 30},        {10, 20, 31},
                                         {10 + high, 20, 30}, {10, 20 + high, 30}, {20, 10, 30}};
  for (std::size_t k = 0; k < others.size(); ++k) {
    const auto other = draw(others[k]);
    EXPECT_NE(base, other) << "stream " << k;
    EXPECT_LT(std::abs(correlationScore(base, other)), fiveSigma) << "stream " << k;
  }
}

TEST(RandomStream, FirstDrawsOfNeighbouringOwnersAreUniformAndUncorrelated) {
  // What a mesh does: one stream a cell, few draws from each.
  std::vector<double> first;
  std::vector<double> shifted;
  std::vector<std::size_t> count(64, 0);
  for (std::uint64_t cell = 0; cell <= sampleSize; ++cell) {
    const double u = RandomStream(3, cell, 1).uniform();
    if (cell < sampleSize) first.push_back(u);
    if (cell > 0) shifted.push_back(u);
    ++count[static_cast<std::size_t>(u * 64.0)];
  }
  EXPECT_LT(std::abs(correlationScore(first, shifted)), fiveSigma);
  EXPECT_LT(std::abs(chiSquareScore(count)), fiveSigma);
}

TEST(RandomStream, ExponentialHasItsMeanAndVariance) {
  const double rate = 250.0;
  const double n = static_cast<double>(sampleSize);
  for (std::uint64_t seed : seeds) {
    RandomStream stream(seed, 5, 9);
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < sampleSize; ++i) {
      const double t = stream.exponential(rate) * rate;
      ASSERT_GT(t, 0.0);
      sum += t;
      squares += (t - 1.0) * (t - 1.0);
    }
    // In units of 1/rate: mean 1, variance 1; (t - 1)^2 has mean 1 and variance 9 - 1 = 8.
    EXPECT_LT(std::abs(sum / n - 1.0) * std::sqrt(n), fiveSigma) << "seed " << seed;
    EXPECT_LT(std::abs(squares / n - 1.0) * std::sqrt(n / 8.0), fiveSigma) << "seed " << seed;
  }
}

TEST(RandomStream, BelowIsUniformOverItsRangeAndNeverReachesTheEnd) {
  for (const std::uint64_t n : {1ULL, 2ULL, 7ULL, 100ULL}) {
    RandomStream stream(8, n, 4);
    std::vector<std::size_t> count(n, 0);
    for (std::size_t i = 0; i < sampleSize; ++i) {
      const std::uint64_t k = stream.below(n);
      ASSERT_LT(k, n);
      ++count[k];
    }
    if (n > 1) {
      EXPECT_LT(std::abs(chiSquareScore(count)), fiveSigma) << "n " << n;
    }
  }
}

}  // namespace
}  // namespace lampblack
