// Tables made of columns with their values.
#include "io/table.hpp"

#include <gmock/gmock.h>

#include "core/modules.hpp"
#include "io/csv.hpp"

namespace lampblack::io {
namespace {

using testing::ElementsAre;

struct Tyre {
  double radius = 0, pressure = 0;
};

TableOf<const Tyre&> tyreTable() {
  TableOf<const Tyre&> table{{{"radius", "m", "radius"}, [](const Tyre& t) { return t.radius; }}};
  table.add({{"pressure", "Pa", "pressure"}, {"twice", "Pa", "the same twice"}},
            [](const Tyre& t, std::vector<double>& row) {
              row.insert(row.end(), {t.pressure, 2 * t.pressure});
            });
  table.add({"area", "m^2", "radius squared"}, [](const Tyre& t) { return t.radius * t.radius; });
  return table;
}

TEST(TableOf, ValuesStandUnderTheirColumns) {
  const Table table = tyreTable().of(std::vector<Tyre>{{2, 10}, {3, 20}});
  std::vector<std::string> names;
  for (const Quantity& column : table.columns) names.push_back(column.name);
  EXPECT_THAT(names, ElementsAre("radius", "area", "pressure", "twice"));
  EXPECT_THAT(table.rows, ElementsAre(2, 4, 10, 20, 3, 9, 20, 40));
  EXPECT_EQ(csvTable(table.columns, table.rows).substr(0, 30), "radius [m],area [m^2],pressure");
}

TEST(TableOf, ARowMayBeOfSeveralThings) {
  const TableOf<double, int> table{{{"product", "1", ""}, [](double x, int n) { return x * n; }}};
  EXPECT_THAT(table.row(1.5, 4), ElementsAre(6));
}

TEST(Table, TheLastRowIsRecordedFromAColumnOn) {
  const Table table{{{"time", "s", ""}, {"mass", "kg", ""}}, {0, 5, 1, 7}};
  EXPECT_EQ(table.last(0), 1);
  const std::string from1 = jsonObject([&](JsonWriter& json) { table.recordLast(json); });
  EXPECT_THAT(from1, testing::HasSubstr("\"final_mass\": 7"));
  EXPECT_THAT(from1, testing::Not(testing::HasSubstr("final_time")));
  EXPECT_THAT(jsonObject([&](JsonWriter& json) { table.recordLast(json, 0); }),
              testing::HasSubstr("\"final_time\": 1"));
}

}  // namespace
}  // namespace lampblack::io
