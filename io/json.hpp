// A small JSON writer: what the files of a run need and no more. Numbers are written so that they read back exactly;
// NaN and infinities, which JSON does not have, become null.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::io {

// Text in quotes with everything escaped that JSON wants escaped. Bytes that are not UTF-8 become U+FFFD.
std::string jsonString(std::string_view text);

// Writes nested objects and arrays with two blanks of indentation.
class JsonWriter {
 public:
  JsonWriter& beginObject() { return open('{'); }
  JsonWriter& endObject() { return close('}'); }
  JsonWriter& beginArray() { return open('['); }
  JsonWriter& endArray() { return close(']'); }
  JsonWriter& key(std::string_view name);

  JsonWriter& value(std::string_view text);
  JsonWriter& value(const char* text) { return value(std::string_view(text)); }
  JsonWriter& value(const std::string& text) { return value(std::string_view(text)); }
  JsonWriter& value(double number);
  JsonWriter& value(std::int64_t number);
  JsonWriter& value(std::uint64_t number);
  JsonWriter& value(int number) { return value(static_cast<std::int64_t>(number)); }
  JsonWriter& value(bool flag);
  JsonWriter& null();
  // JSON text made elsewhere; its lines are indented to fit.
  JsonWriter& raw(std::string_view json);

  template <typename T>
  JsonWriter& field(std::string_view name, const T& content) {
    key(name);
    return value(content);
  }

  // The text so far, which is whole when everything opened is closed.
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  JsonWriter& open(char bracket);
  JsonWriter& close(char bracket);
  void separate();
  void newLine();

  std::string text_;
  std::vector<bool> filled_;  // of each open object or array: has it an entry
  bool afterKey_ = false;
};

}  // namespace lampblack::io
