// How far a run has come, from rank 0: one line that updates itself on a terminal, one line every few seconds in a log
// file. The time to go is said once it can be judged (TimeLeft).
#pragma once

#include <mpi.h>

#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <string>

#include "core/modules.hpp"
#include "io/time_left.hpp"

namespace lampblack::io {

class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  // Simulated time, or what else tells how far a run is, goes from `start` to `end`. Nothing is said in the first
  // `quiet` time, so that short runs need no line. Prints to standard output, which is asked whether it is a terminal.
  Progress(MPI_Comm comm, double start, double end, Clock::duration quiet = {});
  // The same on any stream; `now` is for tests.
  Progress(std::ostream& out, bool terminal, double start, double end, Clock::time_point now = Clock::now(),
           Clock::duration quiet = {});

  // Say where the run is; prints only when it is time to. `extras` is appended: "Tmax 2103 K  fv 0.31 ppm".
  void update(std::int64_t step, double time, double dt, const std::string& extras = {},
              Clock::time_point now = Clock::now());
  // The same in other words than those of a run in time: "swa, repeat 3 of 50". `at` lies between start and end.
  void say(const std::string& where, double at, const std::string& extras = {}, Clock::time_point now = Clock::now());
  // Whether a line would be printed: where the words cost more than the steps.
  [[nodiscard]] bool due(Clock::time_point now = Clock::now()) const;
  // Prints the last state in any case and ends the line. Before other output, too, so that lines do not mix.
  void finish(Clock::time_point now = Clock::now());

  static constexpr std::chrono::milliseconds terminalInterval{200};
  static constexpr std::chrono::milliseconds logInterval{5000};

 private:
  [[nodiscard]] double done() const;
  [[nodiscard]] std::string line() const;
  void print(Clock::time_point now);

  std::ostream* out_;  // nullptr on ranks other than 0
  bool terminal_;
  double start_;
  double end_;
  Clock::duration quiet_;
  Clock::time_point begun_;
  Clock::time_point last_;
  bool printed_ = false;
  bool pending_ = false;
  std::size_t width_ = 0;
  std::string where_;
  double at_ = 0.0;
  std::string extras_;
  TimeLeft left_;
};

}  // namespace lampblack::io
