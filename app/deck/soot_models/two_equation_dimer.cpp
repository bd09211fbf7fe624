#include "app/deck/soot_deck.hpp"
#include "app/deck/soot_models/soot_models.hpp"
#include "particles/models/two_equation/dimer_soot.hpp"

namespace lampblack::app {
namespace {

SootModelOptions twoEquationDimerDefaults() {
  return {};
}

std::unique_ptr<ParticleModel> readTwoEquationDimer(const Deck& deck, const Mechanism& mechanism) {
  return makeSootModel<DimerSoot>(deck, readSootModelOptions(deck, mechanism, twoEquationDimerDefaults()));
}

}  // namespace

SootModelEntry twoEquationDimerEntry() {
  return {"two_equation_dimer", "number and mass, nuclei of PAH dimers (Wang 2025, section 7.2.2)", nullptr,
          twoEquationDimerDefaults, readTwoEquationDimer};
}

}  // namespace lampblack::app
