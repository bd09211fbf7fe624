#include <fmt/format.h>

#include <optional>

#include "app/deck/particles_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/deck/soot_models/soot_models.hpp"
#include "particles/models/semi_empirical/semi_empirical_soot.hpp"

namespace lampblack::app {
namespace {

void addSemiEmpiricalKeys(DeckSchema& schema) {
  const std::string s = "particles.semi_empirical.";
  schema
      .section("particles.semi_empirical", Presence::optional,
               "Constants of leung and moss_brookes; each absent one is as published with the model.",
               {ofModels(schema, {"leung", "moss_brookes"})})
      .add(quantityKey(s + "inception_factor", units::frequency,
                       "Factor A of the rate of inception, A exp(-Ta/T) [C2H2], acetylene per volume and time: bigger "
                       "makes more nuclei.")
               .optional()
               .atLeast(0))
      .add(quantityKey(s + "inception_temperature", units::temperature,
                       "Activation temperature Ta of the rate of inception, A exp(-Ta/T) [C2H2].")
               .optional()
               .atLeast(0))
      .add(numberKey(s + "nucleus_carbon",
                     "Number of carbon atoms of a new particle (nucleus): bigger makes fewer of the same mass.")
               .optional()
               .above(0))
      .add(numberKey(s + "growth_factor",
                     "Factor A of the rate of surface growth, A exp(-Ta/T) [C2H2] f, with f = S, the surface of soot "
                     "per volume (A in m/s), or f = sqrt(S) (A in m^0.5/s).")
               .optional()
               .atLeast(0))
      .add(quantityKey(s + "growth_temperature", units::temperature,
                       "Activation temperature Ta of the rate of surface growth, A exp(-Ta/T) [C2H2] f.")
               .optional()
               .atLeast(0))
      .add(choiceKey(s + "growth_surface", {"linear", "root"},
                     "How surface growth depends on the surface of soot per volume S: linear: f = S; root: f = "
                     "sqrt(S), with which growth does not double where the surface doubles.")
               .optional())
      .add(numberKey(s + "coagulation_factor",
                     "Factor on the rate of free-molecular coagulation of equal spheres: bigger makes fewer and larger "
                     "particles.")
               .optional()
               .atLeast(0))
      .add(choiceKey(s + "oxygen", {"none", "leung", "lee", "nagle"},
                     "Law of oxidation by O2: leung: Leung, Lindstedt, Jones (1991); lee: Lee, Thring, Beer (1962); "
                     "nagle: Nagle, Strickland-Constable (1962); none: O2 does not oxidise.")
               .optional())
      .add(numberKey(s + "oxidation_factor", "Factor on the rates of all oxidation of soot; 1 is the published rate.")
               .optional()
               .atLeast(0));
}

// The semi-empirical models know acetylene only; ensembles beside them read these keys.
void refuseUnread(const Deck& deck) {
  if (hasPopulation(deck) || deck.has("trajectories")) return;
  for (const char* key : {"sticking", "site_density", "alpha", "alpha_table", "van_der_waals", "condensation"})
    if (const std::string path = std::string("particles.") + key; deck.isGiven(path))
      throw deck.error(path, fmt::format("the model {} does not use this key; leave it out or choose another one",
                                         carriedModel(deck)));
}

template <class T>
void set(T& value, const std::optional<double>& given) {
  if (given) value = *given;
}

std::unique_ptr<ParticleModel> readSemiEmpirical(const Deck& deck, const Mechanism& mechanism,
                                                 SemiEmpiricalOptions options) {
  refuseUnread(deck);
  using Oxygen = SemiEmpiricalOptions::Oxygen;
  const auto number = [&](const char* key) {
    return deck.optionalNumber(std::string("particles.semi_empirical.") + key);
  };
  const auto quantity = [&](const char* key) {
    return deck.optionalQuantity(std::string("particles.semi_empirical.") + key);
  };
  options.carbonWeight = readSootWeights(deck, mechanism).carbon;
  set(options.density, deck.optionalQuantity("particles.density"));
  set(options.ohEfficiency, deck.optionalNumber("particles.oh_efficiency"));
  options.inception = deck.boolean("particles.inception");
  options.growth = deck.boolean("particles.growth");
  options.oxidation = deck.boolean("particles.oxidation");
  options.coagulating = deck.boolean("particles.coagulation");
  set(options.inceptionFactor, quantity("inception_factor"));
  set(options.inceptionTemperature, quantity("inception_temperature"));
  set(options.nucleusCarbon, number("nucleus_carbon"));
  set(options.growthFactor, number("growth_factor"));
  set(options.growthTemperature, quantity("growth_temperature"));
  if (const auto surface = deck.optionalString("particles.semi_empirical.growth_surface"))
    options.growthByRootOfSurface = *surface == "root";
  set(options.coagulation, number("coagulation_factor"));
  set(options.oxidationFactor, number("oxidation_factor"));
  if (const auto oxygen = deck.optionalString("particles.semi_empirical.oxygen"))
    options.oxygen = *oxygen == "leung"   ? Oxygen::leung
                     : *oxygen == "lee"   ? Oxygen::lee
                     : *oxygen == "nagle" ? Oxygen::nagle
                                          : Oxygen::none;
  return makeSootModel<SemiEmpiricalSoot>(deck, options);
}

SootModelOptions semiEmpiricalDefaults() {
  return {};
}

std::unique_ptr<ParticleModel> readLeung(const Deck& deck, const Mechanism& mechanism) {
  return readSemiEmpirical(deck, mechanism, leungSoot());
}

std::unique_ptr<ParticleModel> readMossBrookes(const Deck& deck, const Mechanism& mechanism) {
  return readSemiEmpirical(deck, mechanism, mossBrookesSoot());
}

}  // namespace

SootModelEntry leungEntry() {
  return {"leung", "number and mass, nuclei of acetylene (Leung, Lindstedt, Jones 1991)", addSemiEmpiricalKeys,
          semiEmpiricalDefaults, readLeung};
}

SootModelEntry mossBrookesEntry() {
  return {"moss_brookes", "number and mass, nuclei of acetylene (Brookes and Moss 1999)", nullptr,
          semiEmpiricalDefaults, readMossBrookes};
}

}  // namespace lampblack::app
