// The section `particles` of every problem: what the particles are made of, and what describes them - a model that the
// gas carries, an ensemble of numerical particles, trees of primaries, or molecules. Keys whose meaning is one stand
// once.
#pragma once

#include <string>
#include <vector>

#include "app/deck/soot_models/soot_models.hpp"
#include "core/modules.hpp"
#include "io/deck.hpp"

namespace lampblack::app {

inline constexpr const char *particleSection = "particles", *descriptionKey = "particles.description",
                            *materialKey = "particles.material", *carriedKey = "particles.carried";

// What differs from problem to problem.
struct ParticlePlace {
  std::string description;  // of the section
  Presence presence = Presence::optional;
  bool besideModel = false;  // whether the gas may carry a model beside an ensemble or trees (`particles.carried`)
  std::string method = "sammc", ensembleNumber = "2000", treeNumber = "8192";  // defaults
};

// The section with the keys that all problems have.
void addParticleKeys(DeckSchema& schema, const ParticlePlace& place,
                     const std::vector<SootModelEntry>& models = sootModels());

// Conditions of keys. `description: none` is as if there were no particles, and leaves keys as they are.
[[nodiscard]] DeckCondition ofSoot();         // by material
[[nodiscard]] DeckCondition ofPopulations();  // ensembles, trees and molecules
[[nodiscard]] DeckCondition ofEnsembles();
[[nodiscard]] DeckCondition ofTrees();
[[nodiscard]] DeckCondition ofMolecules();
[[nodiscard]] DeckCondition ofPrimaries();  // trees, of molecules or not
// Trees, and whatever is not soot, which trees or a surface describe.
[[nodiscard]] DeckCondition ofTreesOrOtherMaterials();
// These and molecules, whose numerical particles all have one weight.
[[nodiscard]] DeckCondition ofEqualWeights();
// Materials other than soot.
[[nodiscard]] DeckCondition ofOtherMaterials();
// Some of the models, also where the gas carries one beside other particles.
[[nodiscard]] DeckCondition ofModels(const DeckSchema& schema, std::vector<std::string> models);

// Whether a deck asks for an ensemble, trees or molecules.
[[nodiscard]] bool hasPopulation(const Deck& deck);
// Whether the particles are TreeEnsembles: trees, or by volume and surface of another material than soot.
[[nodiscard]] bool isOfTrees(const Deck& deck);
[[nodiscard]] bool isOfMolecules(const Deck& deck);
// The model that the gas carries, "none" without, and the key that says so.
[[nodiscard]] std::string carriedModel(const Deck& deck);
[[nodiscard]] std::string carriedModelKey(const Deck& deck);
// InputError where material, description and shape do not go together.
void requireDescription(const Deck& deck);

}  // namespace lampblack::app
