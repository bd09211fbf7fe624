// Tables as text: what is written reads back, whatever the names of the columns are.
#include "io/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <fstream>
#include <sstream>
#include <string>

#include "core/modules.hpp"
#include "io/history.hpp"
#include "tests/scratch.hpp"

namespace lampblack::io {
namespace {

TEST(Csv, FieldsWithCommasQuotesAndLineBreaksComeBack) {
  const TextTable table{{"run", "X_C5H5O(1,3) [1]", "a \"b\""}, {{"one", "1", "two\nlines"}, {"", "2,5", "\"\""}}};
  const TextTable again = readCsv(csvText(table));
  EXPECT_EQ(again.columns, table.columns);
  EXPECT_EQ(again.rows, table.rows);
  EXPECT_EQ(csvLine({"a", "b,c"}), "a,\"b,c\"\n");
}

TEST(Csv, AByteOrderMarkIsNoPartOfTheFirstName) {
  EXPECT_EQ(readCsv("\xef\xbb\xbf"
                    "a,b\n1,2\n")
                .columns,
            (std::vector<std::string>{"a", "b"}));
}

TEST(Csv, TheHeaderOfAHistoryHasAsManyFieldsAsItsRows) {
  const test::ScratchFolder folder;
  const auto path = folder.path() / "history.csv";
  {
    HistoryWriter history(MPI_COMM_SELF, path, {{"time", "s", ""}, {"X_C5H5O(1,3)", "1", ""}, {"X_OH", "1", ""}});
    history.row(std::vector<double>{0.5, 0.25, 0.125});
  }
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), "time [s],\"X_C5H5O(1,3) [1]\",X_OH [1]\n0.5,0.25,0.125\n");
  EXPECT_EQ(readCsv(text.str()).columns.size(), 3U);
}

}  // namespace
}  // namespace lampblack::io
