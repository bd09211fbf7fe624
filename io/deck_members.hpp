// What keys of decks know of the members that they are bound to (io/deck_keys.hpp): where a member is, and how a value
// of the deck comes into it, without the types of the options.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::io::deckkeys {

// Of pointers to members, which do not look at the options' values.
template <typename Outer, typename Inner>
struct MemberOfMember {
  Outer outer;
  Inner member;
  template <typename Options>
  auto& operator()(Options& options) const {
    return std::invoke(member, std::invoke(outer, options));
  }
};

// Whether a member is at the same place in all options.
template <typename Member>
inline constexpr bool isPlain = std::is_member_object_pointer_v<Member>;
template <typename Outer, typename Inner>
inline constexpr bool isPlain<MemberOfMember<Outer, Inner>> = isPlain<Outer>&& isPlain<Inner>;

template <typename T>
struct Unwrapped {
  using Type = T;
  static constexpr bool isOptional = false, isList = false;
  static constexpr std::size_t count = 0;
};
template <typename T>
struct Unwrapped<std::optional<T>> : Unwrapped<T> {
  static constexpr bool isOptional = true;
};
template <typename T>
struct Unwrapped<std::vector<T>> {
  using Type = T;
  static constexpr bool isOptional = false, isList = true;
  static constexpr std::size_t count = 0;
};
template <typename T, std::size_t n>
struct Unwrapped<std::array<T, n>> : Unwrapped<std::vector<T>> {
  static constexpr std::size_t count = n;
};

template <typename Options, typename Member>
using MemberOf = std::remove_cvref_t<std::invoke_result_t<Member, Options&>>;
template <typename Options, typename Member>
using ValueOf = typename Unwrapped<MemberOf<Options, Member>>::Type;

// A type of members, without its name: how a value of the deck comes into one, and its text as it stands in a deck,
// the unit behind each number.
struct ValueType {
  void (*read)(const Deck& deck, const std::string& key, KeyType type, void* into);
  std::string (*text)(const void* value, const std::string& unit);
  bool isOptional = false, isList = false;
  std::size_t count = 0;
};
// The same of choices, which are numbers here.
struct ChoiceType {
  void (*clear)(void* into);
  void (*add)(void* into, std::int64_t choice);
  std::int64_t (*get)(const void* value);
  bool isOptional = false, isList = false;
};

template <typename T>
std::string textOf(const T& value, const std::string& unit) {
  if constexpr (Unwrapped<T>::isList) {
    std::string items;
    for (const auto& item : value) items += (items.empty() ? "" : ", ") + textOf(item, unit);
    return "[" + items + "]";
  } else if constexpr (std::same_as<T, std::string>) {
    return "'" + value + "'";
  } else {
    return fmt::format("{}", value) + (unit.empty() ? "" : " " + unit);
  }
}

template <typename T>
void readInto(const Deck& deck, const std::string& key, KeyType type, T& into) {
  using Value = typename Unwrapped<T>::Type;
  if constexpr (Unwrapped<T>::isList) {
    const auto assign = [&](const auto& values) {
      if constexpr (Unwrapped<T>::count > 0)
        std::copy_n(values.begin(), std::min(values.size(), into.size()), into.begin());
      else
        into.assign(values.begin(), values.end());
    };
    if constexpr (std::same_as<Value, std::string>)
      assign(deck.strings(key));
    else if constexpr (std::integral<Value>)
      assign(deck.integers(key));
    else
      assign(type == KeyType::number ? deck.numbers(key) : deck.quantities(key));
  } else if constexpr (std::same_as<Value, std::string>) {
    into = deck.string(key);
  } else if constexpr (std::same_as<Value, bool>) {
    into = deck.boolean(key);
  } else if constexpr (std::integral<Value>) {
    into = deck.integer<Value>(key);
  } else {
    into = type == KeyType::number ? deck.number(key) : deck.quantity(key);
  }
}

template <typename T>
[[nodiscard]] ValueType valueType() {
  using As = Unwrapped<T>;
  ValueType type{[](const Deck& deck, const std::string& key, KeyType kind, void* into) {
                   readInto(deck, key, kind, *static_cast<T*>(into));
                 },
                 nullptr, As::isOptional, As::isList, As::count};
  if constexpr (!As::isOptional)
    type.text = [](const void* value, const std::string& unit) { return textOf(*static_cast<const T*>(value), unit); };
  return type;
}

template <typename T>
[[nodiscard]] ChoiceType choiceType() {
  using As = Unwrapped<T>;
  ChoiceType type{nullptr,
                  [](void* into, std::int64_t choice) {
                    if constexpr (As::isList)
                      static_cast<T*>(into)->push_back(static_cast<typename As::Type>(choice));
                    else
                      *static_cast<T*>(into) = static_cast<typename As::Type>(choice);
                  },
                  nullptr, As::isOptional, As::isList};
  if constexpr (As::isList)
    type.clear = [](void* into) { static_cast<T*>(into)->clear(); };
  else if constexpr (!As::isOptional)
    type.get = [](const void* value) { return static_cast<std::int64_t>(*static_cast<const T*>(value)); };
  return type;
}

// Where a member is in the options: so many bytes from their beginning, or what a function finds.
struct Place {
  std::ptrdiff_t offset = 0;
  std::function<void*(void* options)> find;
  [[nodiscard]] void* in(void* options) const { return find ? find(options) : static_cast<char*>(options) + offset; }
};

}  // namespace lampblack::io::deckkeys
