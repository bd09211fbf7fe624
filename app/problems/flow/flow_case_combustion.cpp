// The section combustion of a flow deck.
#include <fmt/format.h>

#include "app/problems/flow/flow_case_parts.hpp"

namespace lampblack::app::flowcase {
namespace {

using Model = CombustionOperator::Model;
using Kind = ChemicalTime::Kind;

constexpr const char* modelKey = "combustion.model";

FineStructures fineStructures(const std::string& version) {
  FineStructures fine;
  if (version == "1981") fine.powerAbove = fine.powerBelow = 3.0;
  if (version == "1996") fine.powerBelow = 3.0;
  return fine;
}

MixingTime mixingTimeOf(const std::string& name) {
  if (name == "kolmogorov") return MixingTime::Kolmogorov;
  if (name == "geometric") return MixingTime::Geometric;
  return name == "integral" ? MixingTime::Integral : MixingTime::Effective;
}

Kind chemicalTimeOf(const std::string& name) {
  if (name == "reactions_of6") return Kind::ReactionsOf6;
  return name == "slowest_species" ? Kind::SlowestSpecies : Kind::WeightedReactions;
}

}  // namespace

void addCombustionKeys(DeckSchema& schema) {
  schema
      .section("combustion", Presence::optional,
               "How turbulence, of a 'turbulence.model', and reactions act on each other. Absent: laminar.")
      .add(choiceKey(modelKey, {"laminar", "pasr", "edc"},
                     "laminar: the reactions are those of the mean gas. pasr: the partially stirred reactor; the "
                     "rates are those of the mean gas times kappa = tau_c/(tau_c + tau_mix), of the time of the "
                     "reactions and that of mixing. edc: the eddy dissipation concept; the gas reacts in fine "
                     "structures for the time they last.")
               .byDefault("laminar"))
      .add(choiceKey("combustion.chemical_time", {"weighted_reactions", "reactions_of6", "slowest_species"},
                     "tau_c. weighted_reactions: all concentrations over the mean of what the reactions make, "
                     "weighted by what each makes; reactions_of6: over what the mean reaction makes forward, which "
                     "grows with the number of reactions (OpenFOAM 6); slowest_species: the longest time in which a "
                     "species would be used up. At most 1 s. They differ by orders of magnitude.")
               .byDefault("weighted_reactions")
               .onlyWith(modelKey, {"pasr"}))
      .add(choiceKey("combustion.mixing_time", {"effective", "kolmogorov", "geometric", "integral"},
                     "tau_mix, of viscosities nu, k and epsilon. effective: C ((nu + nu_t)/epsilon)^0.5; kolmogorov: "
                     "(nu/epsilon)^0.5; geometric: the root of this and k/epsilon; integral: C k/epsilon.")
               .byDefault("effective")
               .onlyWith(modelKey, {"pasr"}))
      .add(numberKey("combustion.mixing_constant", "C of the effective and the integral time.")
               .byDefault("0.3")
               .above(0)
               .onlyWith(modelKey, {"pasr"}))
      .add(choiceKey("combustion.version", {"2005", "1996", "1981"},
                     "Share of fine structures of the size gamma: gamma^a/(1 - gamma^b), with a, b = 2, 2 (2005), 2, 3 "
                     "(1996) or 3, 3 (1981); at most one.")
               .byDefault("2005")
               .onlyWith(modelKey, {"edc"}))
      .add(
          numberKey("combustion.laminar_below",
                    "Eddy viscosity over that of the molecules, below which the reactions are those of the mean gas: "
                    "where turbulence dies out mixing takes for ever, and both models would put out the flame. 0: they "
                    "may.")
              .byDefault("0.1")
              .atLeast(0)
              .onlyWith(modelKey, {"pasr", "edc"}))
      .add(choiceKey("combustion.dissipation", {"model", "shear"},
                     "epsilon. model: of the turbulence model, which has to know k; shear: nu_t S^2 of any model, the "
                     "shear's production, with k = nu_t S/0.3.")
               .byDefault("model")
               .onlyWith(modelKey, {"pasr", "edc"}))
      .add(choiceKey("combustion.soot_factor", {"one", "kappa"},
                     "What the rates of particles of a model, and of what they take from the gas, are multiplied with. "
                     "one: nothing; kappa: as those of the reactions.")
               .byDefault("one")
               .onlyWith(modelKey, {"pasr"}));
}

void readCombustion(const Deck& deck, FlowCase& flowCase) {
  if (!deck.has("combustion")) return;
  const std::string model = deck.choice(modelKey);
  if (model == "laminar") return;
  const TurbulenceModel* turbulence = flowCase.turbulence.model.get();
  if (turbulence == nullptr)
    throw deck.error(modelKey, fmt::format("'{}' goes by the turbulence, and the flow has none; expected laminar, or a "
                                           "'turbulence.model'",
                                           model));
  CombustionOperator::Options options;
  options.dissipationOfShear = deck.choice("combustion.dissipation") == "shear";
  if (!options.dissipationOfShear && !turbulence->knowsEnergy())
    throw deck.error(modelKey,
                     fmt::format("'{}' goes by the dissipation of turbulence, which '{}' does not know; expected "
                                 "another 'turbulence.model', or 'combustion.dissipation: shear'",
                                 model, turbulence->name()));
  options.laminarBelow = deck.number("combustion.laminar_below");
  if (model == "edc") {
    options.model = Model::EddyDissipation;
    options.fine = fineStructures(deck.choice("combustion.version"));
  } else {
    options.chemicalTime = chemicalTimeOf(deck.choice("combustion.chemical_time"));
    options.mixingTime = mixingTimeOf(deck.choice("combustion.mixing_time"));
    options.mixingConstant = deck.number("combustion.mixing_constant");
    flowCase.mixesParticles = deck.choice("combustion.soot_factor") == "kappa";
    if (flowCase.mixesParticles && !flowCase.carried)
      throw deck.error("combustion.soot_factor",
                       flowCase.ensembles
                           ? "'kappa' is for the particles of a model, and the deck has ensembles; expected 'one'"
                           : "'kappa' is for the particles of a model, and the deck has none; expected "
                             "'one', or a model as 'particles.description'");
  }
  flowCase.combustion = options;
}

}  // namespace lampblack::app::flowcase
