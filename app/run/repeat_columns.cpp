#include "app/run/repeat_columns.hpp"

#include "coupling/block_statistics.hpp"

namespace lampblack::app {

void addRepeatColumns(const Quantity& quantity, std::vector<Quantity>& columns) {
  const auto& [name, unit, description] = quantity;
  columns.push_back({name, unit, description + ", mean of the repeats"});
  columns.push_back({name + "_error", unit, "standard error of that mean"});
  columns.push_back({name + "_ci95", unit, "half width of its interval of 95 %"});
  columns.push_back({name + "_ci999", unit, "half width of its interval of 99.9 %"});
}

RepeatIntervals::RepeatIntervals(std::size_t repeats)
    : narrow_(studentQuantile(repeats - 1, 0.95)), wide_(studentQuantile(repeats - 1, 0.999)) {}

}  // namespace lampblack::app
