// A small schema and a deck that satisfies it, shared by the tests of decks.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/deck.hpp"

namespace lampblack::test {

inline DeckSchema sampleSchema() {
  DeckSchema schema;
  schema.add(choiceKey("problem", {"flow", "reactor", "flame1d"}, "What is computed."))
      .add(stringKey("mechanism", "Mechanism file."))
      .add(quantityKey("pressure", units::pressure, "Thermodynamic pressure.").byDefault("1 atm").above(0.0))
      .section("mesh", Presence::required, "The mesh.")
      .add(quantityKey("mesh.z[].to", units::length, "End of the segment."))
      .add(integerKey("mesh.z[].cells", "Cells of the segment.").atLeast(1).atMost(100000))
      .section("boundaries", Presence::required, "Named boundaries.")
      .add(choiceKey("boundaries.*.type", {"inlet", "outlet", "wall"}, "Kind."))
      .add(quantityKey("boundaries.*.velocity", units::velocity, "Inward velocity.").optional())
      .add(quantityKey("boundaries.*.temperature", units::temperature, "Temperature.").byDefault("25 degC").above(0.0))
      .add(numberKey("boundaries.*.composition.*", "Mole fraction.").atLeast(0.0).atMost(1.0))
      .add(quantityKey("time.end", units::time, "End of the run.").above(0.0))
      .add(booleanKey("time.adaptive", "Choose the step.").byDefault("true"))
      .section("particles", Presence::optional, "Particles, where wanted.")
      .add(integerKey("particles.count", "Per ensemble."))
      .add(quantityKey("particles.sites", units::perArea, "Sites.").byDefault("2.3e19 1/m^2"))
      .add(vectorKey("gravity", units::acceleration, "Gravity.").byDefault("[0, 0, -9.81 m/s^2]"))
      .add(stringKey("output.fields", "Fields.").list().byDefault("[temperature, velocity]"))
      .add(integerKey("seed", "Seed.").byDefault("1"));
  return schema;
}

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
