#include "app/deck/particles_deck.hpp"
#include "app/deck/sample_deck.hpp"
#include "app/deck/trees_deck.hpp"
#include "app/prescribed_gas/prescribed_gas_case.hpp"
#include "app/tools/gas_input.hpp"

namespace lampblack::app {

DeckSchema prescribedGasSchema() {
  DeckSchema schema;
  schema.add(choiceKey("problem", {"prescribed_gas"}, "What is solved.").formerly("particles_along", "prescribed_gas"))
      .add(stringKey("title", "One line for reports and pictures.").byDefault("''"));
  addMechanismKeys(schema);
  schema.section("gas", Presence::required, "The gas that the particles meet on their way. Either 'file' or 'flame'.")
      .add(stringKey("gas.file",
                     "CSV file with columns time, temperature, pressure and X_<species> (mole fractions), units in "
                     "brackets, as \"time [ms]\", or in SI; the particles move with the gas, but for a column "
                     "number_loss_rate (1/s), "
                     "the rate at which particles per kg of gas become fewer. "
                     "Tables of a flow's streamlines are such (trajectories.gas_tables). Relative to the deck.")
               .optional())
      .add(stringKey(
               "gas.flame",
               "Results file (results.h5) of a run with problem: flame1d and the same mechanism; the particles move "
               "with the gas and by thermophoresis, on the axis of the flame. Relative to the deck.")
               .optional())
      .add(choiceKey("gas.side", {"left", "right"}, "The end of the flame that the particles come from.")
               .byDefault("left"))
      .add(quantityKey("gas.start", units::length,
                       "Position of the flame's grid from which on the particles are followed; absent: its end.")
               .optional()
               .atLeast(0))
      .add(quantityKey("gas.minimum_velocity", units::velocity,
                       "Speed of the particles below which a path through a flame ends, near the stagnation plane.")
               .formerly("slowest")
               .byDefault("1 mm/s")
               .above(0))
      .add(quantityKey("gas.end", units::time, "Time at which the run ends; absent: the last of the gas.").optional())
      .add(choiceKey("gas.exchange", {"one_way", "two_way"},
                     "one_way: the gas is as given, whatever particles take from it; two_way: the species of "
                     "gas.depleted are what particles leave of them, temperature and pressure as given.")
               .byDefault("one_way"))
      .add(stringKey("gas.depleted",
                     "Species that particles deplete: the gas makes as much of them as given, or loses as large a "
                     "part. Absent: the precursors, such as the PAH of soot.")
               .list()
               .optional()
               .onlyWith("gas.exchange", {"two_way"}))
      .add(choiceKey("gas.viscosity", {"transport", "air"},
                     "Viscosity of the gas. transport: from the mechanism's transport data; air: Sutherland's law of "
                     "air. Absent: transport, for other materials than soot air.")
               .optional());
  addParticleKeys(schema, {.description = "The particles: a model, or an ensemble or trees by repeats of independent "
                                          "random numbers.",
                           .presence = Presence::required});
  addRepeatKeys(schema);
  addCouplingKeys(schema);
  addTreePrescribedGasKeys(schema);
  schema.section("output", Presence::defaulted, "Rows of the history.")
      .add(quantityKey("output.interval", units::time, "Time between rows; absent: a hundredth of the run.")
               .optional()
               .above(0))
      .add(quantityKey("output.times", units::time, "Times with rows besides.").list().optional());
  return schema;
}

}  // namespace lampblack::app
