// SIGTERM and SIGINT ask a run to stop: it ends at the next safe point, keeps what it has, and exits with 128 plus the
// signal's number, as shells say it. A second signal ends the process at once.
#pragma once

#include <mpi.h>

#include <span>
#include <stdexcept>
#include <string>

namespace lampblack {

// A run that was asked to stop has stopped. The message says what is kept and where.
class Stopped : public std::runtime_error {
 public:
  Stopped(int signal, const std::string& message) : std::runtime_error(message), signal_(signal) {}
  [[nodiscard]] int signal() const { return signal_; }

 private:
  int signal_;
};

// From here on signals are noted. A file at its size limit (SIGXFSZ) makes the write fail rather than end the process.
void watchForSignals();

// The signal that asked this rank to stop, or 0.
int stopRequest();

// Collective: the signal that asked any rank to stop, or 0. From then on stopRequest() gives it on all of them.
int agreedStopRequest(MPI_Comm comm);
// The same, and in the same reduction each of `others` becomes its largest value on any rank. There are four at most.
int agreedStopRequest(MPI_Comm comm, std::span<int> others);

// From here on SIGUSR1 asks a run for a checkpoint; before, it ends the process as it does others.
void watchForCheckpointSignal();

// Whether this rank was asked for a checkpoint since the last call.
bool takeCheckpointSignal();

// "SIGTERM".
std::string signalName(int signal);

// Collective: raises Stopped on all ranks with the message "stopped by SIGTERM <where>".
[[noreturn]] void raiseStopped(MPI_Comm comm, int signal, const std::string& where);
// The same where it is not a signal that stops: "stopped by <cause> <where>". The run ends as one that SIGTERM stops.
[[noreturn]] void raiseStopped(MPI_Comm comm, const std::string& cause, const std::string& where);

}  // namespace lampblack
