#include "io/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

#include "core/errors.hpp"

namespace lampblack::io {
namespace {

// The process of this machine that holds a lock on the open folder, by the kernel's list of locks: lines like
// "1: FLOCK  ADVISORY  WRITE 708 00:2f:13364 0 EOF"; 0 where it is not there.
long holderOf(int folder) {
  struct stat found {};
  if (fstat(folder, &found) != 0) return 0;
  const std::string inode = fmt::format(":{}", found.st_ino);
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, manner, access, place;
    long process = 0;
    if (words >> number >> kind >> manner >> access >> process >> place && kind == "FLOCK" && place.ends_with(inode) &&
        process > 0)
      return process;
  }
  return 0;
}

// When a process started, from field 22 of its stat (proc(5)): clock ticks since the computer started.
std::optional<std::time_t> startOf(long process) {
  std::ifstream stat(fmt::format("/proc/{}/stat", process)), uptimeFile("/proc/uptime");
  std::string text;
  double uptime = 0, ticks = 0;
  if (!std::getline(stat, text) || !(uptimeFile >> uptime)) return std::nullopt;
  std::istringstream words(text.substr(text.rfind(')') + 1));  // the program's name may hold anything
  std::string word;
  for (int field = 3; field < 22; ++field) words >> word;
  if (!(words >> ticks)) return std::nullopt;
  return std::time(nullptr) - static_cast<std::time_t>(uptime - ticks / static_cast<double>(sysconf(_SC_CLK_TCK)));
}

std::string describe(long process) {
  if (process == 0) return "another process";
  char host[256] = "this machine";
  static_cast<void>(gethostname(host, sizeof host - 1));
  std::string text = fmt::format("process {} on {}", process, host);
  if (const auto start = startOf(process)) text += fmt::format(", since {:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(*start));
  return text;
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) {
  file_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file_ < 0) return;  // who may not read it will hear so when writing
  if (flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  const std::string holder = describe(holderOf(file_));
  close(file_);
  throw InputError(
      fmt::format("{}: a run is still going in this folder ({}). Wait for its end, stop it, or choose another folder "
                  "with --out",
                  folder.string(), holder));
}

FolderLock::~FolderLock() {
  if (file_ >= 0) close(file_);
}

}  // namespace lampblack::io
