// Decides when a run has to stop so that its results and a checkpoint are on disk before its wall time is over, from
// the durations of its longest step, its outputs and its last checkpoint.
#pragma once

#include <algorithm>
#include <optional>

#include "core/modules.hpp"

namespace lampblack {

class WallLimit {
 public:
  // s; nothing: no limit.
  explicit WallLimit(std::optional<double> limit) : limit_(limit) {}

  // Durations, s. A step includes its outputs, but not its checkpoints.
  void recordStep(double seconds) { longestStep_ = std::max(longestStep_.value_or(0.0), seconds); }
  void recordOutput(double seconds) { longestOutput_ = std::max(longestOutput_, seconds); }
  void recordCheckpoint(double seconds) { lastCheckpoint_ = seconds; }

  // Whether a further step could exceed the limit, `elapsed` (s) after the start. False before the first step, so that
  // each of several runs in sequence makes progress.
  [[nodiscard]] bool isNear(double elapsed) const {
    if (!limit_ || !longestStep_) return false;
    // No step or file takes just as long as those before it, and files have to be closed, and the program to end.
    constexpr double margin = 1.5, end = 1.0;
    // A checkpoint has as much as an output, at least, and as long as none was written nobody knows better.
    const double closing = std::max(lastCheckpoint_, longestOutput_) + longestOutput_;
    return elapsed + margin * (*longestStep_ + closing) + end >= *limit_;
  }

 private:
  std::optional<double> limit_, longestStep_;
  double longestOutput_ = 0.0, lastCheckpoint_ = 0.0;
};

}  // namespace lampblack
