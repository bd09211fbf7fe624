// Names without regard to the case of their letters. Of ASCII alone: other bytes stay as they are.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace lampblack {

inline char lowerCase(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

inline std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower) letter = lowerCase(letter);
  return lower;
}

inline bool sameInAnyCase(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) { return lowerCase(x) == lowerCase(y); });
}

}  // namespace lampblack
