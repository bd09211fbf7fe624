// The parts of reading a reactor deck; used by readReactorCase alone.
#pragma once

#include "app/problems/reactor/reactor_kind.hpp"
#include "core/modules.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app::reactorcase {

// ignition and sensitivity of closed reactors.
void readIgnition(const Deck& deck, const ReactorCase& reactorCase, ClosedKind& closed);
void readSensitivity(const Deck& deck, const ReactorCase& reactorCase, ClosedKind& closed);

// The section volume of a closed reactor, and the volume it gives; the start and the end are known.
void addVolumeKeys(DeckSchema& schema);
void readVolume(const Deck& deck, const ReactorCase& reactorCase, ClosedKind& closed);

DeckKeys<StiffIntegrator::Options> integratorKeys();

// What a stirred reactor has in this section, alone or in a network, with this reactor.type; the section network.
void addVesselKeys(DeckSchema& schema, const std::string& section, const std::string& type);
void addNetworkKeys(DeckSchema& schema);
// A stirred reactor (the sections reactor and inlet) and a network (the section network).
StirredKind readStirred(const Deck& deck, const Mechanism& mechanism);
StirredKind readNetwork(const Deck& deck, const Mechanism& mechanism);
// The stirred reactor before a duct, where there is one; the inlet is known.
void readUpstream(const Deck& deck, const Mechanism& mechanism, PlugFlowKind& duct);
// The kinds that decks name, in the order of their reference, and what reads the sections of each.
struct NamedReactorKind {
  std::string name;  // of reactor.type
  std::shared_ptr<const ReactorKind> (*read)(const Deck& deck, ReactorCase& reactorCase);
};
const std::vector<NamedReactorKind>& reactorKinds();

// Of a deck that asks for stochastic populations; the rest of the case is known.
void readPopulations(const Deck& deck, ReactorCase& reactorCase);

}  // namespace lampblack::app::reactorcase
