#include "io/units.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "core/errors.hpp"
#include "io/unit_symbols.hpp"

namespace lampblack::io::units {
namespace {

struct NamedDimension {
  Dimension dimension;
  std::string_view phrase;   // with its article
  std::string_view example;  // as written in a deck
  std::string_view unit;     // SI
};

constexpr std::array<NamedDimension, 34> namedDimensions{{
    {dimensionless, "a plain number", "0.5", ""},
    {length, "a length", "8 mm", "m"},
    {time, "a time", "10 us", "s"},
    {mass, "a mass", "2 g", "kg"},
    {temperature, "a temperature", "298 K", "K"},
    {amount, "an amount of substance", "1 mol", "mol"},
    {angle, "an angle", "30 deg", "rad"},
    {area, "an area", "2 cm^2", "m^2"},
    {volume, "a volume", "5 cm^3", "m^3"},
    {frequency, "a rate", "50 1/s", "1/s"},
    {angularVelocity, "a speed of revolution", "1000 rpm", "rad/s"},
    {velocity, "a velocity", "20 cm/s", "m/s"},
    {acceleration, "an acceleration", "9.81 m/s^2", "m/s^2"},
    {density, "a density", "1800 kg/m^3", "kg/m^3"},
    {force, "a force", "1 N", "N"},
    {pressure, "a pressure", "1 atm", "Pa"},
    {energy, "an energy", "50 mJ", "J"},
    {watt, "a power", "1 kW", "W"},
    {massFlow, "a mass flow", "2 g/min", "kg/s"},
    {massFlux, "a mass flux", "0.06 g/cm^2/s", "kg/m^2/s"},
    {volumeFlow, "a volume flow", "3 L/min", "m^3/s"},
    {viscosity, "a viscosity", "1.8e-5 Pa s", "Pa s"},
    {diffusivity, "a diffusivity", "0.2 cm^2/s", "m^2/s"},
    {conductivity, "a thermal conductivity", "0.026 W/m/K", "W/m/K"},
    {heatFlux, "a heat flux", "10 kW/m^2", "W/m^2"},
    {molarEnergy, "a molar energy", "50 kJ/mol", "J/mol"},
    {molarMass, "a molar mass", "28 g/mol", "kg/mol"},
    {concentration, "a concentration", "40 mol/m^3", "mol/m^3"},
    {specificEnergy, "a specific energy", "1 MJ/kg", "J/kg"},
    {temperatureGradient, "a temperature gradient", "100 K/mm", "K/m"},
    {absorption, "an inverse length", "10 1/m", "1/m"},
    {perArea, "a number per area", "2.3e19 1/m^2", "1/m^2"},
    {perVolume, "a number per volume", "1e15 1/m^3", "1/m^3"},
    {ratePerVolume, "a rate per volume", "1e12 1/cm^3/s", "1/m^3/s"},
}};

const NamedDimension* nameOf(const Dimension& dimension) {
  for (const NamedDimension& named : namedDimensions) {
    if (named.dimension == dimension) return &named;
  }
  return nullptr;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}
bool endsSymbol(char c) {
  return isDigit(c) || c == ' ' || c == '\t' || c == '*' || c == '/' || c == '^' || c == '(' || c == ')' || c == '-' ||
         c == '+';
}

// Recursive descent over: expression = power { ("*" | "/" | blank) power }, power = (symbol | 1 | "(" expression ")")
// ["^"] [exponent].
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : text_(text) {}

  Unit parse() {
    const Unit unit = expression(0);
    if (position_ < text_.size()) fail(fmt::format("'{}' is not expected here", text_.substr(position_)));
    if (!std::isfinite(unit.factor) || unit.factor == 0.0) fail("its size is out of range");
    return unit;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw InputError(fmt::format("the unit '{}' cannot be read: {}", text_, why));
  }

  void skipBlanks() {
    while (position_ < text_.size() && (text_[position_] == ' ' || text_[position_] == '\t')) ++position_;
  }

  Unit expression(int depth) {
    if (depth > 20) fail("too many parentheses");
    skipBlanks();
    Unit left = factor(depth);
    bool divided = false;
    for (;;) {
      const std::size_t before = position_;
      skipBlanks();
      if (position_ >= text_.size() || text_[position_] == ')') return left;
      const char sign = text_[position_];
      const bool product = sign == '*' || sign == '/';
      if (product) ++position_;
      if (!product && before == position_ && sign != '(') fail(fmt::format("'{}' is not expected", sign));
      if (!product && divided) fail("after '/' a blank is ambiguous; write 'W/m/K' or 'W/(m K)'");
      divided = divided || sign == '/';
      skipBlanks();
      const Unit right = factor(depth);
      if (left.offset != 0.0 || right.offset != 0.0)
        fail("degC cannot be part of a longer unit or have a power; use K here");
      left = sign == '/' ? Unit{left.factor / right.factor, 0.0, left.dimension / right.dimension}
                         : Unit{left.factor * right.factor, 0.0, left.dimension * right.dimension};
    }
  }

  Unit factor(int depth) {
    Unit base;
    if (position_ >= text_.size()) fail("it ends too early");
    if (text_[position_] == '(') {
      ++position_;
      base = expression(depth + 1);
      if (position_ >= text_.size() || text_[position_] != ')') fail("')' is missing");
      ++position_;
    } else if (text_[position_] == '1' && (position_ + 1 == text_.size() || !isDigit(text_[position_ + 1]))) {
      ++position_;
      return base;
    } else {
      const std::size_t start = position_;
      while (position_ < text_.size() && !endsSymbol(text_[position_])) ++position_;
      const std::string_view name = text_.substr(start, position_ - start);
      if (name.empty()) fail(fmt::format("'{}' is not expected", text_.substr(start, 1)));
      const auto known = unitOfSymbol(name);
      if (!known) fail(fmt::format("'{}' is not a unit known here{}", name, unitAsWrittenHere(name)));
      base = *known;
    }
    const int exponent = readExponent();
    if (exponent == 1) return base;
    if (base.offset != 0.0) fail("degC cannot be part of a longer unit or have a power; use K here");
    return {std::pow(base.factor, exponent), 0.0, power(base.dimension, exponent)};
  }

  int readExponent() {
    bool marked = false;
    if (position_ < text_.size() && text_[position_] == '^') {
      marked = true;
      ++position_;
    }
    std::size_t end = position_;
    if (end < text_.size() && (text_[end] == '-' || text_[end] == '+')) ++end;
    while (end < text_.size() && isDigit(text_[end])) ++end;
    if (end == position_) {
      if (marked) fail("'^' needs an integer");
      return 1;
    }
    std::string_view digits = text_.substr(position_, end - position_);
    if (digits.front() == '+') digits.remove_prefix(1);
    int exponent = 0;
    const auto [last, status] = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (status != std::errc{} || last != digits.data() + digits.size() || std::abs(exponent) > 9) {
      fail(fmt::format("the power '{}' is not an integer from -9 to 9", digits));
    }
    position_ = end;
    return exponent;
  }

  std::string_view text_;
  std::size_t position_ = 0;
};

// The number at the start of a text, and how much of the text it takes; nothing when there is none.
std::optional<std::pair<double, std::size_t>> leadingNumber(std::string_view text) {
  const std::size_t sign = !text.empty() && text.front() == '+' ? 1 : 0;
  double value = 0.0;
  const auto [end, status] = std::from_chars(text.data() + sign, text.data() + text.size(), value);
  if (status == std::errc::invalid_argument || (sign == 1 && text.size() > 1 && text[1] == '-')) return std::nullopt;
  const auto used = static_cast<std::size_t>(end - text.data());
  if (status == std::errc::result_out_of_range || !std::isfinite(value)) {
    throw InputError(fmt::format("'{}' is not a finite number", text.substr(0, used)));
  }
  return std::pair{value + 0.0, used};  // zero has no sign: a written -0 reads back as it was read
}

// Of what follows the digits of a number and is no unit: how numbers are written here. Empty where that is not the
// cause.
std::string numberAsWrittenHere(std::string_view behind) {
  const auto digitAt = [&](std::size_t at) { return at < behind.size() && isDigit(behind[at]); };
  if (behind.empty()) return {};
  const char first = behind.front();
  if (first == ',' && digitAt(1)) return "; a number has a decimal point, 1.5";
  if ((first == '_' || first == '\'' || first == '.') && digitAt(1)) return "; the digits of a number stand together";
  if (isDigit(first)) return "; the digits of a number stand together";
  const bool isExponent = first == 'd' || first == 'D' || first == 'e' || first == 'E';
  if (isExponent && (digitAt(1) || (behind.size() > 1 && (behind[1] == '-' || behind[1] == '+') && digitAt(2))))
    return "; write 1e-3";
  if (behind.find("\u2212") != std::string_view::npos || behind.find("\u2013") != std::string_view::npos)
    return "; write the minus as '-', of the keyboard";
  if (behind.find("\u00a0") != std::string_view::npos || behind.find("\u202f") != std::string_view::npos)
    return "; one of its blanks is a special character, as in texts that are copied; write a blank";
  return {};
}

std::string expected(const Dimension& dimension) {
  const std::string sample = example(dimension);
  return sample.empty() ? describe(dimension) : fmt::format("{} (for instance '{}')", describe(dimension), sample);
}

}  // namespace

std::string describe(const Dimension& dimension) {
  const NamedDimension* named = nameOf(dimension);
  return named ? std::string(named->phrase) : fmt::format("a quantity in {}", siUnit(dimension));
}

std::string example(const Dimension& dimension) {
  const NamedDimension* named = nameOf(dimension);
  return named ? std::string(named->example) : std::string();
}

std::string siUnit(const Dimension& dimension) {
  if (const NamedDimension* named = nameOf(dimension)) return std::string(named->unit);
  const std::array<std::pair<const char*, int>, 6> bases{{{"kg", dimension.mass},
                                                          {"m", dimension.length},
                                                          {"s", dimension.time},
                                                          {"K", dimension.temperature},
                                                          {"mol", dimension.amount},
                                                          {"rad", dimension.angle}}};
  std::string text;
  for (const auto& [name, exponent] : bases) {
    if (exponent == 0) continue;
    if (!text.empty()) text += ' ';
    text += exponent == 1 ? name : fmt::format("{}^{}", name, exponent);
  }
  return text;
}

Unit parseUnit(std::string_view text) {
  return UnitParser(trim(text)).parse();
}

double parseNumber(std::string_view text) {
  text = trim(text);
  const auto number = leadingNumber(text);
  if (!number || number->second != text.size()) throw InputError(fmt::format("'{}' is not a number", text));
  return number->first;
}

double parseQuantity(std::string_view text, const Dimension& dimension) {
  text = trim(text);
  const auto number = leadingNumber(text);
  if (!number) throw InputError(fmt::format("expected {}, found '{}'", expected(dimension), text));
  const std::string_view rest = trim(text.substr(number->second));
  if (rest.empty()) {
    // Who writes a speed of 1500 or an angle of -142 means rpm and degrees.
    if (dimension.angle != 0 && number->first != 0)
      throw InputError(fmt::format("expected {}, found '{}' without a unit", expected(dimension), text));
    return number->first;
  }
  Unit unit;
  try {
    unit = parseUnit(rest);
  } catch (const InputError& error) {
    throw InputError(fmt::format("expected {}, found '{}': {}{}", expected(dimension), text, error.what(),
                                 numberAsWrittenHere(rest)));
  }
  if (unit.dimension != dimension) {
    throw InputError(fmt::format("expected {}, found '{}', {}", expected(dimension), text, describe(unit.dimension)));
  }
  const double value = unit.factor * number->first + unit.offset;
  if (!std::isfinite(value)) throw InputError(fmt::format("'{}' is not a finite number", text));
  return value;
}

}  // namespace lampblack::io::units
