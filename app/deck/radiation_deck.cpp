#include "app/deck/radiation_deck.hpp"

#include "app/run/warnings.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app {

void addRadiationKeys(DeckSchema& schema) {
  SectionKeys keys("radiation");
  keys.choice("model", {"none", "optically_thin"}, rules().byDefault("none"),
              "optically_thin: H2O, CO2, CO, CH4 (found by their composition and name, in any case of letters) and "
              "soot lose heat to the surroundings and take none back from each other; other species such as NH3, N2O "
              "and NO do not radiate.");
  keys.quantity("surroundings", units::temperature,
                rules().atLeast(0).byDefault("298 K").onlyWith("radiation.model", {"optically_thin"}),
                "Temperature of the surroundings that heat is lost to.");
  schema.add(keys.schema());
}

RadiationOptions readRadiation(const Deck& deck, const Mechanism& mechanism) {
  const bool on = deck.choice("radiation.model") == "optically_thin";
  if (on) printWarnings(radiationWarnings(mechanism));
  return {on, deck.quantity("radiation.surroundings")};
}

}  // namespace lampblack::app
