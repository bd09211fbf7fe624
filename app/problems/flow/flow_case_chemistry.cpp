// The section chemistry of a flow deck.
#include "app/problems/flow/flow_case_parts.hpp"
#include "io/deck_keys.hpp"

namespace lampblack::app::flowcase {
namespace {

constexpr const char* mapSection = "chemistry.reference_map";

DeckKeys<ReactionOperator::Options> chemistryKeys() {
  using Options = ReactionOperator::Options;
  using Reactor = ConstantPressureReactor::Options;
  DeckKeys<Options> keys("chemistry");
  keys.boolean("share_work", &Options::shareWork, rules().byDefault("true"),
               "Whether cells with costly chemistry are sent to less busy ranks.");
  keys.number("relative_tolerance", inner(&Options::reactor, &Reactor::relativeTolerance),
              rules().byDefault("1e-6").above(0).below(1),
              "Relative tolerance of the stiff solver of the chemistry: smaller is more accurate and slower.");
  keys.integer("rosenbrock_steps", inner(&Options::reactor, &Reactor::rosenbrockSteps),
               rules().byDefault("10").atLeast(0).atMost(1000),
               "Steps of a Rosenbrock method in which the chemistry of a cell has to be done, four times as many in "
               "vector lanes; a cell that needs more is integrated by CVODE. 0: CVODE for all cells.");
  keys.number("absolute_tolerance", inner(&Options::reactor, &Reactor::absoluteTolerance),
              rules().byDefault("1e-12").above(0).below(1),
              "Absolute tolerance of the stiff solver of the chemistry, in mass fraction: smaller is more accurate and "
              "slower.");
  return keys;
}

DeckKeys<ReferenceMap::Options> mapKeys() {
  using Options = ReferenceMap::Options;
  DeckKeys<Options> keys(mapSection);
  keys.section(Presence::optional,
               "Cells of nearly the same gas take the reactions of one of them in steps of time; the report tells the "
               "error. Absent: each cell has its own.");
  addStreamKeys(keys, "");
  keys.number(
      "mixture_fraction", &Options::mixtureWidth, rules().atLeast(1e-9).atMost(1),
      "Width of the bins of the mixture fraction (Bilger's, by the two streams) in which gas is nearly the same.");
  keys.quantity("temperature", units::temperature, &Options::temperatureWidth, rules().atLeast(1e-9),
                "Width of the bins of the temperature.");
  keys.number(
      "log_density", &Options::densityWidth, rules().atLeast(1e-9),
      "Width of the bins of the logarithm of the density: about the relative difference of densities in a bin.");
  keys.number(
      "checked", &Options::checked, rules().atLeast(0).atMost(1),
      "Share of the cells with others' reactions whose own are found as well, each step other ones, to tell the "
      "error. They keep the others'.");
  return keys;
}

}  // namespace

void addChemistryKeys(DeckSchema& schema) {
  schema.add(chemistryKeys().schema());
  schema.add(mapKeys().schema());
}

void readChemistry(const Deck& deck, FlowCase& flowCase) {
  flowCase.chemistry = chemistryKeys().read(deck);
  if (deck.has(mapSection))
    flowCase.chemistry.map.emplace(mapKeys().read(deck), readMixtureFraction(deck, mapSection, flowCase));
}

}  // namespace lampblack::app::flowcase
