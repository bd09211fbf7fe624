// Where the checkout lies: tests read shipped cases, mechanisms and their own data from it.
#pragma once

#include <filesystem>
#include <string>

#include "tests/every_module.hpp"

namespace lampblack::test {

inline const std::filesystem::path sourceFolder{LAMPBLACK_SOURCE_DIR};

// Of a file named from the top of the checkout.
inline std::string sourcePath(const std::string& path) {
  return (sourceFolder / path).string();
}

}  // namespace lampblack::test
