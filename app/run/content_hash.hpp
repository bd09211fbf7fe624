// What a checkpoint remembers of texts and files: whether they are the same.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "core/modules.hpp"

namespace lampblack::app {

// FNV-1a of 64 bits (Fowler, Noll, Vo 1991), of any number of pieces.
class ContentHash {
 public:
  void add(std::string_view piece) {
    for (const char c : piece) value_ = (value_ ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  }
  [[nodiscard]] std::string text() const { return fmt::format("{:016x}", value_); }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace lampblack::app
