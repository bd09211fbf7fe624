// The section `radiation` of flames and flows.
#pragma once

#include "core/modules.hpp"
#include "flow/models/radiation.hpp"
#include "io/deck.hpp"
#include "io/deck_schema.hpp"

namespace lampblack::app {

void addRadiationKeys(DeckSchema& schema);
// Warns of what of the mechanism does not radiate though it would (radiationWarnings).
RadiationOptions readRadiation(const Deck& deck, const Mechanism& mechanism);

}  // namespace lampblack::app
