#include "chemistry/chemkin/chemkin_equation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "chemistry/chemkin/chemkin_text.hpp"
#include "core/errors.hpp"
#include "core/nearest_name.hpp"

namespace lampblack::chemistry {

namespace {

constexpr std::size_t longestEquation = 2000;
constexpr std::string_view lightText =
    "reactions driven by light (hv) are not supported; it may stand among the products";

bool isThirdBody(std::string_view name) {
  return name == "M" || name == "m";
}

bool isLight(std::string_view name) {
  return name.size() == 2 && upperCase(name) == "HV";
}

// How many characters at the start may be a coefficient: first none and the plain numbers ("1", "1.", "1.5" of
// "1.5E-2BIN6"), then those with an exponent ("1.5E-2").
std::vector<std::size_t> coefficientLengths(std::string_view text) {
  const std::size_t plain = std::min(text.find_first_not_of("0123456789."), text.size());
  std::vector<std::size_t> lengths;
  for (std::size_t n = 0; n <= plain; ++n) lengths.push_back(n);
  std::size_t at = plain;
  if (plain == 0 || at == text.size() || std::string_view("eEdD").find(text[at]) == std::string_view::npos)
    return lengths;
  if (++at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
  for (; at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0; ++at) lengths.push_back(at + 1);
  return lengths;
}

void add(std::vector<StoichiometricTerm>& terms, std::size_t species, double coefficient) {
  for (auto& term : terms) {
    if (term.species != species) continue;
    term.coefficient += coefficient;
    return;
  }
  terms.push_back({species, coefficient});
}

}  // namespace

ChemkinEquationParser::ChemkinEquationParser(std::span<const std::string> names) : names_(names.begin(), names.end()) {
  for (std::size_t k = 0; k < names_.size(); ++k) {
    index_.emplace(names_[k], k);
    longest_ = std::max(longest_, names_[k].size());
  }
}

std::optional<std::size_t> ChemkinEquationParser::find(std::string_view name) const {
  const auto found = index_.find(std::string(name));
  if (found == index_.end()) return std::nullopt;
  return found->second;
}

std::string ChemkinEquationParser::suggestion(std::string_view name) const {
  return didYouMean(name, names_);
}

// The position behind "(+M)" or "(+species)" at `at`.
std::optional<std::size_t> ChemkinEquationParser::falloffEnd(std::string_view text, std::size_t at, Side& side) const {
  if (!text.substr(at).starts_with("(+")) return std::nullopt;
  for (std::size_t end = text.find(')', at); end != std::string_view::npos; end = text.find(')', end + 1)) {
    const auto name = text.substr(at + 2, end - at - 2);
    if (name.size() > std::max<std::size_t>(longest_, 1)) return std::nullopt;
    const auto species = find(name);
    if (!species && !isThirdBody(name)) continue;
    side.hasFalloff = true;
    side.collider = species;
    return end + 1;
  }
  return std::nullopt;
}

// Reads terms from `at` to the end, longest names first, and undoes what leads nowhere. `hopeless` marks positions from
// which the rest cannot be read.
bool ChemkinEquationParser::takeTerms(std::string_view text, std::size_t at, std::vector<bool>& hopeless,
                                      Side& side) const {
  if (at >= text.size() || hopeless[at]) return false;
  const Side before = side;
  const auto rest = text.substr(at);
  const auto goesOn = [&](std::size_t end) {
    if (const auto behind = falloffEnd(text, end, side)) end = *behind;
    return end == text.size() || (text[end] == '+' && takeTerms(text, end + 1, hopeless, side));
  };
  for (const std::size_t digits : coefficientLengths(rest)) {
    double coefficient = 1;
    if (digits > 0) {
      const auto number = fortranNumber(rest.substr(0, digits));
      if (!number || !(*number > 0)) continue;
      coefficient = *number;
    }
    const std::size_t start = at + digits;
    for (std::size_t length = std::min(longest_, text.size() - start); length > 0; --length) {
      const auto species = find(text.substr(start, length));
      if (!species) continue;
      add(side.terms, *species, coefficient);
      if (goesOn(start + length)) return true;
      side = before;
    }
    if (digits == 0 && isLight(rest.substr(0, 2))) {
      side.hasLight = true;
      if (goesOn(at + 2)) return true;
      side = before;
    }
    if (digits == 0 && isThirdBody(rest.substr(0, 1)) && !side.hasM) {
      side.hasM = true;
      if (goesOn(at + 1)) return true;
      side = before;
    }
  }
  hopeless[at] = true;
  return false;
}

std::optional<ChemkinEquationParser::Side> ChemkinEquationParser::parseSide(std::string_view text) const {
  Side side;
  std::vector<bool> hopeless(text.size(), false);
  if (!takeTerms(text, 0, hopeless, side) || side.terms.empty()) return std::nullopt;
  return side;
}

void ChemkinEquationParser::explain(std::string_view text) const {
  std::size_t arrow = text.find('=');
  if (arrow == std::string_view::npos)
    throw InputError(fmt::format("equation '{}': expected '=', '<=>' or '=>' between the two sides", text));
  std::size_t behind = arrow + 1;
  if (behind < text.size() && text[behind] == '>') ++behind;
  if (arrow > 0 && text[arrow - 1] == '<') --arrow;
  for (const auto side : {text.substr(0, arrow), text.substr(behind)}) {
    if (side.empty()) throw InputError(fmt::format("equation '{}': expected species on both sides", text));
    if (parseSide(side)) continue;
    for (auto term : chemkinWords(side, "+")) {
      if (const auto open = term.find('('); open != std::string_view::npos && open + 1 == term.size())
        term.remove_suffix(1);
      if (term.empty() || parseSide(term) || isThirdBody(term) || term == "M)" || term == "m)") continue;
      auto lengths = coefficientLengths(term);
      while (lengths.back() >= term.size()) lengths.pop_back();
      const auto name = term.substr(lengths.back());
      if (isLight(name)) throw InputError(fmt::format("equation '{}': {}", text, lightText));
      // A digit in front may belong to the name.
      const bool whole = !suggestion(term).empty();
      throw InputError(fmt::format("equation '{}': species '{}' is not declared{}", text, whole ? term : name,
                                   suggestion(whole ? term : name)));
    }
  }
  throw InputError(fmt::format("equation '{}': expected species and coefficients joined by '+' on both sides", text));
}

ChemkinEquation ChemkinEquationParser::parse(std::string_view given) const {
  std::string text;
  for (const char c : given)
    if (c != ' ' && c != '\t') text += c;
  if (text.size() > longestEquation) throw InputError("the equation is longer than any reaction's");
  // A name may hold '=' too: the first sign between two readable sides is the arrow.
  for (const std::string_view arrow : {"<=>", "=>", "="}) {
    for (auto at = text.find(arrow); at != std::string::npos; at = text.find(arrow, at + 1)) {
      const auto left = parseSide(std::string_view(text).substr(0, at));
      if (!left) continue;
      if (left->hasLight) throw InputError(fmt::format("equation '{}': {}", text, lightText));
      const auto right = parseSide(std::string_view(text).substr(at + arrow.size()));
      if (!right) continue;
      if (left->hasM != right->hasM || left->hasFalloff != right->hasFalloff || left->collider != right->collider)
        throw InputError(fmt::format("equation '{}': the third body must stand on both sides", text));
      if (left->hasM && left->hasFalloff)
        throw InputError(fmt::format("equation '{}': expected either 'M' or '(+M)', not both", text));
      return {left->terms, right->terms, arrow != "=>", right->hasLight, left->hasM, left->hasFalloff, left->collider};
    }
  }
  explain(text);
}

}  // namespace lampblack::chemistry
