// A quantity over time: straight lines between points, constant before the first and after the last; one point where it
// does not change.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::chemistry {

struct EngineTable {
  std::vector<double> times, values;  // s; times rise

  [[nodiscard]] double at(double time) const {
    const auto k = static_cast<std::size_t>(std::ranges::upper_bound(times, time) - times.begin());
    if (k == 0) return values.front();
    if (k == times.size()) return values.back();
    return values[k - 1] + (time - times[k - 1]) / (times[k] - times[k - 1]) * (values[k] - values[k - 1]);
  }
  // Over an interval, exactly.
  [[nodiscard]] double integral(double from, double to) const {
    double sum = 0;
    for (double now = from; now < to;) {
      const auto next = std::ranges::upper_bound(times, now);
      const double end = next == times.end() ? to : std::min(to, *next);
      sum += at(0.5 * (now + end)) * (end - now);
      now = end;
    }
    return sum;
  }
};

}  // namespace lampblack::chemistry
