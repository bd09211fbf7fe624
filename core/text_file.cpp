#include "core/text_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "core/errors.hpp"

namespace lampblack {
namespace {

// Carriage returns that no line feed follows become line feeds; "\r\n" stays.
void endLinesWithLineFeeds(std::string& text) {
  for (std::size_t at = text.find('\r'); at != std::string::npos; at = text.find('\r', at)) {
    const std::size_t next = std::min(text.find_first_not_of('\r', at), text.size());
    if (next == text.size() || text[next] != '\n')
      std::fill_n(text.begin() + static_cast<std::ptrdiff_t>(at), next - at, '\n');
    at = next;
  }
}

}  // namespace

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
  endLinesWithLineFeeds(text);
  return text;
}

}  // namespace lampblack
