#include "app/deck/gas_input.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/deck/mechanism_file_names.hpp"
#include "app/run/shipped_files.hpp"
#include "app/run/warnings.hpp"
#include "chemistry/mechanism/like_warnings.hpp"
#include "chemistry/thermo/sound_speed.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "chemistry/transport/pure_gas.hpp"
#include "core/errors.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app {
void addMixtureKeys(DeckSchema& schema, const std::string& section) {
  SectionKeys keys(section);
  keys.text("composition", rules().optional(),
            "Mole fractions, 'CH4: 1, O2: 2, N2: 7.52'; any sum. A name with ':' or '=' stands in quotes of its own.");
  keys.text("mass_fractions", rules().optional(),
            "Mass fractions, in place of mole fractions and written like them, 'CH4: 0.05, O2: 0.22, N2: 0.73'.");
  keys.text("fuel", rules().optional(),
            "Mole fractions of the fuel, 'CH4: 1'; with oxidizer and equivalence_ratio, in place of a composition.");
  keys.text("oxidizer", rules().optional(), "Mole fractions of what the fuel burns with, 'O2: 1, N2: 3.76'.");
  keys.number("equivalence_ratio", rules().optional().atLeast(0),
              "Equivalence ratio of fuel and oxidizer: 1 is stoichiometric, above 1 rich.");
  schema.add(keys.schema());
}

std::vector<double> readMixture(const Deck& deck, const std::string& section, const Mechanism& mechanism) {
  const auto has = [&](const char* name) { return deck.has(section + "." + name); };
  const bool byRatio = has("fuel") || has("oxidizer") || has("equivalence_ratio");
  const int ways = (has("composition") ? 1 : 0) + (has("mass_fractions") ? 1 : 0) + (byRatio ? 1 : 0);
  if (ways != 1)
    throw deck.error(section, fmt::format("{}; expected one of: 'composition', 'mass_fractions', or 'fuel' with "
                                          "'oxidizer' and 'equivalence_ratio'",
                                          ways == 0 ? "the mixture is missing" : "the mixture is given twice"));
  const auto read = [&](const char* name) {
    const std::string key = section + "." + name;
    return deck.at(key, [&] { return parseComposition(mechanism, deck.string(key)); });
  };
  if (has("mass_fractions")) return read("mass_fractions");
  std::vector<double> X;
  if (has("composition")) {
    X = read("composition");
  } else {
    for (const char* name : {"fuel", "oxidizer", "equivalence_ratio"})
      if (!has(name))
        throw deck.error(
            section,
            fmt::format("'fuel', 'oxidizer' and 'equivalence_ratio' belong together; '{}' is "
                        "missing{}",
                        name, std::string_view(name) == "oxidizer" ? ", for instance 'O2: 0.21, N2: 0.79'" : ""));
    const auto fuel = read("fuel"), oxidizer = read("oxidizer");
    X = deck.at(section, [&] {
      return mixByEquivalenceRatio(mechanism, fuel, oxidizer, deck.number(section + ".equivalence_ratio"));
    });
  }
  std::vector<double> Y(X.size());
  Thermo(mechanism).moleToMass(X, Y);
  return Y;
}

void addMechanismKeys(DeckSchema& schema) {
  SectionKeys keys("");
  keys.text("mechanism", rules(),
            "Mechanism file in Cantera's YAML format, relative to the deck; or the name of one that ships (`lampblack "
            "where mechanisms`).");
  keys.text("phase", rules().optional(), "Name of the phase of the mechanism file; without it the first ideal gas.");
  schema.add(keys.schema());
}

std::shared_ptr<const Mechanism> readMechanism(const Deck& deck) {
  return deck.at("mechanism", [&] {
    const std::string path = findMechanism(deck.resolvePath(""), deck.string("mechanism")).string();
    const auto read = [&] {
      try {
        return Mechanism::fromFile(path, deck.optionalString("phase").value_or(""));
      } catch (const InputError& error) {
        if (isYaml(path)) throw;
        throw InputError(
            fmt::format("{}; expected YAML, which 'lampblack mechanism {} THERMO TRANSPORT -o NAME.yaml' makes "
                        "of CHEMKIN files",
                        error.what(), deck.string("mechanism")));
      }
    };
    auto mechanism = std::make_shared<const Mechanism>(read());
    printWarnings(oneOfEachKind(mechanism->warnings()));
    return mechanism;
  });
}

double neededQuantity(const Deck& deck, const std::string& section, const std::string& name, const std::string& why) {
  const auto value = deck.optionalQuantity(section + "." + name);
  if (!value) throw deck.error(section, fmt::format("{} needs the key '{}'", why, name));
  return *value;
}

void requireLowMach(const Deck& deck, const std::string& key, const Thermo& thermo, double speed, double temperature,
                    const std::vector<double>& Y) {
  constexpr double highest = 0.3;
  const double sound = soundSpeed(thermo, temperature, Y);
  if (speed > highest * sound)
    throw deck.error(key,
                     fmt::format("{:.4g} m/s is Mach {:.2g} in this stream; expected at most {:.4g} m/s (Mach {:g}): "
                                 "the equations are those of one pressure everywhere",
                                 speed, speed / sound, highest * sound, highest));
}

std::vector<std::size_t> readSpeciesList(const Deck& deck, const std::string& key, const Mechanism& mechanism) {
  std::vector<std::size_t> species;
  const std::vector<std::string> names = deck.strings(key);
  if (names == std::vector<std::string>{"all"}) {
    for (std::size_t k = 0; k < mechanism.numSpecies(); ++k) species.push_back(k);
    return species;
  }
  for (const std::string& name : names) {
    if (name == "all") throw deck.error(key, "'all' stands alone: it takes every species");
    const std::size_t k = deck.at(key, [&] { return mechanism.speciesIndex(name); });
    if (std::find(species.begin(), species.end(), k) != species.end())
      throw deck.error(key, fmt::format("'{}' is named twice", name));
    species.push_back(k);
  }
  return species;
}

}  // namespace lampblack::app
