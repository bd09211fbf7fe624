#include "chemistry/chemkin/chemkin_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "core/errors.hpp"
#include "core/text_file.hpp"

namespace lampblack::chemistry {

namespace {

bool isBlank(char c) {
  return c == ' ' || c == '\t';
}

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

// What a comment line says, without a frame of marks around it.
std::string_view commentText(std::string_view line) {
  line = trimmed(line);
  while (!line.empty() && line.front() == '!') line.remove_prefix(1);
  while (!line.empty() && (line.back() == '!' || isBlank(line.back()))) line.remove_suffix(1);
  return line.starts_with(' ') ? line.substr(1) : line;
}

}  // namespace

ChemkinText loadChemkinText(const std::string& path) {
  return {path, readTextFile(path, "a mechanism or its data")};
}

ChemkinSource::ChemkinSource(const ChemkinText& file) : file_(file.name) {
  std::string_view rest = file.text;
  if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);  // byte order mark
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = rest.find_first_of("\r\n");
    const std::string_view line = rest.substr(0, end);
    if (end == std::string_view::npos)
      rest = {};
    else
      rest.remove_prefix(end + (rest.substr(end).starts_with("\r\n") ? 2 : 1));
    const std::size_t comment = line.find('!');
    std::string text(line.substr(0, comment));
    std::ranges::replace_if(
        text, [](char c) { return c == '\f' || c == '\v'; }, ' ');  // ends of printed pages
    while (!text.empty() && isBlank(text.back())) text.pop_back();
    if (!text.empty())
      lines_.push_back({std::move(text), number});
    else if (lines_.empty() && comment != std::string_view::npos)
      heading_ += fmt::format("{}\n", commentText(line));
  }
  // Only printable ASCII is sure to survive in another format.
  for (char& c : heading_)
    if (c != '\n' && (c < 0x20 || c > 0x7e)) c = c == '\t' ? ' ' : '?';
  while (heading_.ends_with('\n') || heading_.ends_with(' ')) heading_.pop_back();
  heading_.erase(0, heading_.find_first_not_of('\n'));
}

void ChemkinSource::fail(int line, std::string_view message) const {
  throw InputError(fmt::format("{}: {}", place(line), message));
}

std::string ChemkinSource::place(int line) const {
  return fmt::format("{}:{}", file_, line);
}

std::string upperCase(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view chemkinColumns(std::string_view line, std::size_t first, std::size_t width) {
  return first > line.size() ? std::string_view{} : line.substr(first - 1, width);
}

std::vector<std::string_view> chemkinWords(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> result;
  for (std::size_t start = text.find_first_not_of(separators); start != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(separators, start), text.size());
    result.push_back(text.substr(start, end - start));
    start = text.find_first_not_of(separators, end);
  }
  return result;
}

std::optional<double> fortranNumber(std::string_view text) {
  text = trimmed(text);
  std::string number;  // as from_chars takes it
  std::size_t i = 0;
  if (i < text.size() && (text[i] == '+' || text[i] == '-')) {
    if (text[i] == '-') number += '-';
    ++i;
  }
  bool digits = false, point = false;
  for (; i < text.size() && (isDigit(text[i]) || (text[i] == '.' && !point)); ++i) {
    digits = digits || isDigit(text[i]);
    point = point || text[i] == '.';
    number += text[i];
  }
  if (!digits) return std::nullopt;
  if (i < text.size()) {
    const bool letter = std::string_view("eEdD").find(text[i]) != std::string_view::npos;
    if (letter) ++i;
    while (letter && i < text.size() && isBlank(text[i])) ++i;
    number += 'e';
    const bool sign = i < text.size() && (text[i] == '+' || text[i] == '-');
    if (!letter && !sign) return std::nullopt;
    if (sign && text[i++] == '-') number += '-';
    if (i == text.size()) return std::nullopt;
    for (; i < text.size() && isDigit(text[i]); ++i) number += text[i];
    if (i != text.size()) return std::nullopt;
  }
  double value = 0;
  const auto parsed = std::from_chars(number.data(), number.data() + number.size(), value);
  if (parsed.ptr != number.data() + number.size()) return std::nullopt;
  // Beyond the range of a double: an exponent of many digits is either nothing at all or no number.
  if (parsed.ec == std::errc::result_out_of_range)
    return number.find("e-") != std::string::npos ? std::optional(0.0) : std::nullopt;
  if (parsed.ec != std::errc{} || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace lampblack::chemistry
