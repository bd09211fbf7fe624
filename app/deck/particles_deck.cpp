#include "app/deck/particles_deck.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/deck/ensemble_deck.hpp"
#include "app/deck/former_particles.hpp"
#include "app/deck/molecules_deck.hpp"
#include "app/deck/sample_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/deck/trees_deck.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app {
namespace {

void addDescription(DeckSchema& schema, const ParticlePlace& place, const std::vector<SootModelEntry>& models) {
  std::vector<std::string> names, all;
  std::string words;
  for (const SootModelEntry& model : models) {
    names.push_back(model.name);
    words += model.name + ": " + model.description + "; ";
  }
  all = names;
  for (const char* other : {"ensemble", "trees", "molecules", "none"}) all.emplace_back(other);
  names.emplace_back("none");
  schema
      .section(particleSection, place.presence,
               place.description +
                   " In place of the sections 'soot' and 'stochastic' of former versions, which "
                   "are read as parts of this one, with a note.")
      .add(
          choiceKey(
              descriptionKey, all,
              "What describes the particles. Models of soot that the gas carries: " + words +
                  "ensemble: numerical particles by Monte Carlo, as key shape says; trees: the same as trees of "
                  "primaries that share surface; molecules: trees of primaries that hold molecules, which grow site by "
                  "site; none: as if the section were absent.")
              .formerly("two_equation", "two_equation_dimer"))
      .add(choiceKey(materialKey, {"soot", "silica", "table"},
                     "What particles are made of. soot: carbon and hydrogen, by PAH, surface and switches. With trees, "
                     "or an ensemble by surface_volume, also silica: Si, O and OH from H4O4SI, which is Si(OH)4, "
                     "giving back H2O (Shekar, Smith, Kraft, Wagner 2011), rates of sintering and of the surface "
                     "reaction as in the input of the program MOpS; table: components and reactions of "
                     "particles.table.")
               .byDefault("soot"));
  if (!place.besideModel) return;
  schema.add(choiceKey(carriedKey, names,
                       "Model of soot that the gas carries beside an ensemble or trees, as it is solved with, from "
                       "the names of the key description.")
                 .byDefault("none")
                 .formerly("two_equation", "two_equation_dimer")
                 .onlyWith(ofPopulations()));
}

// Of more than one description, or more than one material.
void addShared(DeckSchema& schema, const ParticlePlace& place) {
  SectionKeys keys("particles");
  keys.quantity("density", units::density, rules().optional().above(0),
                "Density of particles; absent: of soot 1850 kg/m^3, with sectional and moss_brookes 1800, with leung "
                "2000, of molecules 1470; of silica 2200 kg/m^3. A material of the deck's own needs it.");
  keys.number("van_der_waals", rules().formerly("enhancement").byDefault("2.2").above(0),
              "Factor by which van der Waals forces enhance free-molecular collisions of particles, and of the dimers "
              "of soot.");
  keys.boolean("coagulation", rules().byDefault("true"), "Whether particles that collide become one.");
  keys.boolean("diffusion", rules().byDefault("true"),
               "Whether particles diffuse by Brownian motion. Those that are followed along paths never do.");
  const DeckCondition treesOrOther{descriptionKey, {"trees"}, {ofOtherMaterials()}};
  SectionKeys populations("particles");
  populations.choice(
      "slip", {"davies", "air"}, rules().byDefault("davies").byDefault("air", {ofOtherMaterials()}),
      "Slip correction in collisions. davies: Davies (1945), by the gas's mean free path; air: 1 + 1.257 Kn, Kn that "
      "of air at the gas's temperature and pressure (Shekar et al. 2011, eqs. 37, 38).");
  populations.add(sampleNumberKey(particleSection, place.ensembleNumber)
                      .formerly("particles")
                      .byDefault(place.treeNumber, {treesOrOther}));
  populations.add(splitToleranceKey(particleSection, "0.01")
                      .byDefault("0.05", {{descriptionKey, {"trees", "molecules"}, {ofOtherMaterials()}}}));
  addSizeBinKeys(populations.schema(), particleSection);
  for (DeckKey& key : sootParticleKeys(particleSection)) populations.add(key.onlyWith(ofSoot()));
  keys.schema().add(populations.schema(), ofPopulations());
  keys.number("fractal_dimension",
              rules().optional().atLeast(1).atMost(3).onlyWith(
                  {descriptionKey, {"trees", "molecules", "none"}, {{"particles.shape", {"surface_volume"}}}}),
              "Fractal dimension D_f in the diameter of collision, d_p n_p^(1/D_f) of n_p primaries of d_p. Absent: "
              "silica, trees of soot and molecules: 1.8, a table: 3; of an ensemble of soot by surface_volume the mean "
              "of the diameters of the spheres of the particle's volume and of its surface.");
  schema.add(keys.schema());
}

std::string textOfDescription(const Deck& deck) {
  return deck.has(particleSection) ? deck.choice(descriptionKey) : "none";
}

}  // namespace

DeckCondition ofSoot() {
  return {materialKey, {"soot"}};
}
DeckCondition ofPopulations() {
  return {descriptionKey, {"ensemble", "trees", "molecules", "none"}};
}
DeckCondition ofEnsembles() {
  return {descriptionKey, {"ensemble", "none"}};
}
DeckCondition ofTrees() {
  return {descriptionKey, {"trees", "none"}};
}
DeckCondition ofMolecules() {
  return {descriptionKey, {"molecules", "none"}};
}
DeckCondition ofPrimaries() {
  return {descriptionKey, {"trees", "molecules", "none"}};
}
DeckCondition ofEqualWeights() {
  return {descriptionKey, {"trees", "molecules", "none"}, {ofOtherMaterials()}};
}
DeckCondition ofTreesOrOtherMaterials() {
  return {descriptionKey, {"trees", "none"}, {ofOtherMaterials()}};
}
DeckCondition ofOtherMaterials() {
  return {materialKey, {"silica", "table"}};
}

DeckCondition ofModels(const DeckSchema& schema, std::vector<std::string> models) {
  DeckCondition condition{descriptionKey, models};
  condition.choices.emplace_back("none");
  if (std::ranges::any_of(schema.keys(), [](const DeckKey& key) { return key.path == carriedKey; }))
    condition.others.push_back({carriedKey, std::move(models)});
  return condition;
}

void addParticleKeys(DeckSchema& schema, const ParticlePlace& place, const std::vector<SootModelEntry>& models) {
  addDescription(schema, place, models);
  addEnsembleKeys(schema, place.method);
  addShared(schema, place);
  addSootModelKeys(schema, models);
  addTreeKeys(schema);
  addMoleculeKeys(schema);
  schema.formerly(formerParticleSections(place.besideModel));
}

bool hasPopulation(const Deck& deck) {
  const std::string description = textOfDescription(deck);
  return description == "ensemble" || description == "trees" || description == "molecules";
}

bool isOfTrees(const Deck& deck) {
  if (!hasPopulation(deck) || isOfMolecules(deck)) return false;
  return deck.choice(descriptionKey) == "trees" || deck.choice(materialKey) != "soot";
}

bool isOfMolecules(const Deck& deck) {
  return textOfDescription(deck) == "molecules";
}

std::string carriedModel(const Deck& deck) {
  if (!hasPopulation(deck)) return textOfDescription(deck);
  return deck.has(carriedKey) ? deck.choice(carriedKey) : "none";
}

std::string carriedModelKey(const Deck& deck) {
  return hasPopulation(deck) ? carriedKey : descriptionKey;
}

void requireDescription(const Deck& deck) {
  if (textOfDescription(deck) == "none") return;
  const std::string material = deck.choice(materialKey);
  if (material == "soot") return;
  if (isOfMolecules(deck))
    throw deck.error(descriptionKey, fmt::format("molecules are of soot, the particles are of {}", material));
  if (const std::string model = carriedModel(deck); model != "none")
    throw deck.error(carriedModelKey(deck),
                     fmt::format("{} is a model of soot, the particles are of {}: expected 'trees', or 'ensemble' with "
                                 "'shape: surface_volume'",
                                 model, material));
  if (deck.choice(descriptionKey) == "ensemble" && deck.choice("particles.shape") != "surface_volume")
    throw deck.error("particles.shape",
                     fmt::format("{} are of soot; expected 'surface_volume', or 'description: trees'",
                                 deck.choice("particles.shape")));
}

}  // namespace lampblack::app
