#include "app/deck/gas_input.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/sample_deck.hpp"
#include "app/deck/trees_deck.hpp"
#include "app/problems/prescribed_gas/given_gas_deck.hpp"
#include "app/problems/prescribed_gas/prescribed_gas_case.hpp"

namespace lampblack::app {

DeckSchema prescribedGasSchema() {
  DeckSchema schema;
  schema.add(choiceKey("problem", {"prescribed_gas"}, "What is solved.").formerly("particles_along", "prescribed_gas"))
      .add(stringKey("title", "One line for reports and pictures.").byDefault("''"));
  addMechanismKeys(schema);
  schema.section("gas", Presence::required, "The gas that the particles meet on their way. Either 'file' or 'flame'.");
  addGivenGasKeys(schema);
  schema
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
  addRowKeys(schema);
  return schema;
}

}  // namespace lampblack::app
