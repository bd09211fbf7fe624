// The section `soot` of every problem: its keys, and the model it asks for.
#pragma once

#include <memory>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "io/deck.hpp"
#include "particles/models/particle_model.hpp"
#include "particles/soot_gas.hpp"

namespace lampblack {

// The keys, for the schema of a problem. An absent section is no soot.
void addSootModelKeys(DeckSchema& schema);

// The model that a deck asks for, with the mechanism's atomic weights; empty for `model: none` and for a deck without
// the section. InputError, pointing into the deck, for what the mechanism or the model cannot do.
[[nodiscard]] std::unique_ptr<ParticleModel> readSootModel(const Deck& deck, const Mechanism& mechanism);

// What to do where soot outgrows the sections of its model (`soot.sectional.overflow`).
inline constexpr const char* tooFewSections =
    "More sections ('soot.sectional.sections') or a larger 'soot.sectional.factor' help; 'soot.sectional.overflow: 1' "
    "only "
    "counts it";

// `soot.pah`, with the sticking coefficients of `soot.sticking` where that key exists and is given, else the published
// ones (Blanquart and Pitsch 2009) or those of the law behind them. InputError for what is not a hydrocarbon.
[[nodiscard]] std::vector<PahSpecies> readPahSpecies(const Deck& deck, const Mechanism& mechanism);

// What the section `soot` of a flame says of surface, PAH and switches, with the mechanism's atomic weights; what it
// leaves open as published with its model.
[[nodiscard]] SootModelOptions readSootModelOptions(const Deck& deck, const Mechanism& mechanism);

}  // namespace lampblack
