// Files a test writes: in a folder of its own, which no other process shares, gone at the end.
#pragma once

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "tests/every_module.hpp"

namespace lampblack::test {

// A new, empty folder in the machine's temporary one.
inline std::filesystem::path makeScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "lampblack_test_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    throw std::filesystem::filesystem_error("no folder for the test", name,
                                            std::error_code(errno, std::generic_category()));
  return name;
}

class ScratchFolder {
 public:
  ScratchFolder() = default;
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  // Writes a file into the folder and returns its path.
  [[nodiscard]] std::string file(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = path_ / name;
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
  }

 private:
  std::filesystem::path path_ = makeScratchFolder();
};

}  // namespace lampblack::test
