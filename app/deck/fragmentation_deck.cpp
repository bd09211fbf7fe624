#include "app/deck/fragmentation_deck.hpp"

namespace lampblack::app {

std::pair<DeckKey, DeckKey> fragmentationKeys(const std::string& section, const std::string& description) {
  return {booleanKey(section + ".fragmentation", description).byDefault("false"),
          numberKey(section + ".fragmentation_factor",
                    "Factor A of the rate of break-up, A w n_p^(1/1.8), with w the carbon oxidised per area and time "
                    "and n_p the primary particles; in m^2/kg.")
              .byDefault("1e5")
              .atLeast(0)};
}

SootFragmentation readFragmentation(const Deck& deck, const std::string& section) {
  SootFragmentation law;
  law.active = deck.boolean(section + ".fragmentation");
  law.factor = deck.number(section + ".fragmentation_factor");
  return law;
}

}  // namespace lampblack::app
