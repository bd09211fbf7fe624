// Sums that any number of ranks, in any order, gets to the same bits.
#include "core/order_free_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/random.hpp"
#include "tests/every_module.hpp"
#include "tests/world.hpp"

namespace lampblack::test {
namespace {

// Of both signs, over thirty powers of ten.
std::vector<PlacedValue> values(std::size_t places) {
  RandomStream random(7, 1, 1);
  std::vector<PlacedValue> all;
  for (int i = 0; i < 3000; ++i) {
    const std::size_t place = random.below(places);
    const double size = std::pow(10.0, 30.0 * random.uniform() - 15.0);
    all.push_back({place, (random.uniform() - 0.3) * (place % 2 == 0 ? size : 1.0)});
  }
  return all;
}

TEST(OrderFreeSums, AreTheSameInAnyOrderOnAnyRanks) {
  constexpr std::size_t places = 7;
  std::vector<PlacedValue> all = values(places - 1);  // one place has none
  const std::vector<double> alone = orderFreeSums(MPI_COMM_SELF, places, all);
  RandomStream random(8, 1, 1);
  for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[random.below(i)]);
  std::vector<PlacedValue> own;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (static_cast<int>(i * i % 7) % worldSize() == worldRank()) own.push_back(all[i]);
  EXPECT_EQ(orderFreeSums(MPI_COMM_WORLD, places, own), alone);
  EXPECT_EQ(alone.back(), 0.0);
  for (std::size_t place = 0; place + 1 < places; ++place) {
    long double sum = 0.0L, largest = 0.0L;
    for (const PlacedValue& v : all) {
      if (v.place != place) continue;
      sum += static_cast<long double>(v.value);
      largest = std::max(largest, std::abs(static_cast<long double>(v.value)));
    }
    EXPECT_NEAR(alone[place], static_cast<double>(sum), static_cast<double>(largest) * 1e-12) << place;
  }
}

TEST(OrderFreeSums, TakeNothingAndTinyValuesAndRefuseNaN) {
  EXPECT_EQ(orderFreeSums(MPI_COMM_WORLD, 2, {}), (std::vector<double>{0.0, 0.0}));
  const std::vector<PlacedValue> tiny{{0, 3e-310}, {1, 1e300}};
  const std::vector<double> sums = orderFreeSums(MPI_COMM_SELF, 2, tiny);
  EXPECT_EQ(sums, (std::vector<double>{3e-310, 1e300}));
  const std::vector<PlacedValue> wrong{{0, std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_THROW(orderFreeSums(MPI_COMM_SELF, 1, wrong), std::logic_error);
}

}  // namespace
}  // namespace lampblack::test
