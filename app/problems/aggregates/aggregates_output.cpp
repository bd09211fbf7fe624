#include "app/problems/aggregates/aggregates_output.hpp"

#include <cmath>

#include "app/run/repeat_columns.hpp"
#include "particles/aggregates/aggregates_repeat.hpp"

namespace lampblack::app {

Table aggregateHistory(const AggregatesCase& made, std::span<const double> repeats) {
  const std::size_t width = aggregateQuantities().size(), all = made.rows() * width;
  const auto count = static_cast<double>(made.repeats);
  const RepeatIntervals intervals(made.repeats);
  Table history{{{"time", "s", "time in the gas"}, {"temperature", "K", "gas temperature"}}};
  for (const Quantity& quantity : aggregateQuantities()) addRepeatColumns(quantity, history.columns);
  if (repeats.empty()) return history;
  for (std::size_t row = 0; row < made.rows(); ++row) {
    const double time = made.timeOf(row);
    history.rows.push_back(time);
    history.rows.push_back(made.gas.time.empty() ? std::nan("") : made.gas.at(time).temperature);
    for (std::size_t q = 0; q < width; ++q) {
      double mean = 0, squares = 0;
      for (std::size_t r = 0; r < made.repeats; ++r) mean += repeats[r * all + row * width + q] / count;
      for (std::size_t r = 0; r < made.repeats; ++r) {
        const double apart = repeats[r * all + row * width + q] - mean;
        squares += apart * apart;
      }
      intervals.append(mean, std::sqrt(squares / (count * (count - 1))), history.rows);
    }
  }
  return history;
}

void writeAggregates(ResultsWriter& results, const std::vector<SphereAggregate>& aggregates) {
  std::vector<double> rows;
  for (std::size_t a = 0; a < aggregates.size(); ++a)
    for (const AggregateSphere& s : aggregates[a].spheres())
      rows.insert(rows.end(), {static_cast<double>(a), s.centre[0], s.centre[1], s.centre[2], s.radius, s.volume,
                               static_cast<double>(s.parent), std::sqrt(s.neck)});
  results.table("/aggregates/spheres",
                {{"aggregate", "1", "number of the aggregate"},
                 {"x", "m", "centre, from the centre of mass"},
                 {"y", "m", "centre, from the centre of mass"},
                 {"z", "m", "centre, from the centre of mass"},
                 {"radius", "m", "radius"},
                 {"volume", "m^3", "what its necks leave of the sphere"},
                 {"partner", "1", "number, within the aggregate, of the sphere before it that it is joined to"},
                 {"neck", "m", "radius of that neck; of the first sphere zero, and in point contact"}},
                rows);
}

}  // namespace lampblack::app
