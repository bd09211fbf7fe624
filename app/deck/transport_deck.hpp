// The section `transport` of flames and flows.
#pragma once

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "flow/properties/transport_model.hpp"
#include "io/deck.hpp"
#include "io/deck_schema.hpp"

namespace lampblack::app {

void addTransportKeys(DeckSchema& schema);

// InputError where the mechanism lacks transport data, and for keys that do not go together.
TransportModel readTransport(const Deck& deck, const Mechanism& mechanism);

}  // namespace lampblack::app
