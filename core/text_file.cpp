#include "core/text_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string_view>

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

void appendUtf8(std::string& text, char32_t c) {
  const auto tail = [&](int shift) { text += static_cast<char>(0x80U | ((c >> shift) & 0x3fU)); };
  if (c < 0x80) {
    text += static_cast<char>(c);
  } else if (c < 0x800) {
    text += static_cast<char>(0xc0U | (c >> 6));
    tail(0);
  } else if (c < 0x10000) {
    text += static_cast<char>(0xe0U | (c >> 12));
    tail(6), tail(0);
  } else {
    text += static_cast<char>(0xf0U | (c >> 18));
    tail(12), tail(6), tail(0);
  }
}

// Of pairs of bytes behind a byte-order mark; half a surrogate becomes U+FFFD.
std::string utf8OfUtf16(std::string_view bytes, bool littleEndian) {
  const auto unit = [&](std::size_t at) {
    const auto low = static_cast<unsigned char>(bytes[at + (littleEndian ? 0 : 1)]),
               high = static_cast<unsigned char>(bytes[at + (littleEndian ? 1 : 0)]);
    return static_cast<char32_t>(high << 8U | low);
  };
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t at = 2; at + 1 < bytes.size(); at += 2) {
    char32_t c = unit(at);
    if (c >= 0xd800 && c < 0xe000) {
      const char32_t next = at + 3 < bytes.size() ? unit(at + 2) : 0;
      const bool isPair = c < 0xdc00 && next >= 0xdc00 && next < 0xe000;
      c = isPair ? 0x10000 + ((c - 0xd800) << 10) + (next - 0xdc00) : 0xfffd;
      if (isPair) at += 2;
    }
    appendUtf8(text, c);
  }
  return text;
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
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) text = utf8OfUtf16(text, text.starts_with('\xff'));
  endLinesWithLineFeeds(text);
  return text;
}

}  // namespace lampblack
