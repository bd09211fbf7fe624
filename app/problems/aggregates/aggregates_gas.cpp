#include "app/problems/aggregates/aggregates_gas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/errors.hpp"
#include "core/text_file.hpp"
#include "io/csv.hpp"
#include "io/table_columns.hpp"

namespace lampblack::app {
namespace {

void readColumns(const TextTable& table, AggregatesGas& gas) {
  struct Known {
    const char* name;
    units::Dimension dimension;
    std::vector<double>* values;
    double above, atLeast;
  };
  constexpr double any = -std::numeric_limits<double>::infinity();
  const Known known[] = {{"time", units::time, &gas.time, any, any},
                         {"temperature", units::temperature, &gas.temperature, 0, 0},
                         {"pressure", units::pressure, &gas.pressure, 0, 0},
                         {"births", units::ratePerVolume, &gas.births, any, 0},
                         {"growth", units::velocity, &gas.growth, any, 0}};
  const TableColumns columns(table);
  for (std::size_t column = 0; column < columns.size(); ++column) {
    const std::string& name = columns.name(column);
    const auto* one = std::ranges::find_if(known, [&](const Known& k) { return isColumnName(name, k.name); });
    if (one == std::end(known))
      throw InputError(
          fmt::format("the column '{}' has no meaning here; there are time, temperature, pressure, births "
                      "and growth",
                      name));
    if (!one->values->empty()) throw InputError(fmt::format("two columns are called '{}'", name));
    *one->values = columns.read(column, one->dimension);
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      const double value = (*one->values)[row];
      if (!(value > one->above) || !(value >= one->atLeast))
        throw InputError(fmt::format("line {}: '{}' has to be {} zero", table.lines[row], name,
                                     one->above == 0 ? "above" : "at least"));
    }
  }
  for (const Known& one : known) {
    const bool isNeeded = one.values != &gas.births && one.values != &gas.growth;
    if (one.values->empty() && isNeeded)
      throw InputError(fmt::format("expected a column '{}'; found {}", one.name, columns.listed()));
    if (one.values->empty()) one.values->assign(table.rows.size(), 0);
  }
  for (std::size_t row = 1; row < gas.time.size(); ++row)
    if (!(gas.time[row] > gas.time[row - 1]))
      throw InputError(fmt::format("line {}: times have to rise", table.lines[row]));
}

}  // namespace

AggregatesGas readAggregatesGas(const std::filesystem::path& file) {
  const std::string text = readTextFile(file, "a table of a gas");
  try {
    AggregatesGas gas;
    const TextTable table = readCsv(text);
    if (table.rows.empty()) throw InputError("the table has no rows");
    readColumns(table, gas);
    return gas;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace lampblack::app
