#include "app/problems/prescribed_gas/gas_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "core/letter_case.hpp"
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

// What of a table is left out.
struct LeftOut {
  std::vector<std::string> species, columns;
};

// The name behind "X_" or "Y_", in letters of either case; none for other columns.
std::optional<std::string> nameBehind(std::string_view prefix, const std::string& column) {
  if (column.size() <= prefix.size() || !sameInAnyCase(column.substr(0, prefix.size()), prefix)) return std::nullopt;
  return column.substr(prefix.size());
}

GasHistory historyOf(const TextTable& table, const Mechanism& mechanism, LeftOut& leftOut) {
  const Known known[] = {
      {"time", "t", "t", units::time, &GasHistory::time},
      {"temperature", "T", "T", units::temperature, &GasHistory::temperature},
      {"pressure", "p", "P", units::pressure, &GasHistory::pressure},
      {"number_loss_rate", formerLossRate, formerLossRate, units::frequency, &GasHistory::numberLossRate, false}};
  const TableColumns columns(table);
  GasHistory history;
  const std::size_t rows = table.rows.size(), species = mechanism.numSpecies();
  if (rows == 0) throw InputError("the table has no rows");
  std::vector<bool> isKnown(columns.size(), false);
  for (const Known& one : known) {
    const auto column = columns.find({one.name, one.symbol, one.otherSymbol});
    if (column) {
      isKnown[*column] = true;
      history.*one.values = columns.read(*column, one.dimension);
    } else if (one.isNeeded)
      throw InputError(fmt::format("expected a column '{}' or '{}', as \"{} [{}]\"; found {}", one.name, one.symbol,
                                   one.name, units::siUnit(one.dimension), columns.listed()));
  }
  history.fractions.assign(rows * species, 0.0);
  std::vector<bool> has(species, false);
  for (std::size_t column = 0; column < columns.size(); ++column) {
    const std::string& name = columns.name(column);
    const auto called = nameBehind("X_", name);
    if (!called) {
      if (!isKnown[column]) leftOut.columns.push_back(name);
      continue;
    }
    const auto k = mechanism.findSpecies(*called);
    if (!k) {
      leftOut.species.push_back(*called);
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
  for (const std::string& name : leftOut.columns) {
    const auto called = nameBehind("Y_", name);
    const auto k = called ? mechanism.findSpecies(*called) : std::nullopt;
    if (k && !has[*k])
      throw InputError(
          fmt::format("the column '{}' is of mass fractions; write mole fractions, \"X_{} [1]\", or leave it "
                      "out",
                      name, *called));
  }
  if (!history.numberLossRate.empty()) history.numberLossRate.pop_back();  // behind the last row there is nothing
  return history;
}

}  // namespace

GasHistory readGasTable(const std::filesystem::path& file, const Mechanism& mechanism) {
  const std::string text = readTextFile(file, "a history of a gas");
  LeftOut leftOut;
  try {
    const TextTable table = readCsv(text);
    GasHistory history = historyOf(table, mechanism, leftOut);
    for (const std::string& column : table.columns)
      if (isColumnName(nameAndUnit(column).first, formerLossRate))
        printWarnings(
            {fmt::format("{}: the column {} is called number_loss_rate since version {}; write the new name, as "
                         "version {} does not read the old one",
                         file.string(), formerLossRate, presentNamesBegin, formerNamesEnd)});
    if (!leftOut.species.empty())
      printWarnings({fmt::format("{}: columns of species that the mechanism does not have are left out: {}",
                                 file.string(), fmt::join(leftOut.species, ", "))});
    if (!leftOut.columns.empty())
      printWarnings({fmt::format("{}: columns that are not known here are left out: {}; a mole fraction is X_<species>",
                                 file.string(), fmt::join(leftOut.columns, ", "))});
    return history;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace lampblack::app
