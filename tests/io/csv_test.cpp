// Tables as text: what is written reads back, whatever the names of the columns are.
#include "io/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mpi.h>

#include <fstream>
#include <sstream>
#include <string>

#include "core/errors.hpp"
#include "core/modules.hpp"
#include "io/history.hpp"
#include "tests/messages.hpp"
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

// As spreadsheets and people write tables; blanks in quotes are the field's.
TEST(Csv, SemicolonsTabulatorsAndBlanksAroundFields) {
  for (const std::string text : {"time [s], X_C2H2\n0 ,1\n2, 3\n", "time [s];X_C2H2\r\n0;1\r\n2;3\r\n",
                                 "# a, b\n\n \"time [s]\" ; X_C2H2\n0;1\n  \n2;3", "time [s]\tX_C2H2\n0\t1\n2\t 3\n"}) {
    const TextTable table = readCsv(text);
    EXPECT_EQ(table.columns, (std::vector<std::string>{"time [s]", "X_C2H2"})) << text;
    EXPECT_EQ(table.rows, (std::vector<std::vector<std::string>>{{"0", "1"}, {"2", "3"}})) << text;
  }
  EXPECT_EQ(readCsv("a,b;c\n1,2;3\n").rows[0], (std::vector<std::string>{"1", "2;3"})) << "a comma parts alone";
  EXPECT_EQ(readCsv("\"a,b\";c\n1;2\n").columns, (std::vector<std::string>{"a,b", "c"})) << "but not in quotes";
  EXPECT_EQ(readCsv("a\tb\n\t2\n").rows[0], (std::vector<std::string>{"", "2"}));
  const TextTable blanks{{"a"}, {{" b "}}};
  EXPECT_EQ(readCsv(csvText(blanks)).rows, blanks.rows);
}

// Where no comma parts fields.
TEST(Csv, DecimalCommasBecomePoints) {
  for (const std::string text : {"a;b\n1,5;-0,25e-3\n", "a\tb\n1,5\t-0,25e-3\n"})
    EXPECT_EQ(readCsv(text).rows[0], (std::vector<std::string>{"1.5", "-0.25e-3"})) << text;
  for (const std::string kept :
       {"1,2,3", "C5H5O(1,3)", "O2: 1, N2: 3", "1,", "x,5", "1,5x", "1.000,5", "1,5e", "1,5e+", "1,5e1e1", "+-1,5"})
    EXPECT_EQ(readCsv("a;b\n" + kept + ";2\n").rows[0][0], kept);
  for (const std::string text : {"a;b\n\"1,5\";2\n", "a\tb\n\"1,5\"\t2\n"})
    EXPECT_EQ(readCsv(text).rows[0][0], "1.5") << "in quotes, too";
  EXPECT_EQ(readCsv("a,b\n\"1,5\",2\n").rows[0][0], "1,5") << "commas part the fields";
  EXPECT_EQ(readCsv("a,b\n1,5\n").rows[0], (std::vector<std::string>{"1", "5"}));
}

// Between semicolons commas are decimal; between tabulators they may be those of thousands.
TEST(Csv, ACommaThatMayBeOfThousandsIsRefusedBetweenTabulators) {
  for (const std::string field : {"1,200", "-12,000", "\"999,999\""})
    EXPECT_THAT(test::messageOf<InputError>([&] { static_cast<void>(readCsv("a\tb\n0,1\t2\n3\t" + field + "\n")); }),
                testing::AllOf(testing::HasSubstr("line 3: the comma of '"), testing::HasSubstr("of thousands")))
        << field;
  for (const std::string field : {"0,200", "1,20", "1,2000", "1234,500", "1,200e3", ",200"})
    EXPECT_EQ(readCsv("a\tb\n1\t" + field + "\n").rows[0][1].find(','), std::string::npos) << field;
  EXPECT_EQ(readCsv("a;b\n1;1,200\n").rows[0][1], "1.200");
  EXPECT_EQ(readCsv("a\t\"1,200\"\n1\t2\n").columns[1], "1,200") << "a name";
}

TEST(Csv, RowsOfSeparatorsAloneAreNone) {
  for (const std::string text : {"a;b\n;\n1;2\n;;;\n", "a,b\n,\n1,2\n , \n", "a\tb\n1\t2\n\t\n", ";;\na;b\n1;2\n"}) {
    EXPECT_EQ(readCsv(text).columns, (std::vector<std::string>{"a", "b"})) << text;
    EXPECT_EQ(readCsv(text).rows, (std::vector<std::vector<std::string>>{{"1", "2"}})) << text;
  }
  EXPECT_EQ(readCsv("a,b\n\"\",\"\"\n").rows.size(), 1U) << "texts without letters";
}

TEST(Csv, EmptyFieldsBehindTheLastColumnAreNone) {
  for (const std::string text : {"a,b,\n1,2,\n", "a;b;;\n1;2;;\n", "a,b\n1,2,,\n"}) {
    EXPECT_EQ(readCsv(text).columns, (std::vector<std::string>{"a", "b"})) << text;
    EXPECT_EQ(readCsv(text).rows, (std::vector<std::vector<std::string>>{{"1", "2"}})) << text;
  }
  EXPECT_EQ(readCsv("a,b\n1,\n").rows[0], (std::vector<std::string>{"1", ""})) << "a column's own";
  EXPECT_THAT(test::messageOf<InputError>([] { static_cast<void>(readCsv("a,b,\n1,2,3\n")); }),
              testing::HasSubstr("line 2 has 3 fields, the line of the names 2"));
}

// As numpy's savetxt writes names; no other comment is one.
TEST(Csv, NamesMayStandInACommentAboveTheFirstRow) {
  for (const std::string text : {"# time [s],T [K]\n0,1e+3\n", "#time [s];T [K]\r\n0;1000\r\n",
                                 "# made here\n\n  # time [s],T [K]\n0, 1000\n"}) {
    EXPECT_EQ(readCsv(text).columns, (std::vector<std::string>{"time [s]", "T [K]"})) << text;
    EXPECT_EQ(readCsv(text).rows.size(), 1U) << text;
  }
  for (const std::string text : {"# a, b\n\n0,1\n", "# a, b, c\n0,1\n", "# a, b\nc,d\n", "# a, b\nc,1\n",
                                 "# a, b\n# c\n0,1\n", "0,1\n# a, b\n2,3\n", "# a b\n", "#"})
    EXPECT_EQ(withNamesOutOfComment(text), text);
  EXPECT_EQ(withNamesOutOfComment("# z [cm]  T [K]\n0 \t300\n"), "  z [cm]  T [K]\n0 \t300\n");
  EXPECT_EQ(withNamesOutOfComment("# height above it\n0 300\n"), "# height above it\n0 300\n");
  for (const std::string prose : {"# Abid et al., Combust. Flame 155 [2008]\n0,900\n", "# Abid et al. [1]\n0,900\n"})
    EXPECT_EQ(withNamesOutOfComment(prose), prose);
  const auto refusal = [](const std::string& text) {
    return test::messageOf<InputError>([&] { static_cast<void>(withNamesOutOfComment(text)); });
  };
  EXPECT_THAT(refusal("# height above burner [cm]  T [degC]\n0 900\n"),
              testing::HasSubstr("'# height above burner [cm]  T [degC]', names units, but has 4 fields, the row 2"));
  EXPECT_THAT(refusal("# t [s], T [K], p [bar]\r\n0,900\r\n"), testing::HasSubstr("has 3 fields, the row 2"));
}

// What parts the names parts the numbers, whose commas are decimal.
TEST(Csv, NamesInACommentMayStandAboveDecimalCommas) {
  for (const std::string text : {"# x [mm];velocity_x [m/s]\n0,0;1,2\n", "# x [mm]\tvelocity_x [m/s]\n0,0\t1,2\n",
                                 "# x;velocity_x\n0,0;1,2\n"}) {
    EXPECT_EQ(readCsv(text).columns[1].substr(0, 10), "velocity_x") << text;
    EXPECT_EQ(readCsv(text).rows, (std::vector<std::vector<std::string>>{{"0.0", "1.2"}})) << text;
  }
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
