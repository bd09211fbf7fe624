// Rows of any lengths that travel between ranks, and the answers to them.
#include "core/rank_exchange.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/core/mpi_support.hpp"

namespace lampblack::test {
namespace {

// Of an item of a rank: none, one or more values, which say whose they are.
std::vector<double> rowOf(int rank, int item) {
  std::vector<double> row(at((rank + 2 * item) % 4), 100.0 * rank + item);
  for (std::size_t i = 0; i < row.size(); ++i) row[i] += 0.01 * static_cast<double>(i);
  return row;
}

constexpr int items = 11;

int goalOf(int rank, int item) {
  return (7 * item + rank) % worldSize();
}

struct Sent {
  std::vector<int> goals;
  PackedRows rows;
  Sent() {
    for (int item = 0; item < items; ++item) {
      goals.push_back(goalOf(worldRank(), item));
      rows.add(rowOf(worldRank(), item));
    }
  }
};

TEST(RankExchange, RowsArriveByRankAndInItsOrder) {
  const Sent sent;
  PackedRows expected;
  for (int rank = 0; rank < worldSize(); ++rank)
    for (int item = 0; item < items; ++item)
      if (goalOf(rank, item) == worldRank()) expected.add(rowOf(rank, item));
  const PackedRows came = RankExchange(MPI_COMM_WORLD, sent.goals).send(sent.rows);
  EXPECT_EQ(came.lengths, expected.lengths);
  EXPECT_EQ(came.values, expected.values);
}

// Each rank answers row i of those that came with that row and its own number.
TEST(RankExchange, AnswersMayHaveOtherLengthsThanQuestions) {
  const Sent sent;
  const RankExchange exchange(MPI_COMM_WORLD, sent.goals);
  const PackedRows came = exchange.send(sent.rows);
  PackedRows answers, expected;
  auto next = came.values.begin();
  for (const std::int64_t length : came.lengths) {
    std::vector<double> row(next, next + length);
    next += length;
    row.push_back(-worldRank());
    answers.add(row);
  }
  for (int item = 0; item < items; ++item) {
    std::vector<double> row = rowOf(worldRank(), item);
    row.push_back(-goalOf(worldRank(), item));
    expected.add(row);
  }
  const PackedRows found = exchange.reply(answers);
  EXPECT_EQ(found.lengths, expected.lengths);
  EXPECT_EQ(found.values, expected.values);
}

TEST(RankExchange, NoRowsAndRowsOfNothingAreFine) {
  const RankExchange none(MPI_COMM_WORLD, {});
  EXPECT_TRUE(none.send(PackedRows{}).lengths.empty());
  EXPECT_TRUE(none.reply(PackedRows{}).lengths.empty());
  const RankExchange one(MPI_COMM_WORLD, std::vector<int>{0});
  const PackedRows came = one.send(PackedRows{{0}, {}});
  EXPECT_EQ(came.lengths, std::vector<std::int64_t>(worldRank() == 0 ? at(worldSize()) : 0, 0));
  EXPECT_TRUE(came.values.empty());
}

TEST(PackedRows, GoToTheirPlacesAndBack) {
  const PackedRows rows{{2, 0, 3, 1}, {1, 2, 3, 4, 5, 6}};
  const std::vector<std::size_t> order{2, 0, 3, 1};
  const PackedRows other = gathered(rows, order);
  EXPECT_EQ(other.lengths, (std::vector<std::int64_t>{3, 2, 1, 0}));
  EXPECT_EQ(other.values, (std::vector<double>{3, 4, 5, 1, 2, 6}));
  const PackedRows again = scattered(other, order);
  EXPECT_EQ(again.lengths, rows.lengths);
  EXPECT_EQ(again.values, rows.values);
  EXPECT_THROW(static_cast<void>(scattered(rows, std::vector<std::size_t>{2, 0, 3, 2})), std::logic_error);
  EXPECT_THROW(static_cast<void>(gathered({{2, 1}, {1, 2, 3, 4}}, std::vector<std::size_t>{0, 1})), std::logic_error);
}

}  // namespace
}  // namespace lampblack::test
