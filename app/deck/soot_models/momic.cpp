#include "app/deck/particles_deck.hpp"
#include "app/deck/soot_deck.hpp"
#include "app/deck/soot_models/soot_models.hpp"
#include "particles/models/moments/momic_soot.hpp"

namespace lampblack::app {
namespace {

void addMomicKeys(DeckSchema& schema) {
  schema.add(integerKey("particles.moments",
                        "Number of moments that the model momic carries. With 5 and 6 steady flames may not converge.")
                 .byDefault("4")
                 .atLeast(3)
                 .atMost(6)
                 .onlyWith(ofModels(schema, {"momic"})));
}

SootModelOptions momicDefaults() {
  return MomicOptions{}.soot;
}

std::unique_ptr<ParticleModel> readMomic(const Deck& deck, const Mechanism& mechanism) {
  MomicOptions options;
  options.soot = readSootModelOptions(deck, mechanism, momicDefaults());
  options.moments = deck.integer<std::size_t>("particles.moments");
  return makeSootModel<MomicSoot>(deck, options);
}

}  // namespace

SootModelEntry momicEntry() {
  return {"momic", "moments with interpolative closure (Frenklach 2002)", addMomicKeys, momicDefaults, readMomic};
}

}  // namespace lampblack::app
