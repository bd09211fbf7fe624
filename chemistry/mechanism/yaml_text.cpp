#include "chemistry/mechanism/yaml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "core/letter_case.hpp"

namespace lampblack::chemistry {

namespace {

constexpr std::size_t kLineLength = 120;

std::string withPoint(const std::string& text) {
  const auto exponent = text.find('e');
  if (exponent == std::string::npos || text.find('.') != std::string::npos) return text;
  return fmt::format("{}.0{}", text.substr(0, exponent), text.substr(exponent));
}

bool isAlphanumeric(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

// Words that one YAML version or another takes for true, false, nothing or a number.
bool isReserved(std::string_view name) {
  constexpr std::array<std::string_view, 11> words{"y",    "n",     "yes",  "no",  "on", "off",
                                                   "true", "false", "null", "nan", "inf"};
  return std::ranges::find(words, lowerCase(name)) != words.end();
}

bool isPrintable(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return c >= 0x20 && c < 0x7f; });
}

// Between single quotes, or double ones where something has to be escaped.
std::string quoted(std::string_view text) {
  if (isPrintable(text)) {
    std::string result = "'";
    for (const char c : text) {
      if (c == '\'') result += c;
      result += c;
    }
    result += '\'';
    return result;
  }
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result += fmt::format("\\{}", c);
    else if (c == '\n')
      result += "\\n";
    else if (c >= 0 && (c < 0x20 || c == 0x7f))
      result += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
    else
      result += c;
  }
  result += '"';
  return result;
}

}  // namespace

std::string yamlNumber(double value) {
  std::array<char, 32> text{};  // 24 characters are enough for any double
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return withPoint({text.data(), end});
}

std::string yamlNumber(double value, double factor) {
  if (factor == 1 || value == 0) return yamlNumber(value);
  const double quotient = value / factor;
  const auto fits = [&](double x) { return x * factor == value; };
  for (int digits = 1; digits <= 17; ++digits) {
    const auto text = fmt::format("{:.{}g}", quotient, digits);
    double x = 0;
    std::from_chars(text.data(), text.data() + text.size(), x);
    if (fits(x)) return yamlNumber(x);
  }
  for (const double x : {std::nextafter(quotient, HUGE_VAL), std::nextafter(quotient, -HUGE_VAL)})
    if (fits(x)) return yamlNumber(x);
  return yamlNumber(quotient);
}

std::string yamlName(std::string_view name) {
  const bool plain = !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) != 0 && !isReserved(name) &&
                     std::ranges::all_of(name, [](char c) {
                       return isAlphanumeric(c) || std::string_view("_-+*().'").find(c) != std::string_view::npos;
                     });
  return plain ? std::string(name) : quoted(name);
}

std::string yamlEquation(std::string_view equation) {
  const bool plain = isAlphanumeric(equation[0]) && std::ranges::all_of(equation, [](char c) {
                       return isAlphanumeric(c) || std::string_view(" _-+*().',<=>").find(c) != std::string_view::npos;
                     });
  return plain ? std::string(equation) : quoted(equation);
}

std::string yamlBlock(std::string_view text) {
  const bool lines = std::ranges::all_of(text, [](char c) { return c == '\n' || (c >= 0x20 && c < 0x7f); });
  const bool edges = !text.empty() && text.front() != ' ' && text.front() != '\n' && text.back() != '\n';
  if (!lines || !edges) return quoted(text);
  std::string result = "|-\n  ";
  for (std::size_t i = 0; i < text.size(); ++i) {
    result += text[i];
    if (text[i] == '\n' && text[i + 1] != '\n') result += "  ";
  }
  return result;
}

std::string yamlList(const std::vector<std::string>& words, std::size_t indent) {
  std::string result = "[";
  std::size_t column = indent + 10;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) {
      result += ",";
      if (column + words[i].size() + 2 > kLineLength) {
        result += '\n';
        result.append(indent, ' ');
        column = indent;
      } else {
        result += " ";
      }
    }
    result += words[i];
    column += words[i].size() + 2;
  }
  result += ']';
  return result;
}

}  // namespace lampblack::chemistry
