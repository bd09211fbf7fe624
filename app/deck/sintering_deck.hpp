// How long primaries take to become one, in a deck: the keys of a law, wherever a deck has one.
#pragma once

#include <string>

#include "core/modules.hpp"
#include "io/deck.hpp"
#include "particles/spheres/sintering_law.hpp"

namespace lampblack::app {

// `mechanism`, `prefactor`, `activation_temperature`, `critical_diameter` of a section, which the caller declares.
void addSinteringLawKeys(DeckSchema& schema, const std::string& section);
// `law`: the material's own. InputError.
[[nodiscard]] SinteringLaw readSinteringLaw(const Deck& deck, const std::string& section, SinteringLaw law);
void requirePrefactor(const Deck& deck, const std::string& section, const SinteringLaw& law);

}  // namespace lampblack::app
