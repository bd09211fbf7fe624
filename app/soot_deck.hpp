// What the sections `soot` of all problems have in common: the PAH that dimerise.
#pragma once

#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "io/deck.hpp"
#include "particles/soot_gas.hpp"

namespace lampblack {

// `soot.pah`, with the sticking coefficients of `soot.sticking` where that key exists and is given, else the published
// ones (Blanquart and Pitsch 2009) or those of the law behind them. InputError for what is not a hydrocarbon.
[[nodiscard]] std::vector<PahSpecies> readPahSpecies(const Deck& deck, const Mechanism& mechanism);

// What the section `soot` of a flame says of surface, PAH and switches, with the mechanism's atomic weights; what it
// leaves open as published with its model.
[[nodiscard]] SootModelOptions readSootModelOptions(const Deck& deck, const Mechanism& mechanism);

}  // namespace lampblack
