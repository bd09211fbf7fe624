#include <fmt/format.h>

#include "app/deck/particles_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/deck/soot_models/soot_models.hpp"
#include "io/deck_keys.hpp"
#include "particles/models/semi_empirical/semi_empirical_soot.hpp"

namespace lampblack::app {
namespace {

// Each absent one is as published with the model.
DeckKeys<SemiEmpiricalOptions> semiEmpiricalKeys() {
  using Options = SemiEmpiricalOptions;
  using Oxygen = Options::Oxygen;
  const DeckKey factor = rules().optional().atLeast(0);
  DeckKeys<Options> keys("particles.semi_empirical");
  keys.quantity("inception_factor", units::frequency, &Options::inceptionFactor, factor,
                "Factor A of the rate of inception, A exp(-Ta/T) [C2H2], acetylene per volume and time: bigger "
                "makes more nuclei.");
  keys.quantity("inception_temperature", units::temperature, &Options::inceptionTemperature, factor,
                "Activation temperature Ta of the rate of inception, A exp(-Ta/T) [C2H2].");
  keys.number("nucleus_carbon", &Options::nucleusCarbon, rules().optional().above(0),
              "Number of carbon atoms of a new particle (nucleus): bigger makes fewer of the same mass.");
  keys.number("growth_factor", &Options::growthFactor, factor,
              "Factor A of the rate of surface growth, A exp(-Ta/T) [C2H2] f, with f = S, the surface of soot "
              "per volume (A in m/s), or f = sqrt(S) (A in m^0.5/s).");
  keys.quantity("growth_temperature", units::temperature, &Options::growthTemperature, factor,
                "Activation temperature Ta of the rate of surface growth, A exp(-Ta/T) [C2H2] f.");
  keys.choice("growth_surface", &Options::growthByRootOfSurface, {{"linear", false}, {"root", true}},
              rules().optional(),
              "How surface growth depends on the surface of soot per volume S: linear: f = S; root: f = "
              "sqrt(S), with which growth does not double where the surface doubles.");
  keys.number("coagulation_factor", &Options::coagulation, factor,
              "Factor on the rate of free-molecular coagulation of equal spheres: bigger makes fewer and larger "
              "particles.");
  keys.choice("oxygen", &Options::oxygen,
              {{"none", Oxygen::none}, {"leung", Oxygen::leung}, {"lee", Oxygen::lee}, {"nagle", Oxygen::nagle}},
              rules().optional(),
              "Law of oxidation by O2: leung: Leung, Lindstedt, Jones (1991); lee: Lee, Thring, Beer (1962); "
              "nagle: Nagle, Strickland-Constable (1962); none: O2 does not oxidise.");
  keys.number("oxidation_factor", &Options::oxidationFactor, factor,
              "Factor on the rates of all oxidation of soot; 1 is the published rate.");
  return keys;
}

void addSemiEmpiricalKeys(DeckSchema& schema) {
  schema.add(semiEmpiricalKeys().schema())
      .section("particles.semi_empirical", Presence::optional,
               "Constants of leung and moss_brookes; each absent one is as published with the model.",
               {ofModels(schema, {"leung", "moss_brookes"})});
}

// The semi-empirical models know acetylene only; ensembles beside them read these keys.
void refuseUnread(const Deck& deck) {
  if (hasPopulation(deck) || deck.has("trajectories")) return;
  for (const char* key : {"sticking", "site_density", "alpha", "alpha_table", "van_der_waals", "condensation"})
    if (const std::string path = std::string("particles.") + key; deck.isGiven(path))
      throw deck.error(path, fmt::format("the model {} does not use this key; leave it out or choose another one",
                                         carriedModel(deck)));
}

std::unique_ptr<ParticleModel> readSemiEmpirical(const Deck& deck, const Mechanism& mechanism,
                                                 SemiEmpiricalOptions options) {
  refuseUnread(deck);
  options.carbonWeight = readSootWeights(deck, mechanism).carbon;
  options.density = deck.optionalQuantity("particles.density").value_or(options.density);
  options.ohEfficiency = deck.optionalNumber("particles.oh_efficiency").value_or(options.ohEfficiency);
  options.inception = deck.boolean("particles.inception");
  options.growth = deck.boolean("particles.growth");
  options.oxidation = deck.boolean("particles.oxidation");
  options.coagulating = deck.boolean("particles.coagulation");
  semiEmpiricalKeys().read(deck, options, "particles.semi_empirical");
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
