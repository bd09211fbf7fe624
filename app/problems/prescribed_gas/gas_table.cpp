#include "app/problems/prescribed_gas/gas_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "core/text_file.hpp"
#include "io/csv.hpp"
#include "io/deck_former_names.hpp"
#include "io/table_column.hpp"
#include "io/table_columns.hpp"

namespace lampblack::app {
namespace {

struct Known {
  const char *name, *symbol, *otherSymbol;
  units::Dimension dimension;
  std::vector<double> GasHistory::*values;
  bool isNeeded = true;
};

constexpr const char* formerLossRate = "thinning";  // of the column number_loss_rate

GasHistory historyOf(const TextTable& table, const Mechanism& mechanism, std::vector<std::string>& unknown) {
  const Known known[] = {
      {"time", "t", "t", units::time, &GasHistory::time},
      {"temperature", "T", "T", units::temperature, &GasHistory::temperature},
      {"pressure", "p", "P", units::pressure, &GasHistory::pressure},
      {"number_loss_rate", formerLossRate, formerLossRate, units::frequency, &GasHistory::numberLossRate, false}};
  const TableColumns columns(table);
  GasHistory history;
  const std::size_t rows = table.rows.size(), species = mechanism.numSpecies();
  if (rows == 0) throw InputError("the table has no rows");
  for (const Known& one : known) {
    const auto column = columns.find({one.name, one.symbol, one.otherSymbol});
    if (column)
      history.*one.values = columns.read(*column, one.dimension);
    else if (one.isNeeded)
      throw InputError(fmt::format("expected a column '{}' or '{}', as \"{} [{}]\"; found {}", one.name, one.symbol,
                                   one.name, units::siUnit(one.dimension), columns.listed()));
  }
  history.fractions.assign(rows * species, 0.0);
  std::vector<bool> has(species, false);
  for (std::size_t column = 0; column < columns.size(); ++column) {
    const std::string& name = columns.name(column);
    if (!name.starts_with("X_")) continue;
    const auto k = mechanism.findSpecies(name.substr(2));
    if (!k) {
      unknown.push_back(name.substr(2));
      continue;
    }
    if (has[*k]) throw InputError(fmt::format("two columns are called '{}'", name));
    has[*k] = true;
    const std::vector<double> values = columns.read(column, units::dimensionless);
    for (std::size_t row = 0; row < rows; ++row) history.fractions[row * species + *k] = values[row];
  }
  if (std::ranges::find(has, true) == has.end())
    throw InputError(
        fmt::format("expected columns of mole fractions, \"X_H2 [1]\", of species that the mechanism has; found {}",
                    columns.listed()));
  if (!history.numberLossRate.empty()) history.numberLossRate.pop_back();  // behind the last row there is nothing
  return history;
}

}  // namespace

GasHistory readGasTable(const std::filesystem::path& file, const Mechanism& mechanism) {
  const std::string text = readTextFile(file, "a history of a gas");
  std::vector<std::string> unknown;
  try {
    const TextTable table = readCsv(text);
    GasHistory history = historyOf(table, mechanism, unknown);
    for (const std::string& column : table.columns)
      if (nameAndUnit(column).first == formerLossRate)
        printWarnings(
            {fmt::format("{}: the column {} is called number_loss_rate since version {}; write the new name, as "
                         "version {} does not read the old one",
                         file.string(), formerLossRate, presentNamesBegin, formerNamesEnd)});
    if (!unknown.empty())
      printWarnings({fmt::format("{}: columns of species that the mechanism does not have are left out: {}",
                                 file.string(), fmt::join(unknown, ", "))});
    return history;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace lampblack::app
