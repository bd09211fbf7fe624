#include "chemistry/mechanism/equation_parser.hpp"

#include <fmt/format.h>

#include <charconv>

#include "core/errors.hpp"

namespace lampblack::chemistry {

namespace {

struct ParsedSide {
  ParsedEquation::Side terms;
  bool hasM = false;
  std::string falloffCollider;
};

std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> result;
  std::size_t i = 0;
  while (i < text.size()) {
    while (i < text.size() && (text[i] == ' ' || text[i] == '\t')) ++i;
    std::size_t start = i;
    while (i < text.size() && text[i] != ' ' && text[i] != '\t') ++i;
    if (i > start) result.emplace_back(text.substr(start, i - start));
  }
  // "(+ M)" and "( +M )" are written with blanks by some tools.
  std::vector<std::string> joined;
  for (std::size_t w = 0; w < result.size(); ++w) {
    std::string word = result[w];
    if (word.front() == '(' && (word == "(" || word[1] == '+'))
      while (word.back() != ')' && w + 1 < result.size()) word += result[++w];
    joined.push_back(word);
  }
  return joined;
}

// Leaves `value` alone unless the whole word is a number ("2", but not the species "2-C4H8").
bool readNumber(const std::string& word, double& value) {
  double number = 0;
  const auto parsed = std::from_chars(word.data(), word.data() + word.size(), number);
  if (parsed.ec != std::errc{} || parsed.ptr != word.data() + word.size()) return false;
  value = number;
  return true;
}

void addTerm(ParsedEquation::Side& side, const std::string& name, double coefficient) {
  for (auto& [known, amount] : side) {
    if (known == name) {
      amount += coefficient;
      return;
    }
  }
  side.emplace_back(name, coefficient);
}

ParsedSide parseSide(std::string_view text, std::string_view equation) {
  ParsedSide side;
  double coefficient = 1;
  bool haveCoefficient = false;
  bool expectTerm = true;
  for (const auto& word : words(text)) {
    if (word.size() > 3 && word.starts_with("(+") && word.back() == ')') {
      if (expectTerm || !side.falloffCollider.empty())
        throw InputError(fmt::format("equation '{}': misplaced '{}'", equation, word));
      side.falloffCollider = word.substr(2, word.size() - 3);
    } else if (word == "+") {
      if (expectTerm) throw InputError(fmt::format("equation '{}': expected a species before '+'", equation));
      expectTerm = true;
    } else if (expectTerm && !haveCoefficient && readNumber(word, coefficient)) {
      if (!(coefficient > 0))
        throw InputError(fmt::format("equation '{}': expected a positive coefficient, found '{}'", equation, word));
      haveCoefficient = true;
    } else {
      if (!expectTerm) throw InputError(fmt::format("equation '{}': expected '+' before '{}'", equation, word));
      if (word == "M" && !haveCoefficient) {
        if (side.hasM) throw InputError(fmt::format("equation '{}': expected 'M' once on a side", equation));
        side.hasM = true;
      } else {
        addTerm(side.terms, word, coefficient);
      }
      expectTerm = false;
      haveCoefficient = false;
      coefficient = 1;
    }
  }
  if (expectTerm) throw InputError(fmt::format("equation '{}': expected a species at the end of a side", equation));
  return side;
}

}  // namespace

ParsedEquation parseEquation(std::string_view equation) {
  ParsedEquation result;
  std::size_t arrow = equation.find("<=>");
  std::size_t length = 3;
  if (arrow == std::string_view::npos) {
    arrow = equation.find("=>");
    length = 2;
    result.reversible = false;
  }
  if (arrow == std::string_view::npos) {
    arrow = equation.find(" = ");
    length = 3;
    result.reversible = true;
  }
  if (arrow == std::string_view::npos)
    throw InputError(fmt::format("equation '{}': expected '<=>' or '=>' between the two sides", equation));
  auto left = parseSide(equation.substr(0, arrow), equation);
  auto right = parseSide(equation.substr(arrow + length), equation);
  if (left.hasM != right.hasM || left.falloffCollider != right.falloffCollider)
    throw InputError(fmt::format("equation '{}': the third body must stand on both sides", equation));
  if (left.hasM && !left.falloffCollider.empty())
    throw InputError(fmt::format("equation '{}': expected either 'M' or '(+M)', not both", equation));
  result.reactants = std::move(left.terms);
  result.products = std::move(right.terms);
  if (result.reactants.empty() || result.products.empty())
    throw InputError(fmt::format("equation '{}': expected species on both sides", equation));
  result.hasM = left.hasM;
  result.falloffCollider = std::move(left.falloffCollider);
  return result;
}

}  // namespace lampblack::chemistry
