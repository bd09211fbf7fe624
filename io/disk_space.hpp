// What becomes of a disk that fills up: space is claimed before it is written to, so that nothing is left half written,
// and what the system says of a failed write becomes an error that tells the user.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/modules.hpp"
#include "core/system_error.hpp"

namespace lampblack::io {

// Throws what the failure `error` (an errno) of writing to `path` means: SystemError where the disk is full (or the
// user's quota of it, or a limit on the size of a file is reached), otherwise InputError "<path>: cannot be written".
// `keeps` is told at the end of the message: what is still readable.
[[noreturn]] void refuseWrite(const std::filesystem::path& path, int error, const std::string& keeps = {});

// Makes sure that the bytes [from, end) of an existing file have their place on the disk; the file is at least `end`
// long then. Where the file system cannot promise that, the free space is looked at. refuseWrite() where it has none.
void claimSpace(const std::filesystem::path& path, std::int64_t from, std::int64_t end, const std::string& keeps = {});

// Space that is kept free for what has to be written last. The space belongs to a file without a name, so that nothing
// of it stays however the process ends.
class SpareSpace {
 public:
  // In the file system of `folder`. SystemError where the disk is too full.
  SpareSpace(const std::filesystem::path& folder, std::int64_t bytes);
  ~SpareSpace() { giveBack(); }
  SpareSpace(const SpareSpace&) = delete;
  SpareSpace& operator=(const SpareSpace&) = delete;

  void giveBack();

 private:
  int file_ = -1;
};

}  // namespace lampblack::io
