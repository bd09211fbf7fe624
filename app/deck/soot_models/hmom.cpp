#include "particles/models/moments/hmom.hpp"

#include "app/deck/particles_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/deck/soot_models/soot_models.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app {
namespace {

DeckKeys<HmomOptions> hmomKeys() {
  DeckKeys<HmomOptions> keys("particles.hmom");
  keys.number("fractal_dimension", &HmomOptions::fractalDimension, rules().above(1).atMost(3),
              "Fractal dimension D_f in the collision diameter of aggregates, d_p n_p^(1/D_f): smaller is more open.");
  keys.number("surface_exponent", &HmomOptions::surfaceExponent, rules().atLeast(0),
              "Exponent e in the growth of an aggregate's surface with its volume, dS/dV = 2/3 S/V n_p^(-e), "
              "n_p the number of primary particles.");
  return keys;
}

void addHmomKeys(DeckSchema& schema) {
  schema.add(hmomKeys().schema())
      .section("particles.hmom", Presence::defaulted, "Constants of the model hmom.", {ofModels(schema, {"hmom"})});
}

SootModelOptions hmomDefaults() {
  return HmomOptions{}.soot;
}

std::unique_ptr<ParticleModel> readHmom(const Deck& deck, const Mechanism& mechanism) {
  HmomOptions options;
  options.soot = readSootModelOptions(deck, mechanism, hmomDefaults());
  hmomKeys().read(deck, options, "particles.hmom");
  return makeSootModel<HmomSoot>(deck, options);
}

}  // namespace

SootModelEntry hmomEntry() {
  return {"hmom", "hybrid method of moments (Mueller, Blanquart, Pitsch 2009)", addHmomKeys, hmomDefaults, readHmom};
}

}  // namespace lampblack::app
