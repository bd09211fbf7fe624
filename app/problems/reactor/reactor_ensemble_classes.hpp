// Averages over the particles of a class, such as those between two diameters of collision: all repeats pooled, so that
// each particle counts alike (Shekar, Smith, Kraft, Wagner 2011, figure 14).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "app/problems/reactor/reactor_ensemble_columns.hpp"
#include "core/modules.hpp"
#include "core/running_mean.hpp"
#include "io/results_writer.hpp"
#include "io/run_folder.hpp"

namespace lampblack::app {

class EnsembleClasses {
 public:
  EnsembleClasses(const ReactorCase& reactorCase, const ReactorRepeatShape& shape);
  // Numbers of all classes of all reactors, of a row.
  [[nodiscard]] static std::size_t size(const ReactorCase& reactorCase);

  void add(const ReactorRepeatNumbers<const double>& repeat);
  // classes_<what>.csv of two repeats or more; `places` of the rows.
  void writeTables(const RunFolder& folder, const std::vector<double>& places) const;
  // Collective: the same tables, of rank 0, below /classes.
  void write(ResultsWriter& results, const std::vector<double>& places) const;

 private:
  // The classes by one quantity in one reactor.
  struct Sorted {
    std::string name;
    std::vector<double> edges;
    std::size_t first = 0;  // of a row's numbers
    std::vector<Quantity> columns;
    std::vector<RunningRatio> values;  // of the first row, of its first class, ...
  };
  [[nodiscard]] std::vector<double> rowsOf(const Sorted& sorted, const std::vector<double>& places) const;

  std::size_t rows_, averages_ = 0, repeats_ = 0;
  std::vector<Sorted> all_;
};

}  // namespace lampblack::app
