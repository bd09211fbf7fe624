// Tables over place and time.
#include "io/grid_table.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <optional>

#include "core/errors.hpp"
#include "io/table_column.hpp"
#include "io/table_columns.hpp"
#include "tests/every_module.hpp"
#include "tests/messages.hpp"
#include "tests/scratch.hpp"

namespace lampblack::test {
namespace {

using testing::HasSubstr;

class Tables : public testing::Test {
 protected:
  ScratchFolder folder;
  GridTable read(const std::string& text) const {
    return {folder.file("table.csv", text),
            {{"r", units::length}, {"z", units::length}, {"t", units::time}},
            [](const std::string& name) -> std::optional<units::Dimension> {
              if (name == "velocity") return units::velocity;
              if (name == "temperature") return units::temperature;
              return std::nullopt;
            }};
  }
  std::string problem(const std::string& text) const {
    return messageOf<InputError>([&] { (void)read(text); });
  }
};

TEST_F(Tables, AreLinearBetweenPointsAndConstantBeyond) {
  const GridTable table = read("z [mm],velocity [cm/s],note\n0,10,a\n2,30,b\n1,40,c\n");
  EXPECT_THAT(table.names(), testing::ElementsAre("velocity"));
  EXPECT_TRUE(table.dependsOn("z"));
  EXPECT_FALSE(table.dependsOn("t"));
  EXPECT_EQ(table.range("z"), (std::pair{0.0, 2e-3}));
  const auto at = [&](double z) { return table.value(0, std::array{9.0, z, 9.0}); };
  EXPECT_NEAR(at(0.5e-3), 0.25, 1e-15);
  EXPECT_NEAR(at(1e-3), 0.40, 1e-15);
  EXPECT_NEAR(at(1.75e-3), 0.325, 1e-15);
  EXPECT_NEAR(at(-1.0), 0.10, 1e-15);
  EXPECT_NEAR(at(1.0), 0.30, 1e-15);
}

TEST_F(Tables, NoTwoColumnsSayTheSame) {
  EXPECT_THAT(problem("z [mm],velocity [cm/s],temperature,velocity [m/s]\n0,10,300,2\n"),
              HasSubstr("table.csv: two columns say the same, 'velocity [cm/s]' and 'velocity [m/s]'; leave one out"));
  EXPECT_THAT(problem("z,z [mm],velocity\n0,0,1\n"), HasSubstr("'z' and 'z [mm]'"));
  EXPECT_EQ(read("z,note,note,velocity\n0,a,b,1\n").names().size(), 1U);
}

TEST_F(Tables, UnitsStandInBracketsWithABlankOrWithout) {
  using Pair = std::pair<std::string, std::string>;
  EXPECT_EQ(nameAndUnit("velocity [cm/s]"), (Pair{"velocity", "cm/s"}));
  EXPECT_EQ(nameAndUnit("velocity[cm/s]"), (Pair{"velocity", "cm/s"}));
  EXPECT_EQ(nameAndUnit("velocity  (cm/s)"), (Pair{"velocity", "cm/s"}));
  EXPECT_EQ(nameAndUnit("velocity (mean)"), (Pair{"velocity (mean)", ""}));
  EXPECT_EQ(nameAndUnit("X_C5H5O(1,3) [1]"), (Pair{"X_C5H5O(1,3)", "1"}));
  for (const std::string species : {"X_CH2[s]", "X_CH2(s)", "X_CH2 (s)"})
    EXPECT_EQ(nameAndUnit(species), (Pair{species, ""}));
  const GridTable table = read("z(mm),velocity[cm/s]\r0,10\r2,30\r");
  EXPECT_NEAR(table.value(0, std::array{9.0, 1e-3, 9.0}), 0.2, 1e-15);
}

// In letters of any case but those of one letter; a number may be the name of a column that does not count.
TEST(TableColumns, AreFoundByTheirNames) {
  const TextTable table = readCsv("t,T,TIME of day,Speed [cm/s],2,speed\n0,300,noon,7,a,8\n");
  const TableColumns columns(table);
  EXPECT_EQ(columns.find({"time", "t"}), 0U);
  EXPECT_EQ(columns.find({"temperature", "T"}), 1U);
  EXPECT_EQ(columns.find({"Time of Day"}), 2U);
  EXPECT_EQ(columns.find({"z"}), std::nullopt);
  EXPECT_THAT(columns.read(3, units::velocity), testing::ElementsAre(testing::DoubleEq(0.07)));
  EXPECT_THAT(messageOf<InputError>([&] { (void)columns.find({"speed"}); }),
              HasSubstr("two columns say the same, 'Speed [cm/s]' and 'speed'"));
}

TEST_F(Tables, SpanAGridInAnyOrder) {
  // 1 + r + 10 t, 300 + r t: bilinear, so exact.
  const GridTable table =
      read("t,velocity,r,temperature [degC]\n2,21,0,26.85\n0,4,3,26.85\n2,24,3,32.85\n0,1,0,26.85\n");
  for (const double r : {0.0, 1.2, 3.0})
    for (const double t : {0.0, 0.5, 2.0}) {
      EXPECT_NEAR(table.value(0, std::array{r, 7.0, t}), 1.0 + r + 10.0 * t, 1e-12);
      EXPECT_NEAR(table.value(1, std::array{r, 7.0, t}), 300.0 + r * t, 1e-10);
    }
}

TEST_F(Tables, SayWhatIsWrong) {
  EXPECT_THAT(problem("velocity\n1\n"), HasSubstr("expected a column of one of: r, z, t; found 'velocity'"));
  EXPECT_THAT(problem("0,1\n1,2\n"), HasSubstr("the first line has the numbers 0, 1 in place of the names"));
  EXPECT_THAT(problem("r,velocity\n0,\"1,5\"\n"), HasSubstr("found '1,5'; numbers have a decimal point"));
  EXPECT_THAT(problem("r,speed\n1,2\n"), HasSubstr("no column has a name that counts here; found 'r', 'speed'"));
  EXPECT_THAT(problem("r,velocity\n"), HasSubstr("no rows"));
  EXPECT_THAT(problem("r,velocity\n1,fast\n"),
              HasSubstr("line 2: expected a finite number as 'velocity', found 'fast'"));
  // Lines of the file count, not rows; the texts of the file may go over several.
  EXPECT_THAT(problem("# a remark\n\nr,velocity,\"in\nwords\"\n0,1,\"two\nlines\"\n\n1,nan,x\n"),
              HasSubstr("line 8: expected a finite number as 'velocity', found 'nan'"));
  for (const char* none : {"NaN", "inf", "-inf", "1e999", ""})
    EXPECT_THAT(problem(fmt::format("r,velocity\n0,1\n1,{}\n", none)),
                HasSubstr(fmt::format("line 3: expected a finite number as 'velocity', found '{}'", none)));
  EXPECT_THAT(problem("r,velocity\nnan,1\n"), HasSubstr("line 2: expected a finite number as 'r', found 'nan'"));
  EXPECT_THAT(problem("r,velocity\n0,1\n1\n"), HasSubstr("line 3 has 1 fields, the line of the names 2"));
  EXPECT_THAT(problem("r,velocity [K]\n1,2\n"), HasSubstr("'velocity' is in K; expected a velocity"));
  EXPECT_THAT(problem("r,t,velocity\n0,0,1\n1,0,1\n0,1,1\n"), HasSubstr("a grid of 4 points, but there are 3 rows"));
  EXPECT_THAT(problem("r,t,velocity\n0,0,1\n1,0,1\n0,1,1\n0,1,1\n"), HasSubstr("row 4 has the place of another row"));
}

}  // namespace
}  // namespace lampblack::test
