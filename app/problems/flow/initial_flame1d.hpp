// A one-dimensional flame (`problem: flame1d`, its profile.csv) laid over the mesh of a flow.
#pragma once

#include "app/problems/flow/flow_case_parts.hpp"
#include "core/modules.hpp"
#include "flow/initial_fields.hpp"
#include "io/deck.hpp"

namespace lampblack::app::flowcase {

// Keys `initial.flame1d.*`.
void addInitialFlameKeys(DeckSchema& schema);

// Gas, velocity along the axis and, of a flame that spreads, across the axis, of an earlier flame. InputError where the
// file is no such profile or the flame has species that the mechanism has not.
InitialFields readInitialFlame(const Deck& deck, const FlowCase& flowCase);

}  // namespace lampblack::app::flowcase
