// Whether signals that were recorded together repeat themselves: their common period, found from how often they pass
// through the middle of their range, and held to be one where all of them are at any time what they were a period
// before.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::flow {

// A quantity over the times of the record.
struct RecordedSignal {
  std::vector<double> values;
  // Above zero, in the unit of the values: what varies by less than 1e-6 of it is constant, what varies by less than a
  // twentieth of what others do, each over its scale, does not count.
  double scale = 1.0;
};

struct Periodicity {
  double period = 0.0;  // in the unit of the times
  struct Range {
    double low = 0.0, high = 0.0;
  };
  std::vector<Range> ranges;  // of each signal, over the last period
};

// The shortest period (of nearly equal ones the one that fits best) that the end of the record has at least three of,
// with 16 times or more in each. Over the last two, no signal may differ from itself a period before by more than a
// twentieth of its range (between the times signals are linear). Times increase, each signal has a value a time
// (std::logic_error otherwise). Nothing where the signals do not repeat themselves, or none varies.
std::optional<Periodicity> periodicityOf(std::span<const double> times, std::span<const RecordedSignal> signals);

}  // namespace lampblack::flow
