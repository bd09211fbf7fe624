// Columns of means over repeats, each with its standard error and the half widths of its intervals of 95 % and 99.9 %
// (Student's t), which overlap the truth in so many of a hundred cases.
#pragma once

#include <cstddef>
#include <vector>

#include "core/modules.hpp"
#include "core/quantity.hpp"

namespace lampblack::app {

// `<name>`, `<name>_error`, `<name>_ci95`, `<name>_ci999`.
void addRepeatColumns(const Quantity& quantity, std::vector<Quantity>& columns);

class RepeatIntervals {
 public:
  explicit RepeatIntervals(std::size_t repeats);  // two at least
  // The values of these columns.
  void append(double mean, double error, std::vector<double>& row) const {
    row.insert(row.end(), {mean, error, narrow_ * error, wide_ * error});
  }
  static constexpr std::size_t columns = 4;

 private:
  double narrow_, wide_;
};

}  // namespace lampblack::app
