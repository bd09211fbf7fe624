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

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/modules.hpp"
#include "io/deck.hpp"
#include "io/deck_members.hpp"

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
[[nodiscard]] deckkeys::MemberOfMember<Outer, Inner> inner(Outer outer, Inner member) {
  return {outer, member};
}

namespace deckkeys {

// What does not depend on the options' type.
class BoundKeys : public SectionKeys {
 public:
  using SectionKeys::boolean;
  using SectionKeys::choice;
  using SectionKeys::integer;
  using SectionKeys::number;
  using SectionKeys::quantity;
  using SectionKeys::text;

 protected:
  using ReadAny = std::function<void(const Deck& deck, const std::string& key, void* options)>;
  using Words = std::vector<std::pair<std::string, std::int64_t>>;

  explicit BoundKeys(std::string section) : SectionKeys(std::move(section)) {}
  void bind(const std::string& name, KeyType type, DeckKey key, std::string doc, ReadAny read);
  // `defaults`: options that have the defaults.
  void bindValue(const std::string& name, KeyType type, Place place, const ValueType& value, void* defaults,
                 DeckKey key, std::string doc);
  void bindChoice(const std::string& name, Place place, const ChoiceType& type, Words words, void* defaults,
                  DeckKey key, std::string doc);
  void readAll(const Deck& deck, void* options, const std::string& at) const;

 private:
  std::vector<std::pair<std::string, ReadAny>> reads_;
};

}  // namespace deckkeys

template <typename Options>
class DeckKeys : public deckkeys::BoundKeys {
 public:
  template <typename Member>
  using Value = deckkeys::ValueOf<Options, Member>;
  template <typename Member>
  using Choices = std::initializer_list<std::pair<const char*, Value<Member>>>;
  using Read = std::function<void(const Deck&, const std::string& key, Options&)>;

  // `section` is the path that the keys have in common, "" for none; `defaults` what the keys have by default.
  explicit DeckKeys(std::string section, Options defaults = {})
      : BoundKeys(std::move(section)), defaults_(std::move(defaults)) {}

  using BoundKeys::boolean;
  using BoundKeys::choice;
  using BoundKeys::integer;
  using BoundKeys::number;
  using BoundKeys::quantity;
  using BoundKeys::text;

  template <typename Member>
  void number(const std::string& name, Member member, DeckKey key, std::string doc) {
    bindMember(name, KeyType::number, member, std::move(key), std::move(doc));
  }
  template <typename Member>
  void quantity(const std::string& name, const units::Dimension& dimension, Member member, DeckKey key,
                std::string doc) {
    key.dimension = dimension;
    bindMember(name, KeyType::quantity, member, std::move(key), std::move(doc));
  }
  template <typename Member>
  void integer(const std::string& name, Member member, DeckKey key, std::string doc) {
    bindMember(name, KeyType::integer, member, std::move(key), std::move(doc));
  }
  template <typename Member>
  void boolean(const std::string& name, Member member, DeckKey key, std::string doc) {
    bindMember(name, KeyType::boolean, member, std::move(key), std::move(doc));
  }
  template <typename Member>
  void text(const std::string& name, Member member, DeckKey key, std::string doc) {
    bindMember(name, KeyType::string, member, std::move(key), std::move(doc));
  }
  // The words of the deck and what each of them is; the default is the word of the options' own value.
  template <typename Member>
  void choice(const std::string& name, Member member, const Choices<Member>& choices, DeckKey key, std::string doc) {
    Words words;
    for (const auto& [word, value] : choices) words.emplace_back(word, static_cast<std::int64_t>(value));
    bindChoice(name, placeOf(member), deckkeys::choiceType<deckkeys::MemberOf<Options, Member>>(), std::move(words),
               &defaults_, std::move(key), std::move(doc));
  }
  // One of several words, kept as it is.
  void word(const std::string& name, std::string Options::*member, std::vector<std::string> words, DeckKey key,
            std::string doc) {
    key.choices = std::move(words);
    if (!key.isPresenceSaid) key.byDefault(defaults_.*member);
    bindMember(name, KeyType::choice, member, std::move(key), std::move(doc));
  }
  // A key of any kind that `read` takes into the options.
  void other(const std::string& name, KeyType type, DeckKey key, std::string doc, Read read) {
    bind(name, type, std::move(key), std::move(doc),
         [read = std::move(read)](const Deck& deck, const std::string& path, void* options) {
           read(deck, path, *static_cast<Options*>(options));
         });
  }

  // What the deck says, into what is there; `at` is the section where its path has names or items, "methods.mine".
  void read(const Deck& deck, Options& options, const std::string& at) const { readAll(deck, &options, at); }
  [[nodiscard]] Options read(const Deck& deck, const std::string& at) const {
    Options options = defaults_;
    read(deck, options, at);
    return options;
  }
  [[nodiscard]] Options read(const Deck& deck) const { return read(deck, section_); }

 private:
  template <typename Member>
  deckkeys::Place placeOf(Member member) {
    if constexpr (deckkeys::isPlain<Member>)
      return {reinterpret_cast<char*>(&std::invoke(member, defaults_)) - reinterpret_cast<char*>(&defaults_), {}};
    else
      return {0, [member](void* options) -> void* { return &std::invoke(member, *static_cast<Options*>(options)); }};
  }
  template <typename Member>
  void bindMember(const std::string& name, KeyType type, Member member, DeckKey key, std::string doc) {
    bindValue(name, type, placeOf(member), deckkeys::valueType<deckkeys::MemberOf<Options, Member>>(), &defaults_,
              std::move(key), std::move(doc));
  }

  Options defaults_;
};

}  // namespace lampblack::io
