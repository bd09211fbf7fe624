// The parts of reading a reactor deck; used by readReactorCase alone.
#pragma once

#include "app/problems/reactor/reactor_case.hpp"
#include "core/modules.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app::reactorcase {

// ignition and sensitivity of closed reactors.
void readIgnition(const Deck& deck, ReactorCase& reactorCase);
void readSensitivity(const Deck& deck, ReactorCase& reactorCase);

// The section volume of a closed reactor, and the volume it gives; the start and the end are known.
void addVolumeKeys(DeckSchema& schema);
void readVolume(const Deck& deck, ReactorCase& reactorCase);

DeckKeys<StiffIntegrator::Options> integratorKeys();

// What a stirred reactor has in this section, alone or in a network, with this reactor.type; the section network.
void addVesselKeys(DeckSchema& schema, const std::string& section, const std::string& type);
void addNetworkKeys(DeckSchema& schema);
// A stirred reactor (the sections reactor and inlet) and a network (the section network).
void readStirred(const Deck& deck, ReactorCase& reactorCase);
void readNetwork(const Deck& deck, ReactorCase& reactorCase);
// The stirred reactor before a duct, where there is one; the inlet is known.
void readUpstream(const Deck& deck, ReactorCase& reactorCase);
// Of a deck that asks for stochastic populations; the rest of the case is known.
void readPopulations(const Deck& deck, ReactorCase& reactorCase);

}  // namespace lampblack::app::reactorcase
