#include "app/shell/other_programs.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <sstream>

#include "core/stop_request.hpp"
#include "core/system_error.hpp"

namespace lampblack::app {
namespace {

// As exec wants it; the words have to live as long.
std::vector<char*> pointersTo(const std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

bool isExecutable(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error) && access(path.c_str(), X_OK) == 0;
}

}  // namespace

std::optional<std::filesystem::path> findProgram(const std::string& name) {
  if (name.find('/') != std::string::npos)
    return isExecutable(name) ? std::optional<std::filesystem::path>(name) : std::nullopt;
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const auto found = std::filesystem::path(folder.empty() ? "." : folder) / name; isExecutable(found))
      return found;
  return std::nullopt;
}

int runQuietly(const std::vector<std::string>& words) {
  posix_spawn_file_actions_t actions;
  if (posix_spawn_file_actions_init(&actions) != 0) return -1;
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", stream == STDIN_FILENO ? O_RDONLY : O_WRONLY, 0);
  pid_t child = 0;
  const int started = posix_spawn(&child, words.front().c_str(), &actions, nullptr, pointersTo(words).data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (started != 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
  return WEXITSTATUS(status);
}

void replaceBy(const std::vector<std::string>& words) {
  std::cout.flush();
  execv(words.front().c_str(), pointersTo(words).data());
  throw SystemError(fmt::format("{}: cannot be started ({})", words.front(), std::strerror(errno)));
}

namespace {

std::vector<pid_t> childrenOf(pid_t process) {
  std::vector<pid_t> children;
  std::error_code error;
  for (const auto& task : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task", error)) {
    std::ifstream file(task.path() / "children");
    for (pid_t child = 0; file >> child;) children.push_back(child);
  }
  return children;
}

// Among the descendants of a process those that run this executable.
std::vector<pid_t> ranksUnder(pid_t process) {
  std::error_code error;
  const auto own = std::filesystem::read_symlink("/proc/self/exe", error);
  std::vector<pid_t> ranks;
  for (const pid_t child : childrenOf(process)) {
    if (std::filesystem::read_symlink("/proc/" + std::to_string(child) + "/exe", error) == own) {
      ranks.push_back(child);
    } else {
      const auto below = ranksUnder(child);
      ranks.insert(ranks.end(), below.begin(), below.end());
    }
  }
  return ranks;
}

// False where there is nobody.
bool passOn(int signal, pid_t program) {
  const auto ranks = ranksUnder(program);
  for (const pid_t rank : ranks) kill(rank, signal);
  return !ranks.empty();
}

// Holds signals back for sigwait while this lives.
class HeldSignals {
 public:
  HeldSignals() {
    sigemptyset(&set_);
    for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGUSR2, SIGCHLD}) sigaddset(&set_, signal);
    sigprocmask(SIG_BLOCK, &set_, &before_);
  }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  ~HeldSignals() { letGo(); }
  void letGo() const { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  // The next signal; 0 where none came within a time.
  [[nodiscard]] int wait(bool forever) const {
    constexpr timespec aWhile{0, 50'000'000};
    const int signal = forever ? sigwaitinfo(&set_, nullptr) : sigtimedwait(&set_, nullptr, &aWhile);
    return std::max(signal, 0);
  }

 private:
  sigset_t set_{}, before_{};
};

}  // namespace

int runForDescendants(const std::vector<std::string>& words) {
  std::cout.flush();
  const auto pointers = pointersTo(words);
  const HeldSignals held;
  const pid_t program = fork();
  if (program < 0) throw SystemError(fmt::format("{}: cannot be started ({})", words.front(), std::strerror(errno)));
  if (program == 0) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // it ends with this process
    held.letGo();
    execv(pointers.front(), pointers.data());
    constexpr int notStarted = 127;
    _exit(notStarted);
  }
  int waiting = stopRequest();  // one that came before the signals were held back
  int stop = 0;
  int status = 0;
  while (waitpid(program, &status, WNOHANG) != program) {
    // Where there are no descendants there will be some, or the program is about to end.
    if (waiting != 0 && passOn(waiting, program)) {
      if (waiting == SIGTERM || waiting == SIGINT) stop = waiting;
      waiting = 0;
    }
    const int signal = held.wait(waiting == 0);
    if (signal == SIGCHLD || signal == 0) continue;
    if (waiting != 0) kill(program, signal);  // asked twice
    waiting = signal;
  }
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  constexpr int ofLauncher = 1;  // where it has been stopped itself
  return stop != 0 && code == ofLauncher ? 128 + stop : code;
}

void setUnlessSet(const char* variable, const std::string& value) {
  constexpr int keepWhatIsSet = 0;
  setenv(variable, value.c_str(), keepWhatIsSet);
}

}  // namespace lampblack::app
