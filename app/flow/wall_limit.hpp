// When a run has to stop so that its results and a checkpoint are on disk before its wall time is over: judged by what
// its longest step, its outputs and its last checkpoint took.
#pragma once

#include <algorithm>
#include <optional>

#include "core/modules.hpp"

namespace lampblack::app {

class WallLimit {
 public:
  // s; nothing: no limit.
  explicit WallLimit(std::optional<double> limit) : limit_(limit) {}

  // All of them in s. A step with what belongs to it, but for checkpoints.
  void stepTook(double seconds) { longestStep_ = std::max(longestStep_.value_or(0.0), seconds); }
  void outputTook(double seconds) { longestOutput_ = std::max(longestOutput_, seconds); }
  void checkpointTook(double seconds) { lastCheckpoint_ = seconds; }

  // Whether a further step could be one too many, `elapsed` after the start. Not before a step was made, so that runs
  // that go on from each other come to an end.
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

}  // namespace lampblack::app
