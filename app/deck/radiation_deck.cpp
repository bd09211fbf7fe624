#include "app/deck/radiation_deck.hpp"

#include "app/run/warnings.hpp"

namespace lampblack::app {

void addRadiationKeys(DeckSchema& schema) {
  schema
      .add(choiceKey(
               "radiation.model", {"none", "optically_thin"},
               "optically_thin: H2O, CO2, CO, CH4 (found by their composition and name, in any case of letters) and "
               "soot lose heat to the surroundings and take none back from each other; other species such as "
               "NH3, N2O and NO do not radiate.")
               .byDefault("none"))
      .add(quantityKey("radiation.surroundings", units::temperature,
                       "Temperature of the surroundings that heat is lost to.")
               .atLeast(0)
               .byDefault("298 K")
               .onlyWith("radiation.model", {"optically_thin"}));
}

RadiationOptions readRadiation(const Deck& deck, const Mechanism& mechanism) {
  const bool on = deck.choice("radiation.model") == "optically_thin";
  if (on) printWarnings(radiationWarnings(mechanism));
  return {on, deck.quantity("radiation.surroundings")};
}

}  // namespace lampblack::app
