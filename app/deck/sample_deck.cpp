#include "app/deck/sample_deck.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/deck/particles_deck.hpp"
#include "io/deck_keys.hpp"
#include "io/request_limits.hpp"

namespace lampblack::app {

DeckKey sampleNumberKey(const std::string& section, const std::string& number) {
  return integerKey(section + ".number", "Number of numerical particles: more have less noise and cost more.")
      .byDefault(number)
      .atLeast(8)
      .atMost(100000000);
}

DeckKey splitToleranceKey(const std::string& section, const std::string& splitTolerance) {
  return numberKey(
             section + ".split_tolerance",
             "Largest relative change of the population in a splitting step: smaller is more accurate and slower.")
      .byDefault(splitTolerance)
      .above(0)
      .atMost(1);
}

void addRepeatKeys(DeckSchema& schema) {
  SectionKeys part("particles");
  part.integer("repeats", rules().byDefault("8").atLeast(2).atMost(100000),
               "Number of independent repeats, from which mean and confidence follow.");
  part.integer("seed", rules().byDefault("1").atLeast(0),
               "Start of the random numbers: another seed gives another sample, the same seed the same result.");
  schema.add(part.schema(), ofPopulations());
}

void addCouplingKeys(DeckSchema& schema) {
  SectionKeys part("particles");
  part.choice(
      "coupling", {"splitting", "predictor_corrector"}, rules().byDefault("splitting"),
      "How gas and particles go on together, both of second order. splitting: half a step of the gas, the particles, "
      "half a step of the gas (Strang 1968); predictor_corrector: the gas with the exchange that is expected, the "
      "particles in its mean, the difference, for species that live shorter than a step; not in networks.");
  part.number("coupling_change", rules().byDefault("0.05").above(0).atMost(1),
              "Steps of the coupling are so long that a concentration which the particles see changes by about this "
              "part of itself, or the temperature by this part of 200 K.");
  schema.add(part.schema(), ofPopulations());
}

void addSizeBinKeys(DeckSchema& schema, const std::string& section, const std::string& largest) {
  SectionKeys keys(section);
  keys.integer("bins", rules().byDefault("60").atLeast(2).atMost(10000), "Number of bins of the size distributions.");
  keys.quantity("smallest", units::length, rules().byDefault("0.5 nm").above(0),
                "Smallest diameter of the size distributions, the lower end of their bins.");
  keys.quantity("largest", units::length, rules().byDefault(largest).above(0),
                "Largest diameter of the size distributions, the upper end of their bins.");
  schema.add(keys.schema());
}

std::size_t readSampleNumber(const Deck& deck, const std::string& section, double bytes) {
  const std::string key = section + ".number";
  const auto number = deck.integer<std::size_t>(key);
  requireMemory(deck, key, fmt::format("a sample of {} particles", number), bytes * static_cast<double>(number));
  return number;
}

SizeBins readSizeBins(const Deck& deck, const std::string& section) {
  const double smallest = deck.quantity(section + ".smallest"), largest = deck.quantity(section + ".largest");
  if (!(largest > smallest)) throw deck.error(section + ".largest", "expected more than 'smallest'");
  return {std::log10(smallest), std::log10(largest), deck.integer<std::size_t>(section + ".bins")};
}

}  // namespace lampblack::app
