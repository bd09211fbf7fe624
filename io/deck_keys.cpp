#include "io/deck_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace lampblack::io::deckkeys {

void BoundKeys::bind(const std::string& name, KeyType type, DeckKey key, std::string doc, ReadAny read) {
  add(name, type, std::move(key), std::move(doc));
  reads_.emplace_back(name, std::move(read));
}

void BoundKeys::bindValue(const std::string& name, KeyType type, Place place, const ValueType& value, void* defaults,
                          DeckKey key, std::string doc) {
  if (!key.isPresenceSaid) {
    if (value.isOptional)
      key.optional();
    else
      key.byDefault(value.text(place.in(defaults), units::siUnit(key.dimension)));
  }
  if (value.isList) {
    key.isList = true;
    if (value.count > 0) key.count = value.count;
  }
  bind(name, type, std::move(key), std::move(doc),
       [type, read = value.read, place = std::move(place)](const Deck& deck, const std::string& path, void* options) {
         read(deck, path, type, place.in(options));
       });
}

void BoundKeys::bindChoice(const std::string& name, Place place, const ChoiceType& type, Words words, void* defaults,
                           DeckKey key, std::string doc) {
  for (const auto& [word, value] : words) key.choices.push_back(word);
  if (!key.isPresenceSaid) {
    if (type.isOptional) {
      key.optional();
    } else if (!type.isList) {
      for (const auto& [word, value] : words)
        if (value == type.get(place.in(defaults))) key.byDefault(word);
      if (key.defaultText.empty())
        throw std::logic_error(fmt::format("deck key '{}': no choice is the default", joinedPath(path(), name)));
    }
  }
  if (type.isList) key.list();
  bind(name, KeyType::choice, std::move(key), std::move(doc),
       [type, place = std::move(place), words = std::move(words)](const Deck& deck, const std::string& at,
                                                                  void* options) {
         const auto valueOf = [&](const std::string& word) {
           return std::ranges::find(words, word, &Words::value_type::first)->second;
         };
         void* into = place.in(options);
         if (!type.isList) return type.add(into, valueOf(deck.choice(at)));
         type.clear(into);
         for (const std::string& word : deck.strings(at)) type.add(into, valueOf(word));
       });
}

void BoundKeys::readAll(const Deck& deck, void* options, const std::string& at) const {
  for (const auto& [name, read] : reads_) {
    const std::string key = joinedPath(at, name);
    if (deck.isThere(key)) read(deck, key, options);
  }
}

}  // namespace lampblack::io::deckkeys
