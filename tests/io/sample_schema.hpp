// A small schema with every type of key, shared by the tests and the fuzzer of decks.
#pragma once

#include "io/deck_schema.hpp"
#include "tests/every_module.hpp"

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
      .add(choiceKey("boundaries.*.type", {"inlet", "outlet", "wall"}, "Kind.").formerly("entrance", "inlet"))
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

}  // namespace lampblack::test
