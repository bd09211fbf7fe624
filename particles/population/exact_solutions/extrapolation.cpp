#include "particles/population/exact_solutions/extrapolation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace lampblack::particles::exact {
namespace {

constexpr std::size_t columns = 8;

// Gragg's rule with `count` (even) steps over h.
FourMoments midpoint(const MomentRates& rates, double time, double h, const FourMoments& y, std::size_t count) {
  const double step = h / static_cast<double>(count);
  FourMoments before = y, now = y;
  const FourMoments first = rates(time, y);
  for (std::size_t i = 0; i < 4; ++i) now[i] += step * first[i];
  for (std::size_t m = 1; m < count; ++m) {
    const FourMoments slope = rates(time + static_cast<double>(m) * step, now);
    for (std::size_t i = 0; i < 4; ++i) {
      const double next = before[i] + 2 * step * slope[i];
      before[i] = now[i];
      now[i] = next;
    }
  }
  return now;
}

}  // namespace

FourMoments extrapolated(const MomentRates& rates, double start, double end, FourMoments y) {
  double time = start, h = end - start;
  while (time < end) {
    h = std::min(h, end - time);
    if (!(time + h > time)) {
      throw NumericsError(fmt::format("the equations of the moments cannot be followed beyond t = {:.9g} s", time));
    }
    std::array<FourMoments, columns> table;
    double error = 0;
    for (std::size_t row = 0; row < columns; ++row) {
      FourMoments value = midpoint(rates, time, h, y, 2 * (row + 1));
      for (std::size_t column = 0; column < row; ++column) {  // Neville's scheme in the square of the step
        const double ratio = static_cast<double>(row + 1) / static_cast<double>(row - column);
        for (std::size_t i = 0; i < 4; ++i) {
          const double next = value[i] + (value[i] - table[column][i]) / (ratio * ratio - 1);
          table[column][i] = value[i];
          value[i] = next;
        }
      }
      table[row] = value;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const double scale = std::max(std::abs(y[i]), std::abs(table[columns - 1][i]));
      const double difference = std::abs(table[columns - 1][i] - table[columns - 2][i]);
      if (difference > 0) error = std::max(error, difference / scale);
      if (!std::isfinite(table[columns - 1][i])) error = HUGE_VAL;
    }
    if (error <= 1e-13) {
      time = h >= end - time ? end : time + h;
      y = table[columns - 1];
      h *= std::clamp(std::pow(1e-14 / std::max(error, 1e-30), 1 / 15.0), 0.7, 3.0);
    } else {
      h *= 0.4;
    }
  }
  return y;
}

}  // namespace lampblack::particles::exact
