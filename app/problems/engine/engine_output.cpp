#include "app/problems/engine/engine_output.hpp"

#include <cmath>

#include "app/run/repeat_columns.hpp"

namespace lampblack::app {

std::vector<Quantity> engineColumns(const std::vector<Quantity>& quantities, std::uint64_t repeats) {
  if (repeats == 1) return quantities;
  std::vector<Quantity> columns;
  for (const Quantity& quantity : quantities) addRepeatColumns(quantity, columns);
  return columns;
}

std::vector<double> engineMeans(std::span<const double> repeats, std::size_t width, std::uint64_t count) {
  if (count == 1) return {repeats.begin(), repeats.end()};
  const RepeatIntervals intervals(count);
  const auto n = static_cast<double>(count);
  std::vector<double> all;
  for (std::size_t q = 0; q < width; ++q) {
    double mean = 0, squares = 0;
    for (std::size_t r = 0; r < count; ++r) mean += repeats[r * width + q] / n;
    for (std::size_t r = 0; r < count; ++r) squares += std::pow(repeats[r * width + q] - mean, 2);
    intervals.append(mean, std::sqrt(squares / (n * (n - 1))), all);
  }
  return all;
}

std::vector<Quantity> engineHistoryColumns(const EngineCase& made) {
  std::vector<Quantity> columns{{"angle", "deg", "crank angle from the upper dead centre"},
                                {"time", "s", "time since the inlet has closed"}};
  for (const Quantity& column : engineColumns(engineQuantities(made), made.repeats)) columns.push_back(column);
  return columns;
}

std::vector<double> engineHistory(const EngineCase& made, std::span<const double> repeats) {
  const std::vector<double> angles = made.angles();
  const std::size_t width = engineQuantities(made).size(), all = repeats.size() / made.repeats;
  std::vector<double> history, values;
  for (std::size_t row = 0; row < angles.size(); ++row) {
    values.clear();
    for (std::size_t r = 0; r < made.repeats; ++r) {
      const auto from = repeats.begin() + static_cast<std::ptrdiff_t>(r * all + row * width);
      values.insert(values.end(), from, from + static_cast<std::ptrdiff_t>(width));
    }
    history.insert(history.end(), {angles[row], made.timeOf(angles[row])});
    const std::vector<double> means = engineMeans(values, width, made.repeats);
    history.insert(history.end(), means.begin(), means.end());
  }
  return history;
}

void recordEngine(JsonWriter& json, const EngineCase& made, std::span<const double> summaries, bool isConverged) {
  const std::vector<Quantity> quantities = engineSummaryQuantities(made);
  const std::vector<Quantity> columns = engineColumns(quantities, made.repeats);
  const std::vector<double> means = engineMeans(summaries, quantities.size(), made.repeats);
  json.field("repeats", made.repeats);
  json.field("particles", static_cast<std::uint64_t>(made.particles));
  json.field("cycles_converged", isConverged);
  for (std::size_t c = 0; c < columns.size(); ++c) json.field(columns[c].name, means[c]);
}

}  // namespace lampblack::app
