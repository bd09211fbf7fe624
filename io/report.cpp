#include "io/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lampblack::io {

std::string formatBytes(double bytes) {
  const char* const units[] = {"B", "KiB", "MiB", "GiB", "TiB"};
  std::size_t unit = 0;
  while (bytes >= 1024.0 && unit + 1 < std::size(units)) {
    bytes /= 1024.0;
    ++unit;
  }
  if (bytes >= 1e5) return fmt::format("{:.3g} {}", bytes, units[unit]);
  return fmt::format("{:.{}f} {}", bytes, unit == 0 || bytes >= 100.0 ? 0 : 1, units[unit]);
}

std::string formatDuration(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0.0) return "?";
  if (seconds < 10.0) return fmt::format("{:.2f} s", seconds);
  if (seconds < 99.5) return fmt::format("{:.0f} s", seconds);
  if (seconds < 3600.0) {
    const auto whole = static_cast<long>(std::lround(seconds));
    return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  }
  const auto minutes = static_cast<long>(std::lround(seconds / 60.0));
  return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
}

namespace {

std::string stageRow(const std::string& name, double minimum, double average, double maximum, double total) {
  return fmt::format("  {:<24} {:>10.3f} {:>10.3f} {:>10.3f} {:>7.1f}\n", name, minimum, average, maximum,
                     total > 0.0 ? 100.0 * average / total : 0.0);
}

}  // namespace

std::string formatReport(const ClosingReport& report) {
  std::string text = fmt::format("\nTime by stage, s{:>21} {:>10} {:>10} {:>7}\n", "min", "average", "max", "%");
  std::vector<StageTime> stages = report.stages;
  std::stable_sort(stages.begin(), stages.end(),
                   [](const StageTime& a, const StageTime& b) { return a.average > b.average; });
  double claimed = 0.0;
  for (const StageTime& stage : stages) {
    claimed += stage.average;
    text += stageRow(stage.name, stage.minimum, stage.average, stage.maximum, report.wallTime);
  }
  const double other = std::max(0.0, report.wallTime - claimed);
  text += stageRow("other", other, other, other, report.wallTime);
  text += stageRow("total", report.wallTime, report.wallTime, report.wallTime, report.wallTime);
  if (!report.imbalances.empty()) {
    text += "\nLoad imbalance, busiest rank / average:  without sharing    with\n";
    for (const Imbalance& imbalance : report.imbalances) {
      text += fmt::format("  {:<38} {:>15.2f} {:>7.2f}\n", imbalance.what, imbalance.before, imbalance.after);
    }
  }
  const double cellSteps = static_cast<double>(report.cells) * static_cast<double>(report.steps);
  text += fmt::format("\n{} cells x {} steps on {} rank{} in {}", report.cells, report.steps, report.ranks,
                      report.ranks == 1 ? "" : "s", formatDuration(report.wallTime));
  if (report.wallTime > 0.0) text += fmt::format(": {:.4g} cell-steps/s", cellSteps / report.wallTime);
  if (report.earlierSteps > 0) text += fmt::format(", after {} steps before the restart", report.earlierSteps);
  text += fmt::format("\nPeak memory per rank: {}\n", formatBytes(report.peakMemoryPerRank));
  return text;
}

}  // namespace lampblack::io
