#include "particles/models/moments/hmom.hpp"

#include "app/deck/particles_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/deck/soot_models/soot_models.hpp"

namespace lampblack::app {
namespace {

void addHmomKeys(DeckSchema& schema) {
  schema.section("particles.hmom", Presence::defaulted, "Constants of the model hmom.", {ofModels(schema, {"hmom"})})
      .add(numberKey(
               "particles.hmom.fractal_dimension",
               "Fractal dimension D_f in the collision diameter of aggregates, d_p n_p^(1/D_f): smaller is more open.")
               .byDefault("1.8")
               .above(1)
               .atMost(3))
      .add(numberKey("particles.hmom.surface_exponent",
                     "Exponent e in the growth of an aggregate's surface with its volume, dS/dV = 2/3 S/V n_p^(-e), "
                     "n_p the number of primary particles.")
               .byDefault("0.2043")
               .atLeast(0));
}

SootModelOptions hmomDefaults() {
  return HmomOptions{}.soot;
}

std::unique_ptr<ParticleModel> readHmom(const Deck& deck, const Mechanism& mechanism) {
  HmomOptions options;
  options.soot = readSootModelOptions(deck, mechanism, hmomDefaults());
  options.fractalDimension = deck.number("particles.hmom.fractal_dimension");
  options.surfaceExponent = deck.number("particles.hmom.surface_exponent");
  return makeSootModel<HmomSoot>(deck, options);
}

}  // namespace

SootModelEntry hmomEntry() {
  return {"hmom", "hybrid method of moments (Mueller, Blanquart, Pitsch 2009)", addHmomKeys, hmomDefaults, readHmom};
}

}  // namespace lampblack::app
