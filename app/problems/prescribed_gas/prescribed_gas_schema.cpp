#include "app/deck/gas_input.hpp"
#include "app/deck/particles_deck.hpp"
#include "app/deck/sample_deck.hpp"
#include "app/deck/trees_deck.hpp"
#include "app/problems/prescribed_gas/given_gas_deck.hpp"
#include "app/problems/prescribed_gas/prescribed_gas_case.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app {

DeckSchema prescribedGasSchema() {
  SectionKeys keys("");
  keys.choice("problem", {"prescribed_gas"}, rules().formerly("particles_along", "prescribed_gas"), "What is solved.");
  keys.text("title", rules().byDefault("''"), "One line for reports and pictures.");
  addMechanismKeys(keys.schema());
  keys.section("gas", Presence::required, "The gas that the particles meet on their way. Either 'file' or 'flame'.");
  addGivenGasKeys(keys.schema());
  keys.choice("gas.exchange", {"one_way", "two_way"}, rules().byDefault("one_way"),
              "one_way: the gas is as given, whatever particles take from it; two_way: the species of gas.depleted are "
              "what particles leave of them, temperature and pressure as given.");
  keys.text("gas.depleted", rules().list().optional().onlyWith("gas.exchange", {"two_way"}),
            "Species that particles deplete: the gas makes as much of them as given, or loses as large a part. Absent: "
            "the precursors, such as the PAH of soot.");
  keys.choice("gas.viscosity", {"transport", "air"}, rules().optional(),
              "Viscosity of the gas. transport: from the mechanism's transport data; air: Sutherland's law of air. "
              "Absent: transport, for other materials than soot air.");
  addParticleKeys(keys.schema(),
                  {.description = "The particles: a model, or an ensemble or trees by repeats of independent "
                                  "random numbers.",
                   .presence = Presence::required});
  addRepeatKeys(keys.schema());
  addCouplingKeys(keys.schema());
  addTreePrescribedGasKeys(keys.schema());
  addRowKeys(keys.schema());
  return keys.schema();
}

}  // namespace lampblack::app
