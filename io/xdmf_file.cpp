#include "io/xdmf_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>

#include "io/disk_space.hpp"
#include "io/run_folder.hpp"

namespace lampblack::io {
namespace {

// 0, or the errno of what went wrong.
int writeAt(int file, std::string_view text, std::int64_t from) {
  while (!text.empty()) {
    const ssize_t count = pwrite(file, text.data(), text.size(), from);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(count));
    from += count;
  }
  return 0;
}

// The same; where it fails, the file ends with `tail` at `from` again: these bytes have their place on the disk.
int writeOver(int file, std::string_view tail, std::string_view text, std::int64_t from) {
  int error = writeAt(file, text, from);
  if (error == 0 && fsync(file) != 0) error = errno;
  if (error == 0) return 0;
  if (writeAt(file, tail, from) == 0) {
    const int ignored = ftruncate(file, from + static_cast<std::int64_t>(tail.size()));
    static_cast<void>(ignored);
  }
  return error;
}

}  // namespace

bool XdmfFile::isUnchanged() const {
  std::error_code error;
  const auto size = std::filesystem::file_size(path_, error);
  return !error && end_ > 0 && size == static_cast<std::uintmax_t>(end_);
}

std::size_t XdmfFile::update(const std::string& file, const std::vector<XdmfStep>& steps) {
  std::string text;
  if (file != file_ || steps.size() < told_ || !isUnchanged()) {
    text = xdmfText(file, mesh_, steps);
    writeFileAtomically(path_, text);
    end_ = static_cast<std::int64_t>(text.size());
  } else if (told_ < steps.size()) {
    for (std::size_t i = told_; i < steps.size(); ++i) text += xdmfStepText(file, mesh_, steps[i]);
    text += xdmfTail();
    const std::int64_t from = end_ - static_cast<std::int64_t>(xdmfTail().size());
    const int descriptor = open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) refuseWrite(path_, errno);
    const int error = writeOver(descriptor, xdmfTail(), text, from);
    close(descriptor);
    if (error != 0) refuseWrite(path_, error);
    end_ = from + static_cast<std::int64_t>(text.size());
  }
  file_ = file;
  told_ = steps.size();
  return text.size();
}

}  // namespace lampblack::io
