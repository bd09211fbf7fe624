// A deck that satisfies the sample schema, and ways to spoil it, shared by the tests of decks.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/deck.hpp"
#include "tests/every_module.hpp"
#include "tests/io/sample_schema.hpp"

namespace lampblack::test {

inline const std::string sampleText = R"(# a flame
problem: flow
mechanism: ../mechanisms/abf.yaml
mesh:
  z:
    - {to: 2 mm, cells: 10}
    - {to: 8 mm, cells: 30}
boundaries:
  fuel:
    type: inlet
    velocity: 20 cm/s
    composition: {C2H4: 1.0}
  oxidiser:
    type: inlet
    velocity: 0.2
    temperature: 298 K
    composition:
      O2: 25 %
      N2: 0.75
  outside: {type: outlet}
time:
  end: 40 ms
)";

inline Deck sampleDeck(const std::vector<std::string>& overrides = {}, const std::string& text = sampleText) {
  return Deck::parse(text, "cases/sample/deck.yaml", overrides, sampleSchema());
}

// The message of the InputError that reading this deck raises; a failure where it raises none.
inline std::string messageOf(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    (void)sampleDeck(overrides, text);
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "the deck was accepted:\n" << text;
  return {};
}

// A deck of a small schema, and what is said where it is refused.
inline Deck deckOf(const DeckSchema& schema, const std::string& text, const std::vector<std::string>& overrides = {}) {
  return Deck::parse(text, "deck.yaml", overrides, schema);
}
inline std::string refusalOf(const DeckSchema& schema, const std::string& text,
                             const std::vector<std::string>& overrides = {}) {
  try {
    (void)deckOf(schema, text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// The sample with one piece of its text replaced.
inline std::string sampleWith(const std::string& from, const std::string& to) {
  std::string text = sampleText;
  const std::size_t at = text.find(from);
  if (at == std::string::npos) {
    ADD_FAILURE() << "the sample has no '" << from << "'";
    return text;
  }
  return text.replace(at, from.size(), to);
}

}  // namespace lampblack::test
