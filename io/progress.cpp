#include "io/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "io/report.hpp"

namespace lampblack::io {
namespace {

constexpr double year = 365.0 * 86400;  // s

// Open MPI hands each rank a terminal of its own making, whatever the user's output is; then the launcher's output
// tells (on another node than the launcher's it is a pipe, which is right, too).
bool writesToTerminal() {
  if (isatty(STDOUT_FILENO) != 1) return false;
  if (std::getenv("OMPI_COMM_WORLD_RANK") == nullptr) return true;
  char target[256];
  const std::string output = fmt::format("/proc/{}/fd/1", getppid());
  const ssize_t size = readlink(output.c_str(), target, sizeof target);
  const std::string_view name(target, size > 0 ? static_cast<std::size_t>(size) : 0);
  return name.starts_with("/dev/pts/") || name.starts_with("/dev/tty");
}

std::ostream* rankZeroOutput(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank == 0 ? &std::cout : nullptr;
}

}  // namespace

Progress::Progress(MPI_Comm comm, double start, double end, Clock::duration quiet)
    : out_(rankZeroOutput(comm)),
      terminal_(writesToTerminal()),
      start_(start),
      end_(end),
      quiet_(quiet),
      begun_(Clock::now()),
      last_(begun_) {}

Progress::Progress(std::ostream& out, bool terminal, double start, double end, Clock::time_point now,
                   Clock::duration quiet)
    : out_(&out), terminal_(terminal), start_(start), end_(end), quiet_(quiet), begun_(now), last_(now) {}

double Progress::done() const {
  const double span = end_ - start_;
  return span > 0.0 ? std::clamp((at_ - start_) / span, 0.0, 1.0) : 1.0;
}

std::string Progress::line() const {
  std::string text = fmt::format("{}  {:5.1f} %", where_, 100.0 * done());
  const auto left = left_.seconds();
  if (left && done() < 1.0) text += "  to go " + (*left < year ? formatDuration(*left) : "more than a year");
  if (!extras_.empty()) text += "  " + extras_;
  return text;
}

void Progress::print(Clock::time_point now) {
  const std::string text = line();
  if (terminal_) {
    // The line before may have been longer: cover what is left of it.
    *out_ << '\r' << text << std::string(width_ > text.size() ? width_ - text.size() : 0, ' ');
    width_ = text.size();
  } else {
    *out_ << text << '\n';
  }
  out_->flush();
  last_ = now;
  printed_ = true;
  pending_ = false;
}

void Progress::update(std::int64_t step, double time, double dt, const std::string& extras, Clock::time_point now) {
  say(fmt::format("step {:>6}  t {:.4g} s  dt {:.3g} s", step, time, dt), time, extras, now);
}

void Progress::say(const std::string& where, double at, const std::string& extras, Clock::time_point now) {
  if (out_ == nullptr) return;
  at_ = at;
  left_.report(std::chrono::duration<double>(now - begun_).count(), done());
  if (now - begun_ < quiet_) return;
  where_ = where;
  extras_ = extras;
  pending_ = true;
  if (due(now)) print(now);
}

bool Progress::due(Clock::time_point now) const {
  if (out_ == nullptr || now - begun_ < quiet_) return false;
  return !printed_ || now - last_ >= (terminal_ ? terminalInterval : logInterval);
}

void Progress::finish(Clock::time_point now) {
  if (out_ == nullptr) return;
  if (pending_) print(now);
  if (terminal_ && width_ > 0) *out_ << std::endl;
  width_ = 0;
}

}  // namespace lampblack::io
