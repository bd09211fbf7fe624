#include "particles/population/monte_carlo/factored_sums.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

using Sums = FactoredSums<3, 2>;

double totalOf(const Sums& sums, std::size_t v, std::size_t f) {
  double total = 0;
  for (std::size_t at = 0; at < sums.size(); ++at) total += sums.value(v, at) * sums.factorsOf(at)[f];
  return total;
}

// Whatever entries came, changed and went.
TEST(FactoredSums, AreThoseOfTheEntries) {
  Sums sums(3);
  sums.renew();
  RandomStream random(3, 0, 0);
  const auto values = [&] { return Sums::Values{random.uniform(), random.uniform(), random.uniform()}; };
  const auto factors = [&] { return Sums::Factors{1.0, random.uniform()}; };
  for (int k = 0; k < 2000; ++k) {
    const double what = random.uniform();
    const auto at = static_cast<std::size_t>(random.below(std::max<std::size_t>(1, sums.size())));
    if (what < 0.4 || sums.size() == 0)
      sums.append(values(), factors());
    else if (what < 0.6)
      sums.set(at, values(), factors());
    else if (what < 0.8)
      sums.setFactors(at, factors());
    else
      sums.replaceByLast(at);
    for (std::size_t v = 0; v < 3; ++v)
      for (std::size_t f = 0; f < 2; ++f) ASSERT_NEAR(sums.total(v, f), totalOf(sums, v, f), 1e-11);
  }
  ASSERT_GT(sums.size(), 3 * Sums::block);
  // Each entry has its part of the sum, in order.
  double reached = 0;
  for (std::size_t at = 0; at < sums.size(); ++at) {
    const double own = sums.value(2, at) * sums.factorsOf(at)[1];
    EXPECT_EQ(sums.find(2, 1, reached + 0.5 * own), at);
    reached += own;
  }
  EXPECT_EQ(sums.find(2, 1, reached + 1e-6), sums.size());
}

}  // namespace
}  // namespace lampblack::test
