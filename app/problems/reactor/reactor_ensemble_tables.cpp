#include "app/problems/reactor/reactor_ensemble_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>

namespace lampblack::app {

void EnsembleTables::take(const StochasticPopulation& population, std::span<const double> row) {
  if (taken_.size() == populations_.tablesAt.size()) return;
  const double wanted = populations_.tablesAt[taken_.size()];
  if (row[0] < wanted * (1 - 1e-9)) return;
  taken_.push_back({{row.begin(), row.end()}, population.tables()});
}

void EnsembleTables::write(ResultsWriter& results) const {
  if (populations_.tablesAt.empty()) return;
  // Ranks without values know what there is by a population without particles.
  const std::vector<StochasticPopulation::Table> empty = populations_.make(0)->tables();
  for (std::size_t i = 0; i < populations_.tablesAt.size(); ++i) {
    const std::string group = fmt::format("/particles/tables/{}/", i);
    const bool has = i < taken_.size();
    results.table(group + "row", columns_, has ? taken_[i].row : std::vector<double>{});
    for (std::size_t t = 0; t < empty.size(); ++t) {
      const StochasticPopulation::Table& table = has ? taken_[i].tables[t] : empty[t];
      for (const auto& column : table.columns)
        std::visit(
            [&, path = group + table.name + "/" + column.name](const auto& values) {
              results.dataset(path, {static_cast<std::int64_t>(values.size())}, std::span(values), column.unit,
                              column.description);
            },
            column.values);
    }
    results.attribute(group.substr(0, group.size() - 1), columns_[0].name, populations_.tablesAt[i]);
    results.attribute(group.substr(0, group.size() - 1), "repeat", std::int64_t{1});
  }
}

}  // namespace lampblack::app
