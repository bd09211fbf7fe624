// The section `radiation` of flames and flows.
#pragma once

#include "core/modules.hpp"
#include "flow/radiation.hpp"
#include "io/deck.hpp"
#include "io/deck_schema.hpp"

namespace lampblack::app {

void addRadiationKeys(DeckSchema& schema);
RadiationOptions readRadiation(const Deck& deck);

}  // namespace lampblack::app
