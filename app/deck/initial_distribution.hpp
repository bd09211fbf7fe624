// The sizes of the particles at the start in a deck: a map of keys, a list of such maps whose sum the particles are,
// and a table in a file. Wherever a deck gives a distribution of sizes.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/modules.hpp"
#include "io/deck.hpp"
#include "particles/population/model/population_model.hpp"

namespace lampblack::app {

// A size of a particle, as its volume or as the diameter of the sphere that has it: keys `volume` and `diameter`.
void addParticleSize(DeckSchema& schema, const std::string& section, const std::string& what,
                     const std::vector<DeckCondition>& conditions = {});
// The volume (m3) of such a size. InputError, in which `who` needs a size, unless it is given once.
double readParticleSize(const Deck& deck, const std::string& section, const std::string& who);

// Keys of one distribution: which, `number`, a size, `file`. Presence::optional: there may be particles without one,
// `number` of them, of which the caller says what they are.
void addDistribution(DeckSchema& schema, const std::string& section, Presence presence);
// Of a section that says which.
InitialPopulation readDistribution(const Deck& deck, const std::string& section);

// Keys of the section and of the items of a list in its place.
void addInitialDistribution(DeckSchema& schema, const std::string& section);
// Of a section that says which distribution or none, and of `particles.initial`, which may have none.
InitialPopulation readInitialDistribution(const Deck& deck, const std::string& section);
// The section, or each item of a list in its place: "initial", or "initial[0]", "initial[1]".
std::vector<std::string> itemsOf(const Deck& deck, const std::string& section);

// What a sample with these moments misses of the distribution, "M2 0.78, M3 0.17" of what they should be; empty where
// all of M1 to M3 are within 10 %.
std::string missedMoments(const InitialPopulation& initial, const std::array<double, 4>& moments);

// A table of sizes (CSV): columns `from`, `to` and `number`, or `diameter` and `dN/dlogd`; units in brackets behind the
// names. Sizes are diameters, or volumes where their unit says so. InputError.
InitialPopulation readSizeTable(const std::filesystem::path& file);

}  // namespace lampblack::app
