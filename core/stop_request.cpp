#include "core/stop_request.hpp"

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
  int signal = requested;
  MPI_Allreduce(MPI_IN_PLACE, &signal, 1, MPI_INT, MPI_MAX, comm);
  if (signal != 0) requested = signal;
  return signal;
}

std::string signalName(int signal) {
  return signal == SIGINT ? "SIGINT" : signal == SIGTERM ? "SIGTERM" : "signal " + std::to_string(signal);
}

void raiseStopped(MPI_Comm comm, int signal, const std::string& where) {
  raiseCollectively(comm, std::make_exception_ptr(Stopped(signal, "stopped by " + signalName(signal) + " " + where)));
  throw std::logic_error("a stop that was not raised");
}

}  // namespace lampblack
