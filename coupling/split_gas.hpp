// The gas of each kind of reactor, as SplitReactor takes its equations. Energy is what a step keeps; of a reactor whose
// temperature is given, set `kept` to that.
#pragma once

#include "chemistry/reactor/closed_reactor.hpp"
#include "chemistry/reactor/plug_flow.hpp"
#include "chemistry/reactor/reactor_network.hpp"
#include "coupling/gas_along.hpp"
#include "coupling/split_reactor.hpp"

namespace lampblack::coupling {

// The equations have to live as long as the result.
SplitReactor::Gas splitGas(ClosedReactor& reactor, ReactorSystem::Held held);
SplitReactor::Gas splitGas(PlugFlow& flow, double pressure);  // Pa, of the inlet
SplitReactor::Gas splitGas(NetworkSystem& system);
SplitReactor::Gas splitGas(GasAlong& gas);

}  // namespace lampblack::coupling
