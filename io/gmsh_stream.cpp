#include "io/gmsh_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace lampblack::io {
namespace {

constexpr std::size_t longestGmshWord = 200;  // bytes; a number has about 25
constexpr std::size_t longestGmshLine = 4096;

bool isGmshSpace(char c) {
  return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

}  // namespace

std::string quotedForMessage(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string shown(text.substr(0, longest));
  for (char& c : shown)
    if (c < ' ' || c > '~') c = '?';
  return "'" + shown + (text.size() > longest ? "...'" : "'");
}

GmshStream::GmshStream(const std::filesystem::path& path, std::size_t buffer)
    : name_(path.string()), buffer_(std::max(buffer, longestGmshWord + 56)) {
  static_assert(std::endian::native == std::endian::little, "binary files are read as they are");
  namespace fs = std::filesystem;
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  if (!fs::exists(status)) throw fileError("there is no such file; expected a mesh of Gmsh");
  if (!fs::is_regular_file(status)) throw fileError("this is no regular file; expected a mesh of Gmsh");
  size_ = static_cast<std::int64_t>(fs::file_size(path, failure));
  file_.open(path, std::ios::binary);
  if (failure || !file_) throw fileError("the file cannot be read");
}

InputError GmshStream::error(const std::string& message) const {
  std::string place = name_;
  place += encoding.binary ? fmt::format(", byte {}", markedOffset_) : fmt::format(", line {}", markedLine_);
  if (!section.empty()) place += ", section $" + section;
  return InputError(place + ": " + message);
}

InputError GmshStream::fileError(const std::string& message) const {
  return InputError(name_ + ": " + message);
}

InputError GmshStream::endedEarly(const char* what) const {
  return error(fmt::format("the file ends where {} is expected; it was cut off: save or copy it again", what));
}

InputError GmshStream::tooMany(const char* what, std::int64_t count) const {
  return error(
      fmt::format("{} is {}, more than the {} bytes left in the file can hold; the file is damaged or was cut "
                  "off: save or copy it again",
                  what, count, remaining()));
}

bool GmshStream::refill(std::size_t bytes) {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(at_), buffer_.begin() + static_cast<std::ptrdiff_t>(end_),
            buffer_.begin());
  offset_ += static_cast<std::int64_t>(at_);
  end_ -= at_;
  at_ = 0;
  const std::int64_t left = size_ - offset_ - static_cast<std::int64_t>(end_);
  const auto wanted =
      static_cast<std::streamsize>(std::min<std::int64_t>(left, static_cast<std::int64_t>(buffer_.size() - end_)));
  if (wanted > 0) {
    file_.read(buffer_.data() + end_, wanted);
    if (file_.gcount() != wanted) throw fileError("the file cannot be read to its end");
    end_ += static_cast<std::size_t>(wanted);
  }
  return bytes <= end_;
}

void GmshStream::mark() {
  markedLine_ = line_;
  markedOffset_ = offset_ + static_cast<std::int64_t>(at_);
}

void GmshStream::skipSpace() {
  for (; have(1) && isGmshSpace(buffer_[at_]); ++at_)
    if (buffer_[at_] == '\n') ++line_;
}

bool GmshStream::atEnd() {
  skipSpace();
  mark();
  return !have(1);
}

std::string_view GmshStream::peek() {
  skipSpace();
  mark();
  std::size_t length = 0;
  while (length < longestGmshWord && have(length + 1) && !isGmshSpace(buffer_[at_ + length])) ++length;
  return {buffer_.data() + at_, length};
}

std::string_view GmshStream::word() {
  const std::string_view found = peek();
  if (found.size() == longestGmshWord)
    throw error("found " + quotedForMessage(found) + ", which is too long for a word");
  at_ += found.size();
  return found;
}

std::string GmshStream::line() {
  mark();
  std::string text;
  for (; have(1) && buffer_[at_] != '\n'; ++at_) {
    if (text.size() == longestGmshLine)
      throw error("found " + quotedForMessage(text) + ", which is too long for a line");
    text += buffer_[at_];
  }
  if (have(1)) {
    ++at_;
    ++line_;
  }
  while (!text.empty() && isGmshSpace(text.back())) text.pop_back();
  text.erase(0, static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), isGmshSpace) - text.begin()));
  return text;
}

std::int64_t GmshStream::textInteger(const char* what) {
  const std::string_view text = word();
  if (text.empty()) throw endedEarly(what);
  std::int64_t value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size())
    throw error(fmt::format("expected {}, a whole number, found {}", what, quotedForMessage(text)));
  return value;
}

std::int64_t GmshStream::integer(const char* what) {
  if (encoding.binary) return raw<std::int32_t>(what);
  const std::int64_t value = textInteger(what);
  if (value < std::numeric_limits<std::int32_t>::min() || value > std::numeric_limits<std::int32_t>::max())
    throw error(fmt::format("expected {}, found {}, which is too large", what, value));
  return value;
}

std::int64_t GmshStream::signedSize(const char* what) {
  if (!encoding.binary) return textInteger(what);
  if (encoding.sizeBytes == 4) return raw<std::uint32_t>(what);
  return raw<std::int64_t>(what);
}

std::int64_t GmshStream::size(const char* what) {
  const std::int64_t value = signedSize(what);
  if (value < 0) throw error(fmt::format("expected {}, 0 or more, found {}", what, value));
  return value;
}

std::int64_t GmshStream::count(const char* what) {
  const std::int64_t value = size(what);
  if (value > remaining()) throw tooMany(what, value);
  return value;
}

std::int64_t GmshStream::countLine(const char* what) {
  const std::int64_t value = textInteger(what);
  if (value < 0) throw error(fmt::format("expected {}, 0 or more, found {}", what, value));
  if (value > remaining()) throw tooMany(what, value);
  line();
  return value;
}

std::int64_t GmshStream::tag(const char* what) {
  const std::int64_t value = encoding.version40 || encoding.version2 ? integer(what) : size(what);
  if (value < 1) throw error(fmt::format("expected {}, 1 or more, found {}", what, value));
  return value;
}

double GmshStream::number(const char* what) {
  if (encoding.binary) return raw<double>(what);
  const std::string_view text = word();
  if (text.empty()) throw endedEarly(what);
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  // Beyond the range of doubles: zero or infinite.
  if (result.ec == std::errc::result_out_of_range) value = std::strtod(std::string(text).c_str(), nullptr);
  if (result.ec == std::errc::invalid_argument || result.ptr != text.data() + text.size())
    throw error(fmt::format("expected {}, a number, found {}", what, quotedForMessage(text)));
  return value;
}

double GmshStream::real(const char* what) {
  const double value = number(what);
  if (!std::isfinite(value)) throw error(fmt::format("expected {}, found {}", what, value));
  return value;
}

std::int32_t GmshStream::rawInt(const char* what) {
  return raw<std::int32_t>(what);
}

void GmshStream::skipSection() {
  mark();
  const std::string end = "\n$End" + section;
  std::size_t matched = 1;  // the section's own line has just ended
  for (; have(1); ++at_) {
    const char c = buffer_[at_];
    if (matched == end.size() && isGmshSpace(c)) return;
    if (c == '\n') ++line_;
    // The pattern's first character stands in it once.
    matched = matched < end.size() && c == end[matched] ? matched + 1 : (c == '\n' ? 1 : 0);
  }
  if (matched != end.size()) throw endedEarly(("$End" + section).c_str());
}

void GmshStream::endSection() {
  const std::string_view found = peek();
  if (found.empty()) throw endedEarly(("$End" + section).c_str());
  if (found != "$End" + section)
    throw error(
        fmt::format("expected $End{}, found {}; the section has more than its counts say, or the file is damaged",
                    section, quotedForMessage(found)));
  word();
}

}  // namespace lampblack::io
