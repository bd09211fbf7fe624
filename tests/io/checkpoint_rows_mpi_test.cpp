// Rows of any lengths in a checkpoint: they come back as they were on any number of ranks, and a file whose lengths are
// not those of its values is refused by all ranks together.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>

#include "core/rank_exchange.hpp"
#include "core/system_error.hpp"
#include "io/checkpoint_file.hpp"
#include "io/sealed_file.hpp"
#include "tests/io/cell_rows.hpp"
#include "tests/messages.hpp"
#include "tests/shared_scratch.hpp"

namespace lampblack::io {
namespace {

namespace fs = std::filesystem;
using test::dealtCells;
using test::rowCells;
using test::RowsOfCells;
using Rows = std::vector<std::vector<double>>;

// The first `ranks` of all; nothing on the others.
class FirstRanks {
 public:
  explicit FirstRanks(int ranks) {
    MPI_Comm_split(MPI_COMM_WORLD, test::worldRank() < ranks ? 0 : MPI_UNDEFINED, 0, &comm_);
  }
  ~FirstRanks() {
    if (here()) MPI_Comm_free(&comm_);
  }
  FirstRanks(const FirstRanks&) = delete;
  FirstRanks& operator=(const FirstRanks&) = delete;
  [[nodiscard]] bool here() const { return comm_ != MPI_COMM_NULL; }
  [[nodiscard]] MPI_Comm comm() const { return comm_; }

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
};

StateNumbers numbersOf(MPI_Comm comm, int deal) {
  return {dealtCells(comm, deal), {}, rowCells, 0};
}

// What is read is between other things, and the halo that follows the owned cells is left alone.
void write(MPI_Comm comm, const fs::path& path, int deal, const RowsOfCells& of) {
  const StateNumbers numbers = numbersOf(comm, deal);
  CheckpointWriter writer(comm, path, numbers, {});
  Rows rows = of.rows(numbers.cells);
  rows.push_back({-1.0, -2.0});
  std::vector<double> cells(numbers.cells.begin(), numbers.cells.end());
  writer.cells("before", cells, 1);
  writer.rows("particles", rows);
  writer.cells("after", cells, 1);
  writer.finish();
}

Rows read(MPI_Comm comm, const fs::path& path, const StateNumbers& numbers) {
  CheckpointReader reader(comm, path, numbers, {});
  Rows rows(numbers.cells.size() + 1, {-3.0, -4.0, -5.0});
  std::vector<double> cells(numbers.cells.size());
  reader.cells("after", cells, 1);
  reader.rows("particles", rows);
  EXPECT_EQ(cells, std::vector<double>(numbers.cells.begin(), numbers.cells.end()));
  EXPECT_EQ(rows.back(), (std::vector<double>{-3.0, -4.0, -5.0}));
  rows.pop_back();
  return rows;
}

TEST(CheckpointRows, ComeBackOnAnyNumberOfRanks) {
  const test::SharedScratchFolder folder;
  const RowsOfCells of;
  for (int writers = 1; writers <= test::worldSize(); ++writers) {
    const fs::path path = folder.path() / fmt::format("{}.h5", writers);
    if (const FirstRanks ranks(writers); ranks.here()) write(ranks.comm(), path, 0, of);
    MPI_Barrier(MPI_COMM_WORLD);
    for (int readers = 1; readers <= test::worldSize(); ++readers) {
      const FirstRanks ranks(readers);
      if (!ranks.here()) continue;
      const StateNumbers numbers = numbersOf(ranks.comm(), readers);
      EXPECT_EQ(read(ranks.comm(), path, numbers), of.rows(numbers.cells)) << writers << " wrote, " << readers;
    }
  }
}

// The file has the rows in the order of the cells, whoever wrote it.
TEST(CheckpointRows, LieOneBehindTheOtherInTheFile) {
  const test::SharedScratchFolder folder;
  const RowsOfCells of;
  write(MPI_COMM_WORLD, folder.path() / "rows.h5", 1, of);
  std::vector<double> lengths, values;
  for (std::int64_t cell = 0; cell < rowCells; ++cell) {
    const std::vector<double> row = of.row(cell);
    lengths.push_back(static_cast<double>(row.size()));
    values.insert(values.end(), row.begin(), row.end());
  }
  const Hdf5Reader file(folder.path() / "rows.h5");
  EXPECT_EQ(file.numbers("/state/particles_lengths", {rowCells, 1}), lengths);
  EXPECT_EQ(file.numbers("/state/particles", {static_cast<std::int64_t>(values.size())}), values);
}

// Where one begins, many others may begin and end.
TEST(CheckpointRows, MayAllBeEmptyButOne) {
  const test::SharedScratchFolder folder;
  for (const std::int64_t one : {-1, 0, 3, 9, 23, 46}) {
    const RowsOfCells of{[=](std::int64_t cell) { return cell == one ? 4 : 0; }};
    write(MPI_COMM_WORLD, folder.path() / "rows.h5", 0, of);
    const StateNumbers numbers = numbersOf(MPI_COMM_WORLD, 1);
    EXPECT_EQ(read(MPI_COMM_WORLD, folder.path() / "rows.h5", numbers), of.rows(numbers.cells)) << one;
  }
}

// More than two portions on three ranks, most of them of one cell; pieces begin and end within rows and at their ends.
TEST(CheckpointRows, OfManyPortionsAreWhole) {
  const test::SharedScratchFolder folder;
  const auto piece = static_cast<std::int64_t>(valuesInPortion);
  const RowsOfCells of{[=](std::int64_t cell) {
    if (cell == 3) return piece;
    if (cell == 20) return 5 * piece + 17;
    if (cell == 30) return piece / 3;
    return cell < 3 ? 0 : cell % 3;
  }};
  write(MPI_COMM_WORLD, folder.path() / "rows.h5", 0, of);
  const StateNumbers numbers = numbersOf(MPI_COMM_WORLD, 1);
  EXPECT_TRUE(read(MPI_COMM_WORLD, folder.path() / "rows.h5", numbers) == of.rows(numbers.cells));
}

TEST(CheckpointRows, AreReadByTheRanksThatHaveTheCellsThen) {
  const test::SharedScratchFolder folder;
  const RowsOfCells of;
  write(MPI_COMM_WORLD, folder.path() / "rows.h5", 0, of);
  CheckpointReader reader(MPI_COMM_WORLD, folder.path() / "rows.h5", numbersOf(MPI_COMM_WORLD, 0), {});
  const StateNumbers numbers = numbersOf(MPI_COMM_WORLD, 2);
  reader.renumber(numbers);
  Rows rows(numbers.cells.size());
  reader.rows("particles", rows);
  EXPECT_EQ(rows, of.rows(numbers.cells));
}

// A sealed file with these lengths of all cells and so many values.
void forge(const fs::path& path, const std::vector<double>& lengths, const std::vector<std::int64_t>& shape) {
  StateNumbers numbers{{}, {}, static_cast<std::int64_t>(lengths.size()), 0};
  if (test::worldRank() == 0)
    for (std::int64_t cell = 0; cell < numbers.totalCells; ++cell) numbers.cells.push_back(cell);
  CheckpointWriter writer(MPI_COMM_WORLD, path, numbers, {});
  std::vector<double> own(numbers.cells.empty() ? std::vector<double>{} : lengths);
  writer.cells("particles_lengths", own, 1);
  std::int64_t size = 1;
  for (const std::int64_t extent : shape) size *= extent;
  std::vector<double> values(static_cast<std::size_t>(size), 1.0);
  if (shape.size() == 1)
    writer.shared("particles", values);
  else
    writer.sums("particles", values);
  writer.finish();
}

TEST(CheckpointRows, OfAFileWithOtherLengthsThanValuesAreRefusedByAllRanks) {
  const test::SharedScratchFolder folder;
  const fs::path path = folder.path() / "rows.h5";
  const StateNumbers numbers = numbersOf(MPI_COMM_WORLD, 0);
  const auto refusal = [&](std::vector<double> lengths, const std::vector<std::int64_t>& shape) {
    forge(path, lengths, shape);
    CheckpointReader reader(MPI_COMM_WORLD, path, numbers, {});
    Rows rows(numbers.cells.size());
    std::string message = test::messageOf<InputError>([&] { reader.rows("particles", rows); });
    // The ranks go on together.
    int failed = message.empty() ? 0 : 1, all = 0;
    MPI_Allreduce(&failed, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    EXPECT_EQ(all, failed * test::worldSize());
    return message;
  };
  const std::vector<double> twos(rowCells, 2.0);
  const auto with = [&](std::size_t cell, double length) {
    std::vector<double> lengths = twos;
    lengths[cell] = length;
    return lengths;
  };
  using testing::HasSubstr;
  const std::vector<std::int64_t> fitting{2 * rowCells};
  EXPECT_EQ(refusal(twos, fitting), "");
  for (const std::size_t cell : {std::size_t{0}, std::size_t{20}, static_cast<std::size_t>(rowCells - 1)}) {
    for (const double length :
         {-1.0, 1.5, 1e18, 1e300, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
      EXPECT_THAT(refusal(with(cell, length), fitting),
                  HasSubstr(fmt::format("rows.h5: /state/particles_lengths has the length {}", length)));
    EXPECT_THAT(refusal(with(cell, 1.0), fitting),
                HasSubstr(fmt::format("rows.h5: the lengths of /state/particles add up to {}, but it has {} values",
                                      2 * rowCells - 1, 2 * rowCells)));
  }
  // Nothing is left for the next cell of the block.
  EXPECT_THAT(refusal(with(0, 2.0 * rowCells), fitting), HasSubstr("/state/particles_lengths has the length 2,"));
  EXPECT_THAT(refusal(twos, {2 * rowCells + 1}), HasSubstr("but it has 95 values"));
  EXPECT_THAT(refusal(twos, {2 * rowCells - 1}),
              HasSubstr(test::worldSize() > 1 ? "add up to 94, but it has 93 values" : "has the length 2,"));
  EXPECT_THAT(refusal(twos, {0}), HasSubstr("rows.h5: "));
  EXPECT_THAT(refusal(twos, {1, 2 * rowCells}), HasSubstr("is no list of values"));
  EXPECT_THAT(refusal(std::vector<double>(rowCells - 1, 2.0), {2 * rowCells - 2}),
              HasSubstr("does not have the shape"));
}

TEST(CheckpointRows, ThatAFileDoesNotHaveAreRefusedByAllRanks) {
  const test::SharedScratchFolder folder;
  write(MPI_COMM_WORLD, folder.path() / "rows.h5", 0, {});
  const StateNumbers numbers = numbersOf(MPI_COMM_WORLD, 0);
  CheckpointReader reader(MPI_COMM_WORLD, folder.path() / "rows.h5", numbers, {});
  Rows rows(numbers.cells.size());
  const auto refusal = [&](const std::function<void()>& load) { return test::messageOf<InputError>(load); };
  EXPECT_THAT(refusal([&] { reader.rows("after", rows); }), testing::HasSubstr("/state/after is no list of values"));
  // What another version, or another deck, has not kept is told as that, whatever it is.
  std::vector<double> values(numbers.cells.size());
  for (const std::function<void()>& load : std::vector<std::function<void()>>{
           [&] { reader.rows("others", rows); }, [&] { reader.cells("others", values, 1); },
           [&] { reader.sums("others", values); }, [&] { reader.shared("others", values); },
           [&] { static_cast<void>(reader.texts("others")); }})
    EXPECT_THAT(refusal(load),
                testing::ContainsRegex("rows.h5: this checkpoint has no /state/others: another version .*, or the deck "
                                       "has since got an option .* \\(initial.flow.results\\)"));
}

// A disk (here: a limit on the file's size) that cannot take the values: all ranks say so, and nothing is left.
TEST(CheckpointRows, ThatTheDiskCannotTakeLeaveNothing) {
  const test::SharedScratchFolder folder;
  const RowsOfCells of{
      [](std::int64_t cell) { return cell == 7 ? 4 * static_cast<std::int64_t>(valuesInPortion) : 1; }};
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{1U << 22U, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message =
      test::messageOf<SystemError>([&] { write(MPI_COMM_WORLD, folder.path() / "rows.h5", 0, of); });
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_THAT(message, testing::HasSubstr("write /state/particles to"));
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace lampblack::io
