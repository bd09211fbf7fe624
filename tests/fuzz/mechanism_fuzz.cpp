// The mechanism reader accepts a file or says what is wrong with it; nothing else.
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "chemistry/mechanism.hpp"
#include "core/errors.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string path =
      (std::filesystem::temp_directory_path() / ("mechanism_fuzz_" + std::to_string(getpid()) + ".yaml")).string();
  {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  try {
    (void)lampblack::Mechanism::fromFile(path);
  } catch (const lampblack::InputError&) {
  }
  std::filesystem::remove(path);
  return 0;
}
