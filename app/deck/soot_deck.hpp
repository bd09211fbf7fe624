// Soot in the section `particles`: PAH, surface and switches, and the models that the gas carries.
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

// The keys of PAH, surface and switches, and those of the models.
void addSootModelKeys(DeckSchema& schema, const std::vector<SootModelEntry>& models);

// The model that the gas carries, with the mechanism's atomic weights; empty where it carries none. InputError,
// pointing into the deck, for what the mechanism or the model cannot do.
[[nodiscard]] std::unique_ptr<ParticleModel> readSootModel(const Deck& deck, const Mechanism& mechanism,
                                                           const std::vector<SootModelEntry>& models = sootModels());

// What to do where soot outgrows the sections of its model (`particles.sectional.overflow`).
inline constexpr const char* tooFewSections =
    "More sections ('particles.sectional.sections') or a larger 'particles.sectional.factor' help; "
    "'particles.sectional.overflow: 1' only counts it";

// `particles.pah`, with the sticking coefficients of `particles.sticking` where that key exists and is given, else the
// published ones (Blanquart and Pitsch 2009) or those of the law behind them. InputError for what is not a hydrocarbon.
[[nodiscard]] std::vector<PahSpecies> readPahSpecies(const Deck& deck, const Mechanism& mechanism);

// `active_sites` and `keep_hydrogen` of `section`, which say how stochastic particles of soot take part.
[[nodiscard]] std::vector<DeckKey> sootParticleKeys(const std::string& section);

struct SootWeights {
  double carbon, hydrogen;  // kg/mol
};
// The mechanism's. InputError where it lacks one of the two.
[[nodiscard]] SootWeights readSootWeights(const Deck& deck, const Mechanism& mechanism);

// What the section says of surface, PAH and switches, with the mechanism's atomic weights; what it leaves open
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
    throw deck.error("particles", error.what());
  }
}

}  // namespace lampblack::app
