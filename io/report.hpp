// The closing report of a run: where the time went over stages and ranks, how evenly the work was spread, what a cell
// and step cost, and how much memory it took. Takes numbers that were already gathered; formats and does nothing else.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::io {

// Wall time of one stage of the step over the ranks, in s.
struct StageTime {
  std::string name;
  double minimum = 0.0;
  double average = 0.0;
  double maximum = 0.0;
};

// Load imbalance: cost of the busiest rank over the average of all ranks, without and with work sharing. 1: balanced.
struct Imbalance {
  std::string what;  // "chemistry"
  double before = 1.0;
  double after = 1.0;
};

struct ClosingReport {
  int ranks = 1;
  std::int64_t cells = 0;
  std::int64_t steps = 0;          // of this run
  std::int64_t earlierSteps = 0;   // before the checkpoint that it went on from
  double wallTime = 0.0;           // s
  double peakMemoryPerRank = 0.0;  // bytes, the largest of the ranks
  std::vector<StageTime> stages;
  std::vector<Imbalance> imbalances;
};

// The report as lines of text; what no stage claims is shown as "other".
std::string formatReport(const ClosingReport& report);

// "1.2 GiB", "340 MiB"; "2 h 03 min", "4 min 05 s", "3.21 s".
std::string formatBytes(double bytes);
std::string formatDuration(double seconds);

}  // namespace lampblack::io
