// Messages quote what users wrote, and a damaged file may have a line, a name or a list of a hundred thousand letters.
#pragma once

#include <string>

namespace lampblack {

// A message as it is told: lines of more than a thousand bytes lose their middle, never within a UTF-8 character.
std::string withoutLongLines(const std::string& message);

}  // namespace lampblack
