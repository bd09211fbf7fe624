#include "io/deck_value.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "core/nearest_name.hpp"
#include "io/deck_hints.hpp"
#include "io/deck_mistakes.hpp"

namespace lampblack::io {
namespace {

void checkRange(const DeckKey& key, double value, const std::string& found) {
  const bool tooLow =
      key.minimum && (key.minimum->exclusive ? !(value > key.minimum->value) : !(value >= key.minimum->value));
  const bool tooHigh =
      key.maximum && (key.maximum->exclusive ? !(value < key.maximum->value) : !(value <= key.maximum->value));
  if (!tooLow && !tooHigh) return;
  const std::string what = key.type == KeyType::quantity  ? units::describe(key.dimension)
                           : key.type == KeyType::integer ? "an integer"
                                                          : "a number";
  throw InputError(fmt::format("expected {} {}, found {}", what, rangeText(key), found));
}

// Throws `mismatch` for what is no integer.
std::int64_t readInteger(const std::string& text, const InputError& mismatch) {
  const std::string_view digits = text.starts_with('+') ? std::string_view(text).substr(1) : std::string_view(text);
  std::int64_t value = 0;
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (status == std::errc{} && end == digits.data() + digits.size()) return value;
  double number = std::nan("");  // 1e6
  try {
    number = units::parseNumber(text);
  } catch (const InputError&) {
    throw mismatch;
  }
  if (std::trunc(number) != number) throw mismatch;
  // Beyond 2^53 floating point has no longer every integer.
  if (std::abs(number) > 9007199254740992.0)
    throw InputError(
        status == std::errc::result_out_of_range || std::abs(number) >= 0x1p63
            ? fmt::format("{}, which is too large: integers end at 9223372036854775807", mismatch.what())
            : fmt::format("{}: integers above 9007199254740992 have to be written in digits", mismatch.what()));
  return static_cast<std::int64_t>(number);
}

std::optional<bool> readBoolean(const std::string& text) {
  for (const char* yes : {"true", "True", "TRUE", "yes", "Yes", "on", "On"}) {
    if (text == yes) return true;
  }
  for (const char* no : {"false", "False", "FALSE", "no", "No", "off", "Off"}) {
    if (text == no) return false;
  }
  return std::nullopt;
}

// Reads one scalar; the InputError thrown has only the message.
void readScalar(const DeckKey& key, const std::string& text, DeckValue& value, const OtherNames& otherNames) {
  const auto mismatch = [&] {
    DeckKey one = key;
    one.isList = false;
    return InputError(fmt::format("expected {}, found '{}'", expectation(one), shortened(text)));
  };
  const std::string found = fmt::format("'{}'", shortened(text));
  // No number, choice or unit is so long; the messages below quote the text.
  constexpr std::size_t longest = 100;
  if (key.type != KeyType::string && text.size() > longest) throw mismatch();
  switch (key.type) {
    case KeyType::quantity:
      value.numbers.push_back(units::parseQuantity(text, key.dimension));
      checkRange(key, value.numbers.back(), found);
      return;
    case KeyType::number:
      value.numbers.push_back(units::parseQuantity(text, units::dimensionless));
      checkRange(key, value.numbers.back(), found);
      return;
    case KeyType::integer:
      value.integers.push_back(readInteger(text, mismatch()));
      checkRange(key, static_cast<double>(value.integers.back()), found);
      return;
    case KeyType::boolean: {
      const auto flag = readBoolean(text);
      if (!flag) throw mismatch();
      value.integers.push_back(*flag ? 1 : 0);
      return;
    }
    case KeyType::string:
      value.texts.push_back(text);
      return;
    case KeyType::choice:
      for (const std::string& choice : key.choices) {
        if (choice == text) {
          value.texts.push_back(text);
          return;
        }
      }
      const std::string other = byOtherName(text, key.choices, otherNames);
      throw InputError(mismatch().what() + (other.empty() ? didYouMean(text, key.choices) : other));
  }
}

}  // namespace

DeckValue readDeckValue(const DeckSource& source, const DeckKey& key, const std::string& path, const DeckNode& node,
                        const OtherNames& otherNames) {
  DeckValue value{key, path, false, true, {}, {}, {}};
  const auto scalar = [&](const DeckNode& item, const std::string& itemPath) {
    const bool textOfMap = key.type == KeyType::string && item.kind == DeckNode::Kind::map && !item.text.empty();
    if (item.kind != DeckNode::Kind::scalar && !textOfMap) {
      DeckKey one = key;
      one.isList = key.isList && &item == &node;
      const DeckLocation at = item.at.line > 0 ? item.at : item.nameAt;
      throw deckError(source, at, itemPath,
                      fmt::format("expected {}, found {}{}", expectation(one), foundText(item),
                                  key.type == KeyType::string ? asQuotedText(item) : ""));
    }
    try {
      readScalar(key, item.text, value, otherNames);
    } catch (const InputError& error) {
      throw deckError(source, item.at, itemPath, error.what());
    }
  };
  if (!key.isList) {
    scalar(node, path);
    return value;
  }
  if (node.kind != DeckNode::Kind::list || (key.count && node.children.size() != *key.count)) {
    throw deckError(source, node.at.line > 0 ? node.at : node.nameAt, path,
                    fmt::format("expected {}, found {}", expectation(key), foundText(node)));
  }
  DeckMistakes mistakes;
  for (std::size_t i = 0; i < node.children.size(); ++i)
    mistakes.collect(node.children[i].at, [&] { scalar(node.children[i], fmt::format("{}[{}]", path, i)); });
  mistakes.raise();
  return value;
}

DeckValue defaultDeckValue(const DeckKey& key, const std::string& path) {
  try {
    const DeckSource source{{"default", "default: " + key.defaultText}, {}, {}};
    const DeckNode tree = parseDeck(source.file);
    DeckValue value = readDeckValue(source, key, path, tree.children.at(0));
    value.isDefault = true;
    return value;
  } catch (const InputError& error) {
    throw std::logic_error(fmt::format("deck key '{}' has an impossible default: {}", key.path, error.what()));
  }
}

}  // namespace lampblack::io
