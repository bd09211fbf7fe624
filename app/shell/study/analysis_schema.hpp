// An analysis: what parameters of decks are told by measurements, and which of them matter. A file of its own (no
// `problem:`), carried out by the Python that ships (lampblack.analysis), which starts the runs by `lampblack sweep`.
#pragma once

#include "core/modules.hpp"
#include "io/deck_schema.hpp"

namespace lampblack::app {

DeckSchema analysisSchema();

}  // namespace lampblack::app
