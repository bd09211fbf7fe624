// How decks name a gas: the keys of a mixture in a section of the deck, and reading them. The same words for every
// problem that has mixtures.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/thermo/equivalence_ratio.hpp"
#include "chemistry/thermo/thermo.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

// Adds `composition`, `mass_fractions`, and `fuel`, `oxidizer`, `equivalence_ratio` below `section` ("initial").
void addMixtureKeys(DeckSchema& schema, const std::string& section);

// The mass fractions a section names, in one of the three ways. InputError where it names none or several.
std::vector<double> readMixture(const Deck& deck, const std::string& section, const Mechanism& mechanism);

// Adds `mechanism` and `phase`.
void addMechanismKeys(DeckSchema& schema);

// The mechanism a deck names by these keys; rank 0 prints its warnings. InputError at `mechanism`.
std::shared_ptr<const Mechanism> readMechanism(const Deck& deck);

// A quantity that is optional in the schema and needed here: "<why> needs the key '<name>'".
double neededQuantity(const Deck& deck, const std::string& section, const std::string& name, const std::string& why);

// InputError at that key where a stream of this speed (m/s) is too fast for equations of constant pressure: their error
// goes with the square of the Mach number, some per cent at 0.3.
void requireLowMach(const Deck& deck, const std::string& key, const Thermo& thermo, double speed, double temperature,
                    const std::vector<double>& Y);

// Numbers of the species a key lists by name; all of them for "all". InputError at that key, also for a name said
// twice.
std::vector<std::size_t> readSpeciesList(const Deck& deck, const std::string& key, const Mechanism& mechanism);

}  // namespace lampblack::app
