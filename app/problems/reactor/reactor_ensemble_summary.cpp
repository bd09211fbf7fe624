#include "app/problems/reactor/reactor_ensemble_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace lampblack::app {

EnsembleSummary::EnsembleSummary(std::vector<Quantity> columns, const ReactorRepeatShape& shape,
                                 const std::vector<std::size_t>& late)
    : columns_(std::move(columns)),
      shape_(shape),
      values_(shape.rows * shape.columns),
      densities_(shape.rows * shape.densities) {
  for (const std::size_t column : late) late_.push_back({column, {}, {}});
}

std::vector<Quantity> EnsembleSummary::columnsWithErrors() const {
  std::vector<Quantity> all{columns_[0]};
  for (std::size_t c = 1; c < columns_.size(); ++c) addRepeatColumns(columns_[c], all);
  return all;
}

void EnsembleSummary::add(const ReactorRepeatNumbers<const double>& repeat) {
  ++repeats_;
  for (std::size_t row = 0; row < shape_.rows; ++row) {
    const auto columns = repeat.columns(row), densities = repeat.densities(row);
    for (std::size_t c = 0; c < columns.size(); ++c) values_[row * shape_.columns + c].add(columns[c]);
    for (std::size_t b = 0; b < densities.size(); ++b) densities_[row * shape_.densities + b].add(densities[b]);
  }
  const std::size_t rows = shape_.rows, half = rows / 2, quarter = rows - half / 2;
  for (Late& late : late_) {
    const auto over = [&](std::size_t first, std::size_t end) {
      double sum = 0;
      for (std::size_t row = first; row < end; ++row) sum += repeat.columns(row)[late.column];
      return sum / static_cast<double>(end - first);
    };
    late.mean.add(over(half, rows));
    late.drift.add(over(quarter, rows) - over(half, quarter));
  }
}

std::vector<double> EnsembleSummary::row(std::size_t row) const {
  const RepeatIntervals intervals(repeats_);
  std::vector<double> values{place(row)};
  for (std::size_t c = 1; c < columns_.size(); ++c) {
    const RunningMean& value = values_[row * shape_.columns + c];
    intervals.append(value.mean(), value.standardError(), values);
  }
  return values;
}

double EnsembleSummary::largest(const std::string& column) const {
  double most = 0;
  for (std::size_t c = 0; c < columns_.size(); ++c)
    for (std::size_t row = 0; columns_[c].name == column && row < shape_.rows; ++row)
      most = std::max(most, values_[row * shape_.columns + c].mean());
  return most;
}

void EnsembleSummary::record(JsonWriter& json, const std::vector<std::size_t>& recorded) const {
  if (!has()) return;
  for (const std::size_t c : recorded)
    json.field("final_" + columns_[c].name, last(c).mean())
        .field("final_" + columns_[c].name + "_error", last(c).standardError());
  for (const Late& late : late_) {
    const std::string& name = columns_[late.column].name;
    json.field("late_mean_" + name, late.mean.mean())
        .field("late_mean_" + name + "_error", late.mean.standardError())
        .field("late_drift_" + name, late.drift.mean());
  }
}

void EnsembleSummary::print(const std::vector<std::size_t>& shown) const {
  if (!has()) return;
  for (const std::size_t c : shown)
    fmt::print("{:<24} {:.6g} +- {:.2g} {}\n", columns_[c].name, last(c).mean(), last(c).standardError(),
               columns_[c].unit);
  for (const Late& late : late_)
    fmt::print("second half: {:<24} {:.6g} +- {:.2g}, its last quarter less the one before {:.2g}\n",
               columns_[late.column].name, late.mean.mean(), late.mean.standardError(), late.drift.mean());
}

}  // namespace lampblack::app
