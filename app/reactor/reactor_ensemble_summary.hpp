// What the repeats of a run with ensembles come to: means of their rows and size distributions with the standard errors
// of these, and means over the late part of the time where something steady is looked for.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/rooms.hpp"
#include "io/history.hpp"
#include "io/json.hpp"

namespace lampblack::app {

class EnsembleSummary {
 public:
  // A repeat: its rows, and at each of them the size distributions of all reactors, one behind the other.
  struct Repeat {
    std::vector<std::vector<double>> rows, distributions;
  };
  // The mean of a column over the second half of the rows, and its last quarter less the one before.
  struct Late {
    std::size_t column = 0;
    double mean = 0, error = 0, drift = 0;
  };

  // Columns of a repeat's rows; the first has no error.
  explicit EnsembleSummary(std::vector<Quantity> columns) : columns_(std::move(columns)) {}

  [[nodiscard]] const std::vector<Quantity>& columns() const { return columns_; }
  // The same and their errors: those of rows().
  [[nodiscard]] std::vector<Quantity> columnsWithErrors() const;

  void add(Repeat repeat) { repeats_.push_back(std::move(repeat)); }
  [[nodiscard]] std::size_t repeats() const { return repeats_.size(); }
  // Of two repeats or more, all of the same number of rows; nothing otherwise. `late`: columns to average in time.
  void summarise(const std::vector<std::size_t>& late);

  [[nodiscard]] const std::vector<std::vector<double>>& rows() const { return rows_; }
  [[nodiscard]] const std::vector<std::vector<double>>& distributions() const { return distributions_; }
  [[nodiscard]] const std::vector<std::vector<double>>& distributionErrors() const { return distributionErrors_; }
  // The given columns at the end, and the late means.
  void record(JsonWriter& json, const std::vector<std::size_t>& recorded) const;
  void print(const std::vector<std::size_t>& shown) const;

 private:
  template <typename Value>
  std::pair<double, double> meanAndError(const Value& value) const;
  [[nodiscard]] Late late(std::size_t column) const;

  std::vector<Quantity> columns_;
  std::vector<Repeat> repeats_;
  std::vector<std::vector<double>> rows_, distributions_, distributionErrors_;
  std::vector<Late> late_;
};

}  // namespace lampblack::app
