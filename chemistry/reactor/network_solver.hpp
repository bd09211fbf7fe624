// The steady state of a network of stirred reactors. Reactors that no recycle joins are solved one after the other
// along the stream; those of a recycle together. From a burnt start the state is a burning one wherever there is one
// (burning_branch.hpp).
#pragma once

#include <optional>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "chemistry/reactor/reactor_network.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

// Where the transient to the steady state begins: with the equilibrium of what flows in (at constant enthalpy), with
// what flows in as it is, or with a given gas. A given temperature of a reactor holds in any case.
struct NetworkStart {
  bool burnt = true;
  std::optional<GasState> given = std::nullopt;
};

struct ReactorSteadyState {
  GasState state;
  double massFlow = 0;       // kg/s through the reactor
  double density = 0;        // kg/m3
  double residenceTime = 0;  // s
  double volume = 0;         // m3
  double heatRelease = 0;    // W/m3
  double residual = 0;       // SteadyState::residual of its group
  long steps = 0;            // of the transient of its group
  // Of a reactor that is cold though what flows into its group could burn, from a burnt start: whether no burning state
  // was found, and its residence time (s) in the last one where larger reactors burn.
  bool out = false;
  std::optional<double> lastBurningTime = std::nullopt;
};

// The groups in the order in which they can be solved: each a set of reactors joined by recycles (strongly connected;
// Tarjan 1972), by number.
std::vector<std::vector<std::size_t>> solutionOrder(const ReactorNetwork& network);

// The start of a reactor, or of all in a group, fed by `inflows` alone: mass fractions and temperature.
GasState startOf(const Mechanism& mechanism, const ReactorNetwork& network, const NetworkStart& start);

// The same as unknowns of NetworkSystem, with none of the `carried` scalars of a phase.
std::vector<double> startUnknowns(const Mechanism& mechanism, const ReactorNetwork& network, const NetworkStart& start,
                                  std::size_t carried = 0);

// In the order of the reactors, with the amounts of a carried phase in their states. NumericsError as findSteadyState.
std::vector<ReactorSteadyState> solveNetwork(const Mechanism& mechanism, const ReactorNetwork& network,
                                             const NetworkStart& start, CarriedPhase* carried = nullptr);

}  // namespace lampblack::chemistry
