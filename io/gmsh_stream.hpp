// The bytes of a Gmsh mesh file (Geuzaine and Remacle 2009; the reference manual of Gmsh, "MSH file format"), as
// numbers: the same calls read the text encoding and the binary one. Holds one buffer of the file, never all of it.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/errors.hpp"
#include "core/modules.hpp"

namespace lampblack::io {

class GmshStream {
 public:
  struct Encoding {
    bool binary = false;
    bool version40 = false;  // else 4.1, or
    bool version2 = false;   // 2.0 to 2.2
    int sizeBytes = 8;       // of a size_t in a binary file: 4 or 8
  };

  // Opens the file. `buffer`: bytes read at once, at least 256. InputError where there is no such file.
  GmshStream(const std::filesystem::path& path, std::size_t buffer);

  Encoding encoding;    // of what follows
  std::string section;  // name of the section that is being read, for messages

  // What all numbers are read by; `what` says what is expected: "the tag of a node". InputError, with the place, where
  // there is something else, or where the file ends.
  std::int64_t integer(const char* what);  // an int of the format
  std::int64_t size(const char* what);     // a size_t of the format, 0 or more
  std::int64_t count(const char* what);    // the same where each thing counted takes a byte or more: refused when the
                                           // rest of the file cannot hold it
  std::int64_t signedSize(const char* what);
  std::int64_t tag(const char* what);  // of a node or an element: 1 or more
  double real(const char* what);       // finite
  double number(const char* what);     // whatever a double can be

  // Text in both encodings.
  std::int64_t textInteger(const char* what);
  std::int64_t countLine(const char* what);  // as count(), on a line of its own
  std::string_view word();                // up to white space; empty at the end of the file; valid until the next call
  std::string_view peek();                // the same word, which stays to be read
  std::string line();                     // the rest of the line, without white space around it
  bool atEnd();                           // whether nothing but white space is left; skips it
  std::int32_t rawInt(const char* what);  // four bytes of a binary file

  // Skips to behind the line "$End<section>", whatever stands before it. InputError where there is none.
  void skipSection();
  // The line "$End<section>" comes next. InputError where something else does.
  void endSection();

  // Bytes from here to the end of the file.
  [[nodiscard]] std::int64_t remaining() const { return size_ - offset_ - static_cast<std::int64_t>(at_); }

  // "mesh.msh, line 12, section $Nodes: <message>", with the place of what was read last.
  [[nodiscard]] InputError error(const std::string& message) const;
  // The same for what is wrong with the file as a whole.
  [[nodiscard]] InputError fileError(const std::string& message) const;
  [[nodiscard]] InputError endedEarly(const char* what) const;
  [[nodiscard]] InputError tooMany(const char* what, std::int64_t count) const;

 private:
  bool have(std::size_t bytes) { return at_ + bytes <= end_ || refill(bytes); }
  bool refill(std::size_t bytes);
  void skipSpace();
  void mark();
  template <typename T>
  T raw(const char* what) {
    mark();
    if (!have(sizeof(T))) throw endedEarly(what);
    T value;
    std::memcpy(&value, buffer_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }

  std::string name_;
  std::ifstream file_;
  std::vector<char> buffer_;
  std::int64_t size_ = 0;    // of the file
  std::int64_t offset_ = 0;  // in the file, of the buffer's first byte
  std::size_t at_ = 0, end_ = 0;
  std::int64_t line_ = 1, markedLine_ = 1, markedOffset_ = 0;
};

// What a file says, for a message: at most 40 bytes, those that cannot be printed as '?'.
std::string quotedForMessage(std::string_view text);

}  // namespace lampblack::io
