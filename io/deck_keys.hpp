// Keys of a deck bound to the members of the options that they fill: one line declares a key with its unit, range,
// default and help, and says where its value goes. The schema and the reading are both made of that line.
//
//   DeckKeys<ModeOptions> modeKeys() {
//     DeckKeys<ModeOptions> keys("time.steady.stability");
//     keys.integer("vectors", &ModeOptions::vectors, rules().atLeast(2).atMost(1000), "Disturbances that are
//     marched."); keys.quantity("time", units::time, &ModeOptions::time, rules().above(0), "Time of a march.");
//     keys.choice("norm", &ModeOptions::norm, {{"rms", Norm::rms}, {"maximum", Norm::maximum}}, rules(), "Which
//     norm."); return keys;
//   }
//   schema.add(modeKeys().schema());
//   const ModeOptions options = modeKeys().read(deck);
//
// A member is a pointer to one, or anything that gives a reference to it (io::inner, a lambda). Unless the rules say
// otherwise, a key of a std::optional is optional, and another has as default what the options have by themselves; a
// list is a std::vector, one of a known length a std::array. Where the deck has no value, that of the options stays.
// A key without a member is read by hand (SectionKeys, which has no options at all); it is required unless the rules
// say otherwise.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::io {

// What a key is to be beside its name and type: rules().optional().above(0).onlyWith("mode", {"steady"}).
[[nodiscard]] inline DeckKey rules() {
  return {"", KeyType::number, ""};
}

// Keys of a section that are declared, and read by hand.
class SectionKeys {
 public:
  // `section` is the path that the keys have in common, "" for none.
  explicit SectionKeys(std::string section) : section_(std::move(section)) {}

  // The section itself, where it needs more than its keys (DeckSchema::section).
  void section(Presence presence, std::string doc, std::vector<DeckCondition> onlyWith = {}) {
    schema_.section(section_, presence, std::move(doc), std::move(onlyWith));
  }
  // The same of a section in it.
  void section(const std::string& name, Presence presence, std::string doc, std::vector<DeckCondition> onlyWith = {}) {
    schema_.section(joinedPath(section_, name), presence, std::move(doc), std::move(onlyWith));
  }

  void number(const std::string& name, DeckKey key, std::string doc) {
    add(name, KeyType::number, std::move(key), std::move(doc));
  }
  void quantity(const std::string& name, const units::Dimension& dimension, DeckKey key, std::string doc) {
    key.dimension = dimension;
    add(name, KeyType::quantity, std::move(key), std::move(doc));
  }
  void integer(const std::string& name, DeckKey key, std::string doc) {
    add(name, KeyType::integer, std::move(key), std::move(doc));
  }
  void boolean(const std::string& name, DeckKey key, std::string doc) {
    add(name, KeyType::boolean, std::move(key), std::move(doc));
  }
  void text(const std::string& name, DeckKey key, std::string doc) {
    add(name, KeyType::string, std::move(key), std::move(doc));
  }
  void choice(const std::string& name, std::vector<std::string> words, DeckKey key, std::string doc) {
    key.choices = std::move(words);
    add(name, KeyType::choice, std::move(key), std::move(doc));
  }
  // A key that has its path and all.
  void add(DeckKey key) { schema_.add(std::move(key)); }

  [[nodiscard]] const DeckSchema& schema() const { return schema_; }
  // For keys that stand among these and are declared elsewhere.
  [[nodiscard]] DeckSchema& schema() { return schema_; }
  [[nodiscard]] const std::string& path() const { return section_; }

 protected:
  void add(const std::string& name, KeyType type, DeckKey key, std::string doc) {
    key.path = joinedPath(section_, name);
    key.type = type;
    key.doc = std::move(doc);
    schema_.add(std::move(key));
  }

  std::string section_;
  DeckSchema schema_;
};

// A member of a member, inner(&Case::time, &Times::end).
template <typename Outer, typename Inner>
[[nodiscard]] auto inner(Outer outer, Inner member) {
  return [ outer, member ](auto& options) -> auto& {
    return std::invoke(member, std::invoke(outer, options));
  };
}

namespace deckkeys {

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

// As it stands in a deck. The unit follows each value.
template <typename T>
std::string defaultText(const T& value, const std::string& unit) {
  const std::string behind = unit.empty() ? "" : " " + unit;
  if constexpr (Unwrapped<T>::isList) {
    std::string items;
    for (const auto& item : value) items += (items.empty() ? "" : ", ") + defaultText(item, unit);
    return "[" + items + "]";
  } else if constexpr (std::same_as<T, std::string>) {
    return "'" + value + "'";
  } else {
    return fmt::format("{}", value) + behind;
  }
}

// The deck's values of one type as the member has them.
template <typename Member, typename Values>
void assignList(Member& member, const Values& values) {
  if constexpr (Unwrapped<Member>::count > 0)
    std::copy_n(values.begin(), std::min(values.size(), member.size()), member.begin());
  else
    member.assign(values.begin(), values.end());
}

}  // namespace deckkeys

template <typename Options>
class DeckKeys : public SectionKeys {
 public:
  template <typename Member>
  using Value = deckkeys::ValueOf<Options, Member>;
  template <typename Member>
  using Choices = std::vector<std::pair<std::string, Value<Member>>>;
  using Read = std::function<void(const Deck&, const std::string& key, Options&)>;

  // `section` is the path that the keys have in common, "" for none; `defaults` what the keys have by default.
  explicit DeckKeys(std::string section, Options defaults = {})
      : SectionKeys(std::move(section)), defaults_(std::move(defaults)) {}

  using SectionKeys::boolean;
  using SectionKeys::choice;
  using SectionKeys::integer;
  using SectionKeys::number;
  using SectionKeys::quantity;
  using SectionKeys::text;

  template <typename Member>
  void number(const std::string& name, Member member, DeckKey key, std::string doc) {
    addNumbers(name, KeyType::number, {}, member, std::move(key), std::move(doc));
  }
  template <typename Member>
  void quantity(const std::string& name, const units::Dimension& dimension, Member member, DeckKey key,
                std::string doc) {
    addNumbers(name, KeyType::quantity, dimension, member, std::move(key), std::move(doc));
  }
  template <typename Member>
  void integer(const std::string& name, Member member, DeckKey key, std::string doc) {
    addPlain(name, KeyType::integer, member, std::move(key), std::move(doc),
             [member](const Deck& deck, const std::string& path, Options& options) {
               auto& into = std::invoke(member, options);
               if constexpr (isList<Member>)
                 deckkeys::assignList(into, deck.integers(path));
               else
                 into = deck.integer<Value<Member>>(path);
             });
  }
  template <typename Member>
  void boolean(const std::string& name, Member member, DeckKey key, std::string doc) {
    addPlain(name, KeyType::boolean, member, std::move(key), std::move(doc),
             [member](const Deck& deck, const std::string& path, Options& options) {
               std::invoke(member, options) = deck.boolean(path);
             });
  }
  template <typename Member>
  void text(const std::string& name, Member member, DeckKey key, std::string doc) {
    addPlain(name, KeyType::string, member, std::move(key), std::move(doc),
             [member](const Deck& deck, const std::string& path, Options& options) {
               auto& into = std::invoke(member, options);
               if constexpr (isList<Member>)
                 deckkeys::assignList(into, deck.strings(path));
               else
                 into = deck.string(path);
             });
  }
  // The words of the deck and what each of them is; the default is the word of the options' own value.
  template <typename Member>
  void choice(const std::string& name, Member member, const Choices<Member>& choices, DeckKey key, std::string doc) {
    for (const auto& [word, value] : choices) key.choices.push_back(word);
    if (key.presence == Presence::required && !key.isPresenceSaid) {
      if constexpr (isOptional<Member>) {
        key.optional();
      } else if constexpr (!isList<Member>) {
        for (const auto& [word, value] : choices)
          if (value == std::invoke(member, defaults_)) key.byDefault(word);
        if (key.defaultText.empty())
          throw std::logic_error(fmt::format("deck key '{}': no choice is the default", joinedPath(section_, name)));
      }
    }
    bind(name, KeyType::choice, isList<Member> ? key.list() : key, std::move(doc),
         [member, choices](const Deck& deck, const std::string& path, Options& options) {
           const auto valueOf = [&](const std::string& word) {
             return std::ranges::find(choices, word, &Choices<Member>::value_type::first)->second;
           };
           auto& into = std::invoke(member, options);
           if constexpr (isList<Member>) {
             into.clear();
             for (const std::string& word : deck.strings(path)) into.push_back(valueOf(word));
           } else {
             into = valueOf(deck.choice(path));
           }
         });
  }
  // One of several words, kept as it is.
  template <typename Member>
  void word(const std::string& name, Member member, const std::vector<std::string>& words, DeckKey key,
            std::string doc) {
    Choices<Member> choices;
    for (const std::string& each : words) choices.emplace_back(each, each);
    choice(name, member, choices, std::move(key), std::move(doc));
  }
  // A key of any kind that `read` takes into the options.
  void other(const std::string& name, KeyType type, DeckKey key, std::string doc, Read read) {
    bind(name, type, std::move(key), std::move(doc), std::move(read));
  }

  // What the deck says, into what is there; `at` is the section where its path has names or items, "methods.mine".
  void read(const Deck& deck, Options& options, const std::string& at) const {
    for (const auto& [name, read] : reads_) {
      const std::string key = joinedPath(at, name);
      if (deck.isThere(key)) read(deck, key, options);
    }
  }
  [[nodiscard]] Options read(const Deck& deck, const std::string& at) const {
    Options options = defaults_;
    read(deck, options, at);
    return options;
  }
  [[nodiscard]] Options read(const Deck& deck) const { return read(deck, section_); }

 private:
  template <typename Member>
  using Unwrapped = deckkeys::Unwrapped<deckkeys::MemberOf<Options, Member>>;
  template <typename Member>
  static constexpr bool isList = Unwrapped<Member>::isList;
  template <typename Member>
  static constexpr bool isOptional = Unwrapped<Member>::isOptional;

  void bind(const std::string& name, KeyType type, DeckKey key, std::string doc, Read read) {
    add(name, type, std::move(key), std::move(doc));
    reads_.emplace_back(name, std::move(read));
  }

  template <typename Member>
  void addPlain(const std::string& name, KeyType type, Member member, DeckKey key, std::string doc, Read read) {
    if (!key.isPresenceSaid) {
      if constexpr (isOptional<Member>)
        key.optional();
      else
        key.byDefault(deckkeys::defaultText(std::invoke(member, defaults_), units::siUnit(key.dimension)));
    }
    if constexpr (isList<Member>) {
      key.isList = true;
      if constexpr (Unwrapped<Member>::count > 0) key.count = Unwrapped<Member>::count;
    }
    bind(name, type, std::move(key), std::move(doc), std::move(read));
  }

  template <typename Member>
  void addNumbers(const std::string& name, KeyType type, const units::Dimension& dimension, Member member, DeckKey key,
                  std::string doc) {
    key.dimension = dimension;
    addPlain(name, type, member, std::move(key), std::move(doc),
             [member, type](const Deck& deck, const std::string& path, Options& options) {
               auto& into = std::invoke(member, options);
               if constexpr (isList<Member>)
                 deckkeys::assignList(into, type == KeyType::number ? deck.numbers(path) : deck.quantities(path));
               else
                 into = type == KeyType::number ? deck.number(path) : deck.quantity(path);
             });
  }

  Options defaults_;
  std::vector<std::pair<std::string, Read>> reads_;
};

}  // namespace lampblack::io
