#include "core/text_file.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/scratch.hpp"

namespace lampblack {
namespace {

std::string readBytes(const std::string& bytes) {
  const test::ScratchFolder folder;
  return readTextFile(folder.file("file", bytes), "a text");
}

// As Windows' shells and spreadsheets write: either order of bytes, characters of one to four bytes in UTF-8.
TEST(TextFile, Utf16IsReadAsUtf8) {
  const std::u16string text = u"T [\u00b0C]\r\n\u2212\U0001f525\n";
  std::string little("\xff\xfe"), big("\xfe\xff");
  for (const char16_t c : text) {
    const char low = static_cast<char>(c & 0xff), high = static_cast<char>(c >> 8);
    little += {low, high};
    big += {high, low};
  }
  const std::string expected =
      "T [\xc2\xb0"
      "C]\r\n\xe2\x88\x92\xf0\x9f\x94\xa5\n";
  EXPECT_EQ(readBytes(little), expected);
  EXPECT_EQ(readBytes(big), expected);
}

TEST(TextFile, HalfASurrogateAndHalfAUnitAreNoReadingBeyondTheEnd) {
  const std::string replacement = "\xef\xbf\xbd";
  EXPECT_EQ(readBytes(std::string("\xff\xfe\x3d\xd8", 4)), replacement);
  EXPECT_EQ(readBytes(std::string("\xff\xfe\x3d\xd8"
                                  "a\0",
                                  6)),
            replacement + "a");
  EXPECT_EQ(readBytes(std::string("\xff\xfe"
                                  "a\0b",
                                  5)),
            "a");
}

TEST(TextFile, AByteOrderMarkAndReturnsAloneAreNoText) {
  EXPECT_EQ(readBytes("\xef\xbb\xbf"
                      "a\rb\r\n"),
            "a\nb\r\n");
}

}  // namespace
}  // namespace lampblack
