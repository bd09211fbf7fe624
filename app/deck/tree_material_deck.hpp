// What the primaries of the section `particles` of a reactor are made of.
#pragma once

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"
#include "particles/trees/tree_material.hpp"

namespace lampblack::app {

// Opens the section, described for the problem.
void addTreeMaterialKeys(DeckSchema& schema, const std::string& description);

// With how it sinters. InputError, pointing into the deck.
[[nodiscard]] TreeMaterial readTreeMaterial(const Deck& deck, const Mechanism& mechanism);

}  // namespace lampblack::app
