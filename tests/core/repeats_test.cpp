// Repeats over ranks: each once, in order, on the first rank; one message where one fails.
#include "core/repeats.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "mpi_support.hpp"
#include "tests/every_module.hpp"

namespace lampblack::test {
namespace {

constexpr std::size_t repeatWidth = 3;

void numbersOf(std::uint64_t repeat, std::span<double> row) {
  ASSERT_EQ(row.size(), repeatWidth);
  for (std::size_t k = 0; k < row.size(); ++k) row[k] = static_cast<double>(10 * repeat + k);
}

TEST(Repeats, ComeBackInTheirOrderOnTheFirstRank) {
  for (const std::uint64_t first : {0, 2, 5}) {
    int own = 0;
    const std::uint64_t end = first + 7;
    const std::vector<double> rows =
        gatherRepeats(MPI_COMM_WORLD, first, end, repeatWidth, [&](std::uint64_t repeat, std::span<double> row) {
          numbersOf(repeat, row);
          ++own;
        });
    EXPECT_EQ(sumOverRanks(own), 7);
    EXPECT_GE(own, 7 / worldSize()) << "of seven repeats";
    if (worldRank() != 0) {
      EXPECT_TRUE(rows.empty());
      continue;
    }
    std::vector<double> expected(7 * repeatWidth);
    for (std::uint64_t repeat = first; repeat < end; ++repeat)
      numbersOf(repeat, std::span(expected).subspan((repeat - first) * repeatWidth, repeatWidth));
    EXPECT_EQ(rows, expected);
  }
}

TEST(Repeats, ThoseOfTheFirstRankAreSharedWithAll) {
  std::vector<double> rows = gatherRepeats(MPI_COMM_WORLD, 0, 4, repeatWidth, numbersOf);
  shareRepeats(MPI_COMM_WORLD, rows, 4 * repeatWidth);
  ASSERT_EQ(rows.size(), 4 * repeatWidth);
  EXPECT_EQ(rows.back(), 32);
}

TEST(Repeats, OneThatFailsIsTheFailureOfAllRanks) {
  for (std::uint64_t failing = 0; failing < 5; ++failing) {
    const std::string expected = "repeat " + std::to_string(failing);
    EXPECT_EQ(messageOf<NumericsError>([&] {
                (void)gatherRepeats(MPI_COMM_WORLD, 0, 5, 1, [&](std::uint64_t repeat, std::span<double>) {
                  if (repeat == failing) throw NumericsError(expected);
                });
              }),
              expected);
  }
}

TEST(Repeats, AsManyAtATimeForEachRankAsMemoryAllows) {
  const auto ranks = static_cast<std::uint64_t>(worldSize());
  EXPECT_EQ(repeatsAtATime(MPI_COMM_WORLD, std::size_t{1} << 40), ranks);
  const std::uint64_t many = repeatsAtATime(MPI_COMM_WORLD, 1000);
  EXPECT_EQ(many % ranks, 0U);
  EXPECT_LE(many * 1000, std::uint64_t{1} << 24);
  EXPECT_GT((many + ranks) * 1000, std::uint64_t{1} << 24);
}

}  // namespace
}  // namespace lampblack::test
