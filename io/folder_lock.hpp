// One run at a time in a folder.
#pragma once

#include <filesystem>

#include "core/modules.hpp"

namespace lampblack::io {

// A lock on the folder itself (flock), held while this lives. The lock leaves no file behind and ends with the process,
// however that ends. Between machines that share a disk it holds where their file system passes it on; a file system
// without locks gives none.
class FolderLock {
 public:
  // InputError that names the holder where another process has it.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace lampblack::io
