#include "io/disk_space.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/errors.hpp"
#include "io/report.hpp"

namespace lampblack::io {
namespace {

// 0, or the errno of what went wrong.
int claim(int file, std::int64_t from, std::int64_t end) {
  int error = 0;
  do {
    error = fallocate(file, 0, from, end - from) == 0 ? 0 : errno;
  } while (error == EINTR);
  if (error != EOPNOTSUPP && error != ENOSYS) return error;
  struct statvfs disk {};
  if (fstatvfs(file, &disk) != 0) return 0;
  const double free = static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize);
  return free < static_cast<double>(end - from) ? ENOSPC : 0;
}

std::string freeOn(const std::filesystem::path& path) {
  struct statvfs disk {};
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  if (statvfs(folder.c_str(), &disk) != 0) return "";
  return fmt::format(" ({} free)",
                     formatBytes(static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize)));
}

}  // namespace

void refuseWrite(const std::filesystem::path& path, int error, const std::string& keeps) {
  const std::string rest = keeps.empty() ? "" : ". " + keeps;
  if (error == ENOSPC || error == EDQUOT)
    throw SystemError(fmt::format("disk full: no room for {}{}{}{}. Make room, or choose a folder on another disk",
                                  path.string(), error == EDQUOT ? " in your quota" : "", freeOn(path), rest));
  if (error == EFBIG)
    throw SystemError(
        fmt::format("disk full: {} may not become larger: a limit on the size of files is reached (ulimit -f){}",
                    path.string(), rest));
  throw InputError(fmt::format("{}: cannot be written: {}{}", path.string(), std::strerror(error), rest));
}

void claimSpace(const std::filesystem::path& path, std::int64_t from, std::int64_t end, const std::string& keeps) {
  const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) refuseWrite(path, errno, keeps);
  const int error = claim(file, from, end);
  close(file);
  if (error != 0) refuseWrite(path, error, keeps);
}

SpareSpace::SpareSpace(const std::filesystem::path& folder, std::int64_t bytes) {
  std::string name = (folder / ".spare-XXXXXX").string();
  file_ = mkostemp(name.data(), O_CLOEXEC);
  if (file_ < 0) refuseWrite(folder, errno);
  unlink(name.c_str());
  if (const int error = claim(file_, 0, bytes); error != 0) {
    giveBack();
    refuseWrite(folder, error);
  }
}

void SpareSpace::giveBack() {
  if (file_ >= 0) close(file_);
  file_ = -1;
}

}  // namespace lampblack::io
