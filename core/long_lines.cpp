#include "core/long_lines.hpp"

namespace lampblack {
namespace {

constexpr std::size_t longest = 1000, head = 700, tail = 250;

bool continuesCharacter(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

std::string cut(const std::string& line) {
  if (line.size() <= longest) return line;
  std::size_t end = head, again = line.size() - tail;
  while (end > 0 && continuesCharacter(line[end])) --end;
  while (again < line.size() && continuesCharacter(line[again])) ++again;
  return line.substr(0, end) + " ... " + line.substr(again);
}

}  // namespace

std::string withoutLongLines(const std::string& message) {
  std::string told;
  for (std::size_t start = 0;;) {
    const std::size_t end = message.find('\n', start);
    told += cut(message.substr(start, end - start));
    if (end == std::string::npos) return told;
    told += '\n';
    start = end + 1;
  }
}

}  // namespace lampblack
