// The section combustion of a flow deck.
#include <fmt/format.h>

#include "app/problems/flow/flow_case_parts.hpp"
#include "io/deck_keys.hpp"

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

DeckKeys<CombustionOperator::Options> combustionKeys() {
  using Options = CombustionOperator::Options;
  DeckKeys<Options> keys("combustion");
  keys.section(Presence::optional,
               "How turbulence, of a 'turbulence.model', and reactions act on each other. Absent: laminar.");
  keys.choice("model", {"laminar", "pasr", "edc"}, rules().byDefault("laminar"),
              "laminar: the reactions are those of the mean gas. pasr: the partially stirred reactor; the rates are "
              "those of the mean gas times kappa = tau_c/(tau_c + tau_mix), of the time of the reactions and that of "
              "mixing. edc: the eddy dissipation concept; the gas reacts in fine structures for the time they last.");
  keys.choice("chemical_time", &Options::chemicalTime,
              {{"weighted_reactions", Kind::WeightedReactions},
               {"reactions_of6", Kind::ReactionsOf6},
               {"slowest_species", Kind::SlowestSpecies}},
              rules().byDefault("weighted_reactions").onlyWith(modelKey, {"pasr"}),
              "tau_c. weighted_reactions: all concentrations over the mean of what the reactions make, weighted by "
              "what each makes; reactions_of6: over what the mean reaction makes forward, which grows with the number "
              "of reactions (OpenFOAM 6); slowest_species: the longest time in which a species would be used up. At "
              "most 1 s. They differ by orders of magnitude.");
  keys.choice("mixing_time", &Options::mixingTime,
              {{"effective", MixingTime::Effective},
               {"kolmogorov", MixingTime::Kolmogorov},
               {"geometric", MixingTime::Geometric},
               {"integral", MixingTime::Integral}},
              rules().byDefault("effective").onlyWith(modelKey, {"pasr"}),
              "tau_mix, of viscosities nu, k and epsilon. effective: C ((nu + nu_t)/epsilon)^0.5; kolmogorov: "
              "(nu/epsilon)^0.5; geometric: the root of this and k/epsilon; integral: C k/epsilon.");
  keys.number("mixing_constant", &Options::mixingConstant,
              rules().byDefault("0.3").above(0).onlyWith(modelKey, {"pasr"}),
              "C of the effective and the integral time.");
  keys.choice("version", {"2005", "1996", "1981"}, rules().byDefault("2005").onlyWith(modelKey, {"edc"}),
              "Share of fine structures of the size gamma: gamma^a/(1 - gamma^b), with a, b = 2, 2 (2005), 2, 3 (1996) "
              "or 3, 3 (1981); at most one.");
  keys.number("laminar_below", &Options::laminarBelow,
              rules().byDefault("0.1").atLeast(0).onlyWith(modelKey, {"pasr", "edc"}),
              "Eddy viscosity over that of the molecules, below which the reactions are those of the mean gas: where "
              "turbulence dies out mixing takes for ever, and both models would put out the flame. 0: they may.");
  keys.choice("dissipation", &Options::dissipationOfShear, {{"model", false}, {"shear", true}},
              rules().byDefault("model").onlyWith(modelKey, {"pasr", "edc"}),
              "epsilon. model: of the turbulence model, which has to know k; shear: nu_t S^2 of any model, the shear's "
              "production, with k = nu_t S/0.3.");
  keys.choice("soot_factor", {"one", "kappa"}, rules().byDefault("one").onlyWith(modelKey, {"pasr"}),
              "What the rates of particles of a model, and of what they take from the gas, are multiplied with. one: "
              "nothing; kappa: as those of the reactions.");
  return keys;
}

}  // namespace

void addCombustionKeys(DeckSchema& schema) {
  schema.add(combustionKeys().schema());
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
  CombustionOperator::Options options = combustionKeys().read(deck);
  if (!options.dissipationOfShear && !turbulence->knowsEnergy())
    throw deck.error(modelKey,
                     fmt::format("'{}' goes by the dissipation of turbulence, which '{}' does not know; expected "
                                 "another 'turbulence.model', or 'combustion.dissipation: shear'",
                                 model, turbulence->name()));
  if (model == "edc") {
    if (deck.has("chemistry.reference_map"))
      throw deck.error("chemistry.reference_map",
                       "fine structures of 'edc' react for times of their own, which cells of nearly the same gas do "
                       "not share; leave it out, or take 'combustion.model: pasr'");
    options.model = Model::EddyDissipation;
    options.fine = fineStructures(deck.choice("combustion.version"));
  } else {
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
