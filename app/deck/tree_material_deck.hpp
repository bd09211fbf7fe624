// What the primaries of trees are made of, how they react and how they sinter.
#pragma once

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"
#include "particles/trees/tree_material.hpp"

namespace lampblack::app {

void addTreeMaterialKeys(DeckSchema& schema);

// With how it sinters. InputError, pointing into the deck.
[[nodiscard]] TreeMaterial readTreeMaterial(const Deck& deck, const Mechanism& mechanism);
// How primaries sinter; `law`: the material's own.
[[nodiscard]] SinteringLaw readSintering(const Deck& deck, SinteringLaw law);

}  // namespace lampblack::app
