#include "app/deck/size_bins_deck.hpp"

#include <cmath>

namespace lampblack::app {

void addSizeBinKeys(DeckSchema& schema, const std::string& section, const std::string& largest) {
  schema
      .add(integerKey(section + ".bins", "Number of bins of the size distributions.")
               .byDefault("60")
               .atLeast(2)
               .atMost(10000))
      .add(quantityKey(section + ".smallest", units::length,
                       "Smallest diameter of the size distributions, the lower end of their bins.")
               .byDefault("0.5 nm")
               .above(0))
      .add(quantityKey(section + ".largest", units::length,
                       "Largest diameter of the size distributions, the upper end of their bins.")
               .byDefault(largest)
               .above(0));
}

SizeBins readSizeBins(const Deck& deck, const std::string& section) {
  const double smallest = deck.quantity(section + ".smallest"), largest = deck.quantity(section + ".largest");
  if (!(largest > smallest)) throw deck.error(section + ".largest", "expected more than 'smallest'");
  return {std::log10(smallest), std::log10(largest), deck.integer<std::size_t>(section + ".bins")};
}

}  // namespace lampblack::app
