// What the repeats of a run with ensembles come to: means of their rows and distributions with standard errors, and
// means over the late part of the time where something steady is looked for.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/problems/reactor/reactor_ensemble_columns.hpp"
#include "app/run/repeat_columns.hpp"
#include "core/modules.hpp"
#include "core/running_mean.hpp"
#include "io/json.hpp"

namespace lampblack::app {

class EnsembleSummary {
 public:
  // The first of the columns has no error. `late`: those whose mean over the second half of the rows is told, and by
  // what its last quarter exceeds the one before.
  EnsembleSummary(std::vector<Quantity> columns, const ReactorRepeatShape& shape, const std::vector<std::size_t>& late);

  [[nodiscard]] const std::vector<Quantity>& columns() const { return columns_; }
  // The same and their errors: those of row().
  [[nodiscard]] std::vector<Quantity> columnsWithErrors() const;

  // In the order of the repeats.
  void add(const ReactorRepeatNumbers<const double>& repeat);
  [[nodiscard]] std::size_t repeats() const { return repeats_; }

  // There is something to tell of two repeats or more.
  [[nodiscard]] bool has() const { return repeats_ >= 2; }
  [[nodiscard]] std::size_t rows() const { return has() ? shape_.rows : 0; }
  [[nodiscard]] double place(std::size_t row) const { return values_[row * shape_.columns].mean(); }
  [[nodiscard]] std::vector<double> row(std::size_t row) const;
  // Of a row, the bins of all distributions of all reactors.
  [[nodiscard]] const RunningMean& density(std::size_t row, std::size_t bin) const {
    return densities_[row * shape_.densities + bin];
  }

  // Of the mean of the repeats of a column, over the rows; zero where there is no such column.
  [[nodiscard]] double largest(const std::string& column) const;
  // The given columns at the end, and the late means.
  void record(JsonWriter& json, const std::vector<std::size_t>& recorded) const;
  void print(const std::vector<std::size_t>& shown) const;

 private:
  struct Late {
    std::size_t column = 0;
    RunningMean mean, drift;
  };
  [[nodiscard]] const RunningMean& last(std::size_t column) const {
    return values_[(shape_.rows - 1) * shape_.columns + column];
  }

  std::vector<Quantity> columns_;
  ReactorRepeatShape shape_;
  std::size_t repeats_ = 0;
  std::vector<RunningMean> values_, densities_;  // of the first row, of the second, ...
  std::vector<Late> late_;
};

}  // namespace lampblack::app
