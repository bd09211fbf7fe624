// The parts of reading a reactor deck; used by readReactorCase alone.
#pragma once

#include "app/reactor_case.hpp"

namespace lampblack::reactorcase {

// ignition and sensitivity of closed reactors.
void readIgnition(const Deck& deck, ReactorCase& reactorCase);
void readSensitivity(const Deck& deck, ReactorCase& reactorCase);

// A stirred reactor (the sections reactor and inlet) and a network (the section network).
void readStirred(const Deck& deck, ReactorCase& reactorCase);
void readNetwork(const Deck& deck, ReactorCase& reactorCase);

}  // namespace lampblack::reactorcase
