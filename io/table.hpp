// Tables of a run: each column once, with its unit, what it is, and its value of what a row is of.
//
//   const TableOf<FlameBudget> budgets{{{"in", "kg/m^2/s", "with the streams"}, [](const auto& b) { return b.in; }},
//   ...}; budgets.of(solution.budgets).write(results, "/budgets");
#pragma once

#include <mpi.h>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "core/quantity.hpp"
#include "io/json.hpp"
#include "io/results_writer.hpp"

namespace lampblack::io {

struct Table {
  std::vector<Quantity> columns;
  std::vector<double> rows = {};  // row-major

  [[nodiscard]] double last(std::size_t column) const { return rows[rows.size() - columns.size() + column]; }
  // Collective; the rows are those of rank 0.
  void write(ResultsWriter& results, const std::string& path) const { results.table(path, columns, rows); }
  // Collective: a history that is there as a whole, to this file of text and to the results.
  void writeHistory(MPI_Comm comm, const std::filesystem::path& path, ResultsWriter& results) const;
  // Fields "final_<column>" of the last row, from a column on.
  void recordLast(JsonWriter& json, std::size_t from = 1) const;
};

// Columns of a table whose rows are of so many things each.
template <typename... Of>
class TableOf {
 public:
  using Value = std::function<double(Of...)>;
  struct Column {
    Quantity quantity;
    Value value;
  };
  TableOf() = default;
  TableOf(std::initializer_list<Column> columns) : columns_(columns) {}

  void add(Quantity quantity, Value value) { columns_.push_back({std::move(quantity), std::move(value)}); }
  // Columns that come together.
  void add(const std::vector<Quantity>& quantities, std::function<void(Of..., std::vector<double>& row)> values) {
    together_.insert(together_.end(), quantities.begin(), quantities.end());
    values_.push_back(std::move(values));
  }

  // Those that come together stand behind the others.
  [[nodiscard]] std::vector<Quantity> columns() const {
    std::vector<Quantity> all;
    for (const Column& column : columns_) all.push_back(column.quantity);
    all.insert(all.end(), together_.begin(), together_.end());
    return all;
  }
  [[nodiscard]] std::vector<double> row(Of... of) const {
    std::vector<double> values;
    for (const Column& column : columns_) values.push_back(column.value(of...));
    for (const auto& together : values_) together(of..., values);
    return values;
  }
  // A row for each of these.
  template <typename Range>
  [[nodiscard]] Table of(const Range& range) const {
    Table table{columns()};
    for (const auto& one : range) {
      const std::vector<double> values = row(one);
      table.rows.insert(table.rows.end(), values.begin(), values.end());
    }
    return table;
  }

 private:
  std::vector<Column> columns_;
  std::vector<Quantity> together_;
  std::vector<std::function<void(Of..., std::vector<double>& row)>> values_;
};

// The text of an object with the fields that `write` gives a JsonWriter.
template <typename Write>
[[nodiscard]] std::string jsonObject(const Write& write) {
  JsonWriter json;
  json.beginObject();
  write(json);
  json.endObject();
  return json.text();
}

}  // namespace lampblack::io
