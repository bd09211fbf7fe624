#include "app/reactor/reactor_ensemble_summary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace lampblack::app {

std::vector<Quantity> EnsembleSummary::columnsWithErrors() const {
  std::vector<Quantity> all = columns_;
  for (std::size_t c = 1; c < columns_.size(); ++c)
    all.push_back({columns_[c].name + "_error", columns_[c].unit, "standard error of the mean of the repeats"});
  return all;
}

// Mean of the repeats and its standard error.
template <typename Value>
std::pair<double, double> EnsembleSummary::meanAndError(const Value& value) const {
  const auto count = static_cast<double>(repeats_.size());
  double mean = 0, sum = 0;
  for (const Repeat& repeat : repeats_) mean += value(repeat) / count;
  for (const Repeat& repeat : repeats_) sum += std::pow(value(repeat) - mean, 2);
  return {mean, std::sqrt(sum / (count * (count - 1)))};
}

EnsembleSummary::Late EnsembleSummary::late(std::size_t column) const {
  const std::size_t rows = repeats_[0].rows.size(), half = rows / 2, quarter = rows - half / 2;
  const auto over = [&](std::size_t first, std::size_t last) {
    return meanAndError([&](const Repeat& r) {
      double sum = 0;
      for (std::size_t i = first; i < last; ++i) sum += r.rows[i][column];
      return sum / static_cast<double>(last - first);
    });
  };
  const auto [mean, error] = over(half, rows);
  return {column, mean, error, over(quarter, rows).first - over(half, quarter).first};
}

void EnsembleSummary::summarise(const std::vector<std::size_t>& late) {
  if (repeats_.size() < 2) return;
  for (std::size_t i = 0; i < repeats_[0].rows.size(); ++i) {
    std::vector<double> means, errors, distribution, distributionErrors;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const auto [mean, error] = meanAndError([&](const Repeat& r) { return r.rows[i][c]; });
      means.push_back(mean);
      if (c > 0) errors.push_back(error);
    }
    means.insert(means.end(), errors.begin(), errors.end());
    rows_.push_back(std::move(means));
    for (std::size_t b = 0; b < repeats_[0].distributions[i].size(); ++b) {
      const auto [mean, error] = meanAndError([&](const Repeat& r) { return r.distributions[i][b]; });
      distribution.push_back(mean);
      distributionErrors.push_back(error);
    }
    distributions_.push_back(std::move(distribution));
    distributionErrors_.push_back(std::move(distributionErrors));
  }
  for (const std::size_t column : late) late_.push_back(this->late(column));
}

void EnsembleSummary::record(JsonWriter& json, const std::vector<std::size_t>& recorded) const {
  if (rows_.empty()) return;
  const std::size_t n = columns_.size();
  for (const std::size_t c : recorded) {
    json.field("final_" + columns_[c].name, rows_.back()[c]);
    json.field("final_" + columns_[c].name + "_error", rows_.back()[n - 1 + c]);
  }
  for (const Late& late : late_) {
    const std::string& name = columns_[late.column].name;
    json.field("late_mean_" + name, late.mean)
        .field("late_mean_" + name + "_error", late.error)
        .field("late_drift_" + name, late.drift);
  }
}

void EnsembleSummary::print(const std::vector<std::size_t>& shown) const {
  if (rows_.empty()) return;
  for (const std::size_t c : shown)
    fmt::print("{:<24} {:.6g} +- {:.2g} {}\n", columns_[c].name, rows_.back()[c], rows_.back()[columns_.size() - 1 + c],
               columns_[c].unit);
  for (const Late& late : late_)
    fmt::print("second half: {:<24} {:.6g} +- {:.2g}, its last quarter less the one before {:.2g}\n",
               columns_[late.column].name, late.mean, late.error, late.drift);
}

}  // namespace lampblack::app
