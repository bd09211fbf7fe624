#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/errors.hpp"

namespace lampblack {

namespace {

bool isBlank(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0 || c == ',';
}

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && isBlank(s.front())) s.remove_prefix(1);
  while (!s.empty() && isBlank(s.back())) s.remove_suffix(1);
  return s;
}

}  // namespace

std::vector<double> parseAmounts(const Mechanism& mechanism, std::string_view text, std::string_view what,
                                 double absent) {
  std::vector<double> amounts(mechanism.numSpecies(), absent);
  std::vector<bool> given(amounts.size(), false);
  auto rest = trimmed(text);
  if (rest.empty()) throw InputError(fmt::format("empty {}; expected pairs such as 'C2H4: 1, N2: 3'", what));
  while (!rest.empty()) {
    const auto colon = rest.find_first_of(":=");
    if (colon == std::string_view::npos)
      throw InputError(fmt::format("{} '{}': expected ':' and an amount after '{}'", what, text, rest));
    const auto name = trimmed(rest.substr(0, colon));
    rest = trimmed(rest.substr(colon + 1));
    double amount = 0;
    const auto parsed = std::from_chars(rest.data(), rest.data() + rest.size(), amount);
    const auto length = static_cast<std::size_t>(parsed.ptr - rest.data());
    if (parsed.ec != std::errc{} || !std::isfinite(amount) || (length < rest.size() && !isBlank(rest[length])))
      throw InputError(fmt::format("{} '{}': expected a number after '{}:'", what, text, name));
    if (amount < 0) throw InputError(fmt::format("{} '{}': negative amount of '{}'", what, text, name));
    const auto k = mechanism.speciesIndex(name);
    if (given[k]) throw InputError(fmt::format("{} '{}': '{}' is given twice", what, text, name));
    given[k] = true;
    amounts[k] = amount;
    rest = trimmed(rest.substr(length));
  }
  return amounts;
}

std::vector<double> parseComposition(const Mechanism& mechanism, std::string_view text) {
  auto X = parseAmounts(mechanism, text, "composition", 0.0);
  double sum = 0;
  for (const double x : X) sum += x;
  if (!(sum > 0) || !std::isfinite(sum))
    throw InputError(fmt::format("composition '{}': all amounts are zero; expected at least one positive", text));
  for (double& x : X) x /= sum;
  return X;
}

}  // namespace lampblack
