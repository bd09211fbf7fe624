// How long a run will still take, once that can be said. The first steps of a run tell little: they are small and grow,
// so that time divided by share promises days for what takes minutes. Therefore the pace is that of the last quarter of
// the time so far. The time left counts as known when 5 % are done, or when after twenty reports the quarter before
// had the same pace within a fourth.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::io {

class TimeLeft {
 public:
  // After `elapsed` seconds the share `done`, 0 to 1, is behind. Both grow from report to report, from 0 and 0.
  void report(double elapsed, double done);
  // Seconds still to go; nothing while the pace is not known.
  [[nodiscard]] std::optional<double> seconds() const;

 private:
  struct Report {
    double elapsed = 0, done = 0;
  };
  [[nodiscard]] double doneAt(double elapsed) const;
  // Between two parts of the time so far, 0 to 1.
  [[nodiscard]] double doneIn(double begin, double end) const;

  std::vector<Report> reports_{{}};
  std::size_t count_ = 0;
};

}  // namespace lampblack::io
