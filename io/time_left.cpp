#include "io/time_left.hpp"

#include <algorithm>

namespace lampblack::io {
namespace {

constexpr double enoughDone = 0.05;
constexpr std::size_t enoughReports = 20;
constexpr double samePace = 1.25;
constexpr std::size_t mostKept = 256;

}  // namespace

void TimeLeft::report(double elapsed, double done) {
  ++count_;
  // Of a long run every second report is enough, again and again; the first and the last stay.
  if (reports_.size() == mostKept) {
    for (std::size_t i = 1; 2 * i < mostKept; ++i) reports_[i] = reports_[2 * i];
    reports_.resize(mostKept / 2);
  }
  reports_.push_back({elapsed, done});
}

double TimeLeft::doneAt(double elapsed) const {
  const auto after = std::ranges::lower_bound(reports_.begin() + 1, reports_.end(), elapsed, {}, &Report::elapsed);
  if (after == reports_.end()) return reports_.back().done;
  const Report& before = *(after - 1);
  const double length = after->elapsed - before.elapsed;
  return length > 0 ? before.done + (after->done - before.done) * (elapsed - before.elapsed) / length : after->done;
}

double TimeLeft::doneIn(double begin, double end) const {
  return doneAt(end * reports_.back().elapsed) - doneAt(begin * reports_.back().elapsed);
}

std::optional<double> TimeLeft::seconds() const {
  const auto [elapsed, done] = reports_.back();
  const double before = doneIn(0.5, 0.75), last = doneIn(0.75, 1);
  const bool settled = count_ >= enoughReports && last <= samePace * before && before <= samePace * last;
  if (!(elapsed > 0) || !(last > 0) || (done < enoughDone && !settled)) return std::nullopt;
  return 0.25 * elapsed / last * (1 - done);
}

}  // namespace lampblack::io
