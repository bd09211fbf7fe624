#include "app/deck/radiation_deck.hpp"

namespace lampblack::app {

void addRadiationKeys(DeckSchema& schema) {
  schema
      .add(choiceKey("radiation.model", {"none", "optically_thin"},
                     "optically_thin: H2O, CO2, CO, CH4 and soot lose heat to the surroundings and take none back from "
                     "each other.")
               .byDefault("none"))
      .add(quantityKey("radiation.surroundings", units::temperature,
                       "Temperature of the surroundings that heat is lost to.")
               .atLeast(0)
               .byDefault("298 K")
               .onlyWith("radiation.model", {"optically_thin"}));
}

RadiationOptions readRadiation(const Deck& deck) {
  return {deck.choice("radiation.model") == "optically_thin", deck.quantity("radiation.surroundings")};
}

}  // namespace lampblack::app
