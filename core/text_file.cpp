#include "core/text_file.hpp"

#include <fmt/format.h>

#include <fstream>

#include "core/errors.hpp"

namespace lampblack {

std::string readTextFile(const std::filesystem::path& path, const std::string& what, std::uintmax_t limit) {
  namespace fs = std::filesystem;
  const auto refusal = [&](const std::string& why) {
    return InputError(fmt::format("{}: {}; expected {}", path.string(), why, what));
  };
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw refusal("there is no such file");
  if (fs::is_directory(status)) throw refusal("this is a folder");
  if (!fs::is_regular_file(status)) throw refusal("this is no regular file (a pipe or a device?)");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw refusal("the file cannot be read: " + error.message());
  if (size > limit) throw refusal(fmt::format("the file has {} bytes, more than {}", size, limit));
  if (size == 0) throw refusal("the file is empty");
  std::string text(size, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(text.data(), static_cast<std::streamsize>(size));
  if (!file) throw refusal("the file cannot be read");
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  return text;
}

}  // namespace lampblack
