// The command line of the program, carried out again and again in one process, or on the ranks of one launcher, for
// tests that ask for it some hundred times: starting MPI and 106 libraries costs more than reading a deck.
//
// A request comes on standard input of the first rank: the number of bytes that follow and a line feed, then words with
// a zero byte at the end of each: the working folder, the files for standard output and for standard error (both are
// appended to), and the arguments. The answer on standard output is a line "<exit code> <state>": the largest exit code
// of the ranks; state 0 where the process is as it was before the request, and 1 where something is left of it (open
// files, signal handlers, options of PETSc), after which the client starts another server. The end of standard input
// ends the server. An error of some ranks only aborts it: its exit code is that of the request then.
#include <fcntl.h>
#include <hdf5.h>
#include <mpi.h>
#include <petscsys.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "app/shell/command_line.hpp"
#include "core/parallel_session.hpp"
#include "core/stop_request.hpp"

namespace {

namespace fs = std::filesystem;

// Moves a standard stream of the process to another descriptor, which other programs do not get, and leaves /dev/null
// in its place.
int moved(int stream, int flags) {
  const int kept = fcntl(stream, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  const int nothing = open("/dev/null", flags | O_CLOEXEC);
  if (kept < 0 || nothing < 0 || dup2(nothing, stream) < 0) throw std::runtime_error("program_server: no descriptors");
  close(nothing);
  return kept;
}

// What a request may leave behind in a process.
class ProcessState {
 public:
  ProcessState() : options_(petscOptions()), files_(openFiles()) {
    for (std::size_t i = 1; i < actions_.size(); ++i) sigaction(static_cast<int>(i), nullptr, &actions_[i]);
    umask_ = umask(0);
    umask(umask_);
  }

  // Puts back what can be put back; whether all is as it was.
  [[nodiscard]] bool restore() const {
    for (std::size_t i = 1; i < actions_.size(); ++i) sigaction(static_cast<int>(i), &actions_[i], nullptr);
    static_cast<void>(lampblack::takeCheckpointSignal());
    umask(umask_);
    return petscOptions() == options_ && openFiles() == files_ && H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL) == 0;
  }

 private:
  static std::string petscOptions() {
    char* text = nullptr;
    if (PetscOptionsGetAll(nullptr, &text) != 0) return "cannot be read";
    std::string options = text;
    static_cast<void>(PetscFree(text));
    return options;
  }

  // Files and folders that are open, by name and how often.
  static std::map<std::string, int> openFiles() {
    std::map<std::string, int> names;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator("/proc/self/fd", error)) {
      const std::string name = fs::read_symlink(entry.path(), error).string();
      if (name.starts_with('/') && !name.starts_with("/dev/") && !name.starts_with("/proc/")) ++names[name];
    }
    return names;
  }

  std::string options_;
  std::map<std::string, int> files_;
  std::array<struct sigaction, SIGSYS + 1> actions_{};
  mode_t umask_ = 0;
};

std::atomic<bool> carriesOut = false;

// Ends the process where the client is gone in the middle of a request: nobody waits for its end.
void endWithClient(int input) {
  pollfd watched{input, 0, 0};
  while (poll(&watched, 1, -1) < 0 && errno == EINTR) continue;
  if (carriesOut) _exit(1);
}

// Nothing at the end of the input.
std::string readRequest(std::FILE* input) {
  std::size_t size = 0;
  if (std::fscanf(input, "%zu", &size) != 1 || std::fgetc(input) != '\n') return {};
  std::string request(size, '\0');
  return std::fread(request.data(), 1, size, input) == size ? request : std::string();
}

// Collective. Ranks that wait for the first sleep, where MPI_Bcast would keep a processor busy.
std::string requestForAll(std::FILE* input, int rank) {
  std::string request = rank == 0 ? readRequest(input) : std::string();
  unsigned long size = request.size();
  MPI_Request sent = MPI_REQUEST_NULL;
  MPI_Ibcast(&size, 1, MPI_UNSIGNED_LONG, 0, MPI_COMM_WORLD, &sent);
  auto pause = std::chrono::microseconds(10);
  for (int arrived = 0; MPI_Test(&sent, &arrived, MPI_STATUS_IGNORE), arrived == 0;) {
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::microseconds(1000));
  }
  request.resize(size);
  MPI_Bcast(request.data(), static_cast<int>(size), MPI_CHAR, 0, MPI_COMM_WORLD);
  return request;
}

void writeTo(int stream, const char* file) {
  const int target = open(file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (target < 0) throw std::runtime_error(std::string("program_server: cannot open ") + file);
  dup2(target, stream);
  close(target);
}

void flushAll() {
  std::cout.flush();
  std::cerr.flush();
  std::fflush(nullptr);
  std::cout.clear();
  std::cerr.clear();
  std::clearerr(stdout);
  std::clearerr(stderr);
}

// What `main` does, between redirecting the streams and taking that back; `errors`: where the server's own messages go.
int carryOut(std::string request, int errors) {
  std::string name = "lampblack";
  std::vector<char*> words;
  for (std::size_t start = 0; start < request.size(); start = request.find('\0', start) + 1)
    words.push_back(&request[start]);
  if (words.size() < 3) throw std::runtime_error("program_server: a request has a folder and two files at least");
  fs::current_path(words[0]);
  writeTo(STDOUT_FILENO, words[1]);
  writeTo(STDERR_FILENO, words[2]);
  std::vector<char*> arguments{name.data()};
  arguments.insert(arguments.end(), words.begin() + 3, words.end());
  const int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  const int code = lampblack::app::runCommandLine(count, arguments.data());
  flushAll();
  writeTo(STDOUT_FILENO, "/dev/null");
  dup2(errors, STDERR_FILENO);
  return code;
}

}  // namespace

int main() {
  const int answers = moved(STDOUT_FILENO, O_WRONLY);
  const int errors = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  const int requests = moved(STDIN_FILENO, O_RDONLY);
  std::FILE* input = fdopen(requests, "r");
  const lampblack::ParallelSession session;
  const int rank = lampblack::placeOfProcess().rank;
  const ProcessState before;
  if (rank == 0) std::thread(endWithClient, requests).detach();
  for (std::string request; !(request = requestForAll(input, rank)).empty();) {
    carriesOut = true;
    const int code = carryOut(request, errors);
    carriesOut = false;
    std::array<int, 2> answer{code, before.restore() ? 0 : 1};
    MPI_Allreduce(MPI_IN_PLACE, answer.data(), 2, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    if (rank == 0) dprintf(answers, "%d %d\n", answer[0], answer[1]);
  }
  return 0;
}
