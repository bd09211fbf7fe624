#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/errors.hpp"

namespace lampblack::chemistry {

namespace {

bool isBlank(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0 || c == ',';
}

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && isBlank(s.front())) s.remove_prefix(1);
  while (!s.empty() && isBlank(s.back())) s.remove_suffix(1);
  return s;
}

// The name in quotes, of either kind, that a text begins with.
std::optional<std::string_view> quotedName(std::string_view s) {
  if (s.front() != '"' && s.front() != '\'') return std::nullopt;
  const auto end = s.find(s.front(), 1);
  if (end == std::string_view::npos) return std::nullopt;
  return s.substr(1, end - 1);
}

// The species of a composition that is one name without an amount, 'CH4'.
std::optional<std::size_t> onlySpecies(const Mechanism& mechanism, std::string_view text) {
  const auto name = trimmed(text);
  if (name.empty()) return std::nullopt;
  const auto quoted = quotedName(name);
  return mechanism.findSpecies(quoted && quoted->size() + 2 == name.size() ? *quoted : name);
}

bool isAir(std::string_view name) {
  return name == "air" || name == "Air" || name == "AIR";
}

// What is in place of a number, up to the next blank, and what to write.
std::string insteadOfNumber(std::string_view rest) {
  const auto found = rest.substr(0, static_cast<std::size_t>(std::ranges::find_if(rest, isBlank) - rest.begin()));
  if (found.empty()) return {};
  const char* hint = "";
  if (found.ends_with(';'))
    hint = "; commas or blanks part the pairs";
  else if (found.ends_with('%'))
    hint = "; leave out '%', the amounts need not add up to one";
  else if (found.find('/') != std::string_view::npos)
    hint = "; write a decimal number";
  return fmt::format(", found '{}'{}", found, hint);
}

// What is no blank behind a number, and what to write: ' %' and the ',5' of a decimal comma.
std::string hintBehindNumber(std::string_view number, std::string_view behind) {
  if (trimmed(behind).starts_with('%'))
    return fmt::format(", found '{} %'; leave out '%', the amounts need not add up to one", number);
  const auto isDigit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  if (!behind.starts_with(',') || number.find('.') != std::string_view::npos) return {};
  const auto end = std::ranges::find_if_not(behind.substr(1), isDigit);
  const auto digits = behind.substr(1, static_cast<std::size_t>(end - behind.substr(1).begin()));
  const auto after = behind.substr(1 + digits.size());
  if (digits.empty() || !(after.empty() || isBlank(after.front()))) return {};
  return fmt::format(", found '{},{}'; a number has a decimal point, {}.{}", number, digits, number, digits);
}

}  // namespace

// A name that has ':' or '=', or begins or ends with a blank or comma, stands in quotes: "'a=b': 1".
std::vector<double> parseAmounts(const Mechanism& mechanism, std::string_view text, std::string_view what,
                                 double absent) {
  std::vector<double> amounts(mechanism.numSpecies(), absent);
  std::vector<bool> given(amounts.size(), false);
  auto rest = trimmed(text);
  if (rest.empty()) throw InputError(fmt::format("empty {}; expected pairs such as 'C2H4: 1, N2: 3'", what));
  while (!rest.empty()) {
    const auto quoted = quotedName(rest);
    if ((rest.front() == '"' || rest.front() == '\'') && !quoted)
      throw InputError(fmt::format("{} '{}': the quote before '{}' is not closed", what, text, rest.substr(1)));
    const auto colon = rest.find_first_of(":=", quoted ? quoted->size() + 2 : 0);
    if (colon == std::string_view::npos)
      throw InputError(fmt::format("{} '{}': expected ':' and an amount after '{}'{}", what, text, rest,
                                   isAir(rest) ? "; air is 'O2: 0.21, N2: 0.79'" : ""));
    if (quoted && !trimmed(rest.substr(quoted->size() + 2, colon - quoted->size() - 2)).empty())
      throw InputError(fmt::format("{} '{}': expected ':' after the name '{}'", what, text, *quoted));
    const auto name = quoted.value_or(trimmed(rest.substr(0, colon)));
    rest = trimmed(rest.substr(colon + 1));
    double amount = 0;
    const auto parsed = std::from_chars(rest.data(), rest.data() + rest.size(), amount);
    const auto length = static_cast<std::size_t>(parsed.ptr - rest.data());
    if (parsed.ec != std::errc{} || !std::isfinite(amount) || (length < rest.size() && !isBlank(rest[length])))
      throw InputError(
          fmt::format("{} '{}': expected a number after '{}:'{}", what, text, name, insteadOfNumber(rest)));
    if (const auto hint = hintBehindNumber(rest.substr(0, length), rest.substr(length)); !hint.empty())
      throw InputError(fmt::format("{} '{}': expected a number after '{}:'{}", what, text, name, hint));
    if (amount < 0) throw InputError(fmt::format("{} '{}': negative amount of '{}'", what, text, name));
    if (isAir(name) && !mechanism.findSpecies(name))
      throw InputError(
          fmt::format("{} '{}': '{}' is a mixture; name its species with their amounts, 'O2: 0.21, N2: "
                      "0.79' of an amount of one",
                      what, text, name));
    const auto k = mechanism.speciesIndex(name);
    if (given[k]) throw InputError(fmt::format("{} '{}': '{}' is given twice", what, text, name));
    given[k] = true;
    amounts[k] = amount;
    rest = trimmed(rest.substr(length));
  }
  return amounts;
}

std::vector<double> parseComposition(const Mechanism& mechanism, std::string_view text) {
  if (const auto alone = onlySpecies(mechanism, text)) {
    std::vector<double> pure(mechanism.numSpecies(), 0.0);
    pure[*alone] = 1;
    return pure;
  }
  auto X = parseAmounts(mechanism, text, "composition", 0.0);
  const double largest = *std::max_element(X.begin(), X.end());
  if (!(largest > 0))
    throw InputError(fmt::format("composition '{}': all amounts are zero; expected at least one positive", text));
  double sum = 0;
  for (const double x : X) sum += x / largest;  // of amounts near the end of floating point, too
  for (double& x : X) x = x / largest / sum;
  return X;
}

}  // namespace lampblack::chemistry
