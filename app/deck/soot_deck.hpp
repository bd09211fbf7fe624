// The section `soot` of every problem: its keys, and the model it asks for.
#pragma once

#include <memory>
#include <vector>

#include "app/deck/soot_models/soot_models.hpp"
#include "chemistry/mechanism/mechanism.hpp"
#include "core/errors.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"
#include "particles/gas/soot_gas.hpp"
#include "particles/models/particle_model.hpp"

namespace lampblack::app {

// The keys, for the schema of a problem. An absent section is no soot.
void addSootModelKeys(DeckSchema& schema, const std::vector<SootModelEntry>& models = sootModels());

// The model that a deck asks for, with the mechanism's atomic weights; empty for `model: none` and for a deck without
// the section. InputError, pointing into the deck, for what the mechanism or the model cannot do.
[[nodiscard]] std::unique_ptr<ParticleModel> readSootModel(const Deck& deck, const Mechanism& mechanism,
                                                           const std::vector<SootModelEntry>& models = sootModels());

// What to do where soot outgrows the sections of its model (`soot.sectional.overflow`).
inline constexpr const char* tooFewSections =
    "More sections ('soot.sectional.sections') or a larger 'soot.sectional.factor' help; 'soot.sectional.overflow: 1' "
    "only counts it";

// `soot.pah`, with the sticking coefficients of `soot.sticking` where that key exists and is given, else the published
// ones (Blanquart and Pitsch 2009) or those of the law behind them. InputError for what is not a hydrocarbon.
[[nodiscard]] std::vector<PahSpecies> readPahSpecies(const Deck& deck, const Mechanism& mechanism);

// `active_sites` and `keep_hydrogen` of `section`, which say how stochastic particles of soot take part.
[[nodiscard]] std::vector<DeckKey> sootParticleKeys(const std::string& section);

struct SootWeights {
  double carbon, hydrogen;  // kg/mol
};
// The mechanism's. InputError where it lacks one of the two.
[[nodiscard]] SootWeights readSootWeights(const Deck& deck, const Mechanism& mechanism);

// What the section `soot` says of surface, PAH and switches, with the mechanism's atomic weights; what it leaves open
// as in `defaults`, or as published with its model.
[[nodiscard]] SootModelOptions readSootModelOptions(const Deck& deck, const Mechanism& mechanism,
                                                    SootModelOptions defaults);
[[nodiscard]] SootModelOptions readSootModelOptions(const Deck& deck, const Mechanism& mechanism);

// A model with options from the section; what it refuses points into the deck.
template <class Model, class Options>
[[nodiscard]] std::unique_ptr<ParticleModel> makeSootModel(const Deck& deck, const Options& options) {
  try {
    return std::make_unique<Model>(options);
  } catch (const InputError& error) {
    throw deck.error("soot", error.what());
  }
}

}  // namespace lampblack::app
