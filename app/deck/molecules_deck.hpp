// Particles whose matter are molecules that grow site by site (`particles.description: molecules`).
#pragma once

#include "app/deck/trees_deck.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"
#include "particles/molecules/molecule_options.hpp"

namespace lampblack::app {

void addMoleculeKeys(DeckSchema& schema);

// Of a deck with such particles, what all problems have. InputError, pointing into the deck.
[[nodiscard]] MoleculeOptions readMoleculeOptions(const Deck& deck, const Mechanism& mechanism);

}  // namespace lampblack::app
