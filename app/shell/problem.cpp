#include "app/shell/problem.hpp"

#include <stdexcept>

#include "app/deck/other_names.hpp"
#include "app/problems/aggregates/aggregates_case.hpp"
#include "app/problems/engine/engine_case.hpp"
#include "app/problems/flame/flame_case.hpp"
#include "app/problems/flow/flow_case.hpp"
#include "app/problems/pah/pah_case.hpp"
#include "app/problems/population/population_case.hpp"
#include "app/problems/prescribed_gas/prescribed_gas_case.hpp"
#include "app/problems/reactor/reactor_case.hpp"

namespace lampblack::app {

const std::vector<Problem>& problems() {
  static const std::vector<Problem> table{
      {"flow", "A reacting flow on a mesh, with or without soot.", flowSchema, prepareFlow, true},
      {"flame1d", "One-dimensional flames: free, burner-stabilised, against a wall, counterflow; with or without soot.",
       flameSchema, prepareFlame},
      {"reactor",
       "Reactors without space: closed at constant pressure or volume, perfectly stirred, plug flow, networks.",
       reactorSchema, prepareReactor},
      {"prescribed_gas",
       "Particles in a prescribed gas: its history in a table, or the path through a one-dimensional flame that is "
       "there "
       "already; ensembles or any model of soot.",
       prescribedGasSchema, preparePrescribedGas},
      {"population_balance",
       "A population of particles in a well-stirred volume of gas: Monte Carlo, sectional and moment methods, "
       "compared.",
       populationSchema, preparePopulation},
      {"pah",
       "Single molecules of polycyclic aromatic hydrocarbons that grow site by site, by kinetic Monte Carlo, in a gas "
       "that is constant, of a table, or along a one-dimensional flame.",
       pahSchema, preparePah, true},
      {"aggregates",
       "Aggregates of overlapping spheres with places in space, joined on straight lines, that grow and sinter: their "
       "shape, and pictures of them.",
       aggregatesSchema, prepareAggregates},
      {"engine",
       "The gas of an engine's cylinder while its valves are closed, as particles that mix, react and lose heat at one "
       "pressure: the stochastic reactor model.",
       engineSchema, prepareEngine, true},
  };
  return table;
}

DeckKinds deckKinds(const std::vector<Problem>& table) {
  DeckKinds kinds{"problem", {}};
  for (const Problem& problem : table) {
    kinds.kinds.push_back({problem.name, problem.doc, problem.schema()});
    kinds.kinds.back().schema.calledElsewhere(otherNamesOfKeysAndChoices());
  }
  return kinds;
}

const Problem& problemOf(const Deck& deck, const std::vector<Problem>& table) {
  const std::string name = deck.choice("problem");
  for (const Problem& problem : table)
    if (problem.name == name) return problem;
  throw std::logic_error("a deck was read with another list of problems");
}

}  // namespace lampblack::app
