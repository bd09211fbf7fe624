#include "chemistry/mechanism/like_warnings.hpp"

#include <fmt/format.h>

#include <cctype>
#include <string_view>
#include <unordered_map>

namespace lampblack::chemistry {

namespace {

// Without "file:12: ".
std::string_view behindPlace(std::string_view text) {
  for (std::size_t colon = text.find(':'); colon != std::string_view::npos; colon = text.find(':', colon + 1)) {
    std::size_t end = colon + 1;
    while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end])) != 0) ++end;
    if (end > colon + 1 && text.substr(end).starts_with(": ")) return text.substr(end + 2);
  }
  return text;
}

std::string kindOf(std::string_view warning) {
  auto text = behindPlace(warning);
  std::string kind;
  // Whose warning: "thermodynamic data of 'H2O': ".
  if (const auto quote = text.find('\''), end = text.find("': "); end != std::string_view::npos && quote < end) {
    kind = text.substr(0, quote);
    text = text.substr(end + 3);
  }
  text = text.substr(0, text.find(": "));
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '\'') {
      const auto close = text.find('\'', at + 1);
      if (close == std::string_view::npos) break;
      if (kind.ends_with("unknown key ")) kind += text.substr(at, close - at + 1);
      at = close;
    } else if (std::isdigit(static_cast<unsigned char>(text[at])) == 0 && text[at] != '.') {
      kind += text[at];
    }
  }
  return kind;
}

}  // namespace

std::vector<std::string> oneOfEachKind(std::span<const std::string> warnings) {
  std::vector<std::size_t> first, count;
  std::unordered_map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < warnings.size(); ++i) {
    const auto [kind, isNew] = known.try_emplace(kindOf(warnings[i]), first.size());
    if (isNew) {
      first.push_back(i);
      count.push_back(0);
    }
    ++count[kind->second];
  }
  std::vector<std::string> result;
  for (std::size_t k = 0; k < first.size(); ++k)
    result.push_back(count[k] == 1 ? warnings[first[k]]
                                   : fmt::format("{} ({} more like this)", warnings[first[k]], count[k] - 1));
  return result;
}

}  // namespace lampblack::chemistry
