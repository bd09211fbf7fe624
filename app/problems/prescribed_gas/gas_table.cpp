#include "app/problems/prescribed_gas/gas_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <string>
#include <vector>

#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "core/text_file.hpp"
#include "io/csv.hpp"
#include "io/deck_former_names.hpp"
#include "io/table_column.hpp"

namespace lampblack::app {
namespace {

struct Known {
  const char *name, *symbol;
  units::Dimension dimension;
  std::vector<double> GasHistory::*values;
  bool isNeeded = true;
};

std::vector<double> read(const TextTable& table, std::size_t column, const TableColumn& reader) {
  std::vector<double> values;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    values.push_back(reader.read(table.rows[row][column], table.lines[row]));
  return values;
}

constexpr const char* formerLossRate = "thinning";  // of the column number_loss_rate

GasHistory historyOf(const TextTable& table, const Mechanism& mechanism, std::vector<std::string>& unknown) {
  const Known known[] = {{"time", "t", units::time, &GasHistory::time},
                         {"temperature", "T", units::temperature, &GasHistory::temperature},
                         {"pressure", "p", units::pressure, &GasHistory::pressure},
                         {"number_loss_rate", formerLossRate, units::frequency, &GasHistory::numberLossRate, false}};
  GasHistory history;
  const std::size_t rows = table.rows.size(), species = mechanism.numSpecies();
  if (rows == 0) throw InputError("the table has no rows");
  history.fractions.assign(rows * species, 0.0);
  std::vector<bool> has(species, false);
  bool hasAny = false;
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    const auto [name, unit] = nameAndUnit(table.columns[column]);
    for (const Known& one : known) {
      if (name != one.name && name != one.symbol) continue;
      if (!(history.*one.values).empty())
        throw InputError(
            fmt::format("two columns are the {} ('{}' or '{}'); leave one out", one.name, one.name, one.symbol));
      history.*one.values = read(table, column, TableColumn(name, unit, one.dimension));
    }
    if (!name.starts_with("X_")) continue;
    const auto k = mechanism.findSpecies(name.substr(2));
    if (!k) {
      unknown.push_back(name.substr(2));
      continue;
    }
    if (has[*k]) throw InputError(fmt::format("two columns are called '{}'", name));
    hasAny = has[*k] = true;
    const std::vector<double> values = read(table, column, TableColumn(name, unit, units::dimensionless));
    for (std::size_t row = 0; row < rows; ++row) history.fractions[row * species + *k] = values[row];
  }
  for (const Known& one : known)
    if (one.isNeeded && (history.*one.values).empty())
      throw InputError(fmt::format("expected a column '{}' or '{}', as \"{} [{}]\"", one.name, one.symbol, one.name,
                                   one.name[0] == 't' ? (one.symbol[0] == 't' ? "s" : "K") : "Pa"));
  if (!history.numberLossRate.empty()) history.numberLossRate.pop_back();  // behind the last row there is nothing
  if (!hasAny) throw InputError("expected columns of mole fractions, \"X_H2 [1]\", of species that the mechanism has");
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
