#include "core/stop_request.hpp"

#include <algorithm>
#include <array>
#include <csignal>

#include "core/errors.hpp"

namespace lampblack {
namespace {

volatile std::sig_atomic_t requested = 0;
volatile std::sig_atomic_t checkpointAsked = 0;

void note(int signal) {
  if (requested != 0) {  // asked twice: what a signal does to others
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  requested = signal;
}

[[noreturn]] void raiseStop(MPI_Comm comm, int signal, const std::string& cause, const std::string& where) {
  raiseCollectively(comm, std::make_exception_ptr(Stopped(signal, "stopped by " + cause + " " + where)));
  throw std::logic_error("a stop that was not raised");
}

}  // namespace

void watchForSignals() {
  requested = 0;
  std::signal(SIGTERM, note);
  std::signal(SIGINT, note);
  std::signal(SIGXFSZ, SIG_IGN);
}

void watchForCheckpointSignal() {
  std::signal(SIGUSR1, [](int) { checkpointAsked = 1; });
}

bool takeCheckpointSignal() {
  const bool asked = checkpointAsked != 0;
  checkpointAsked = 0;
  return asked;
}

int stopRequest() {
  return requested;
}

int agreedStopRequest(MPI_Comm comm) {
  return agreedStopRequest(comm, {});
}

int agreedStopRequest(MPI_Comm comm, std::span<int> others) {
  std::array<int, 5> values{requested};
  if (others.size() >= values.size()) throw std::logic_error("agreedStopRequest: too many values");
  std::ranges::copy(others, values.begin() + 1);
  MPI_Allreduce(MPI_IN_PLACE, values.data(), 1 + static_cast<int>(others.size()), MPI_INT, MPI_MAX, comm);
  std::copy_n(values.begin() + 1, others.size(), others.begin());
  const int signal = values[0];
  if (signal != 0) requested = signal;
  return signal;
}

std::string signalName(int signal) {
  return signal == SIGINT ? "SIGINT" : signal == SIGTERM ? "SIGTERM" : "signal " + std::to_string(signal);
}

void raiseStopped(MPI_Comm comm, int signal, const std::string& where) {
  raiseStop(comm, signal, signalName(signal), where);
}

void raiseStopped(MPI_Comm comm, const std::string& cause, const std::string& where) {
  raiseStop(comm, SIGTERM, cause, where);
}

}  // namespace lampblack
