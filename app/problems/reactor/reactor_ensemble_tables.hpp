// Every particle of the first repeat at chosen times or places, for results.h5: /particles/tables/<number>, from 0, in
// the order of the deck's rising list.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "app/problems/reactor/reactor_case.hpp"
#include "core/modules.hpp"
#include "core/quantity.hpp"
#include "io/results_writer.hpp"

namespace lampblack::app {

class EnsembleTables {
 public:
  // `columns`: of the history without errors. The populations have to live as long.
  EnsembleTables(const ReactorPopulations& populations, std::vector<Quantity> columns)
      : populations_(populations), columns_(std::move(columns)) {}

  // Offers the population as it stands at a row of its repeat, which begins with the place: kept if a table is wanted
  // there.
  void take(const StochasticPopulation& population, std::span<const double> row);
  // Collective; rank 0 has the values. Tables of moments that were not reached have no rows.
  void write(ResultsWriter& results) const;

 private:
  struct Taken {
    std::vector<double> row;
    std::vector<StochasticPopulation::Table> tables;
  };
  const ReactorPopulations& populations_;
  std::vector<Quantity> columns_;
  std::vector<Taken> taken_;
};

}  // namespace lampblack::app
