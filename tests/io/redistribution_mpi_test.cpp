// What belongs to cells is there, after the mesh was partitioned anew, where the cells are.
#include <gtest/gtest.h>

#include <stdexcept>

#include "core/state_backup.hpp"
#include "io/redistribution.hpp"
#include "tests/io/cell_rows.hpp"

namespace lampblack::io {
namespace {

using test::dealtCells;
using test::rowCells;
using Numbers = std::vector<std::int64_t>;

StateBackup keptOf(std::size_t cells, std::vector<std::vector<double>> rows, std::vector<double> numbers) {
  StateBackup kept(static_cast<int>(cells), 0);
  kept.save([&](StateArchive& archive) {
    archive.rows("particles", rows);
    archive.cells("numbers", numbers, 1);
    archive.rows("more", rows);
  });
  return kept;
}

TEST(Redistribution, BringsRowsAndValuesToTheRanksThatWillHaveTheirCells) {
  const test::RowsOfCells of;
  const auto numbersOf = [](const Numbers& cells) { return std::vector<double>(cells.begin(), cells.end()); };
  for (const int deal : {0, 1, 2}) {
    const Numbers from = dealtCells(MPI_COMM_WORLD, deal), to = dealtCells(MPI_COMM_WORLD, deal + 1);
    const Redistribution movement(MPI_COMM_WORLD, from, to, rowCells);
    StateBackup kept = keptOf(from.size(), of.rows(from), numbersOf(from));
    kept.rearrange(static_cast<int>(to.size()), 0, movement, movement, movement);
    std::vector<std::vector<double>> rows(to.size(), {-1.0}), more(to.size());
    std::vector<double> numbers(to.size());
    kept.restore([&](StateArchive& archive) {
      archive.rows("particles", rows);
      archive.cells("numbers", numbers, 1);
      archive.rows("more", more);
    });
    EXPECT_EQ(rows, of.rows(to));
    EXPECT_EQ(more, of.rows(to));
    EXPECT_EQ(numbers, numbersOf(to));
  }
}

// All cells of all ranks, and none of the others'.
TEST(Redistribution, ARankMayHaveNothingBeforeOrAfter) {
  const test::RowsOfCells of;
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const Numbers all = dealtCells(MPI_COMM_SELF, 0);
  const Numbers from = rank == 0 ? all : Numbers{}, to = rank == ranks - 1 ? all : Numbers{};
  PackedRows rows, expected;
  for (const std::int64_t cell : from) rows.add(of.row(cell));
  for (const std::int64_t cell : to) expected.add(of.row(cell));
  const PackedRows moved = Redistribution(MPI_COMM_WORLD, from, to, rowCells)(rows);
  EXPECT_EQ(moved.lengths, expected.lengths);
  EXPECT_EQ(moved.values, expected.values);
}

TEST(Redistribution, RowsOfWhatSeveralRanksHaveAreRefused) {
  const Numbers once = dealtCells(MPI_COMM_WORLD, 0);
  Numbers twice = once;
  twice.push_back(0);
  PackedRows rows;
  for (std::size_t i = 0; i < twice.size(); ++i) rows.add({});
  EXPECT_THROW(static_cast<void>(Redistribution(MPI_COMM_WORLD, twice, once, rowCells)(rows)), std::logic_error);
  rows.lengths.pop_back();
  EXPECT_THROW(static_cast<void>(Redistribution(MPI_COMM_WORLD, once, twice, rowCells)(rows)), std::logic_error);
}

}  // namespace
}  // namespace lampblack::io
