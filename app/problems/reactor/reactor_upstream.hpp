// A stirred reactor that a stream passes before it enters a duct, as in experiments where a flame is stabilised in one
// and soot grows in the other: what leaves it is the inlet of the plug flow, with the particles that the gas carries.
#pragma once

#include "app/problems/reactor/reactor_kind.hpp"
#include "core/modules.hpp"
#include "coupling/split_reactor.hpp"

namespace lampblack::app {

// The steady state of the stirred reactor in front of a plug flow. `carried`: the phase that the gas carries; null:
// none. NumericsError.
[[nodiscard]] ReactorSteadyState steadyUpstream(const Mechanism& mechanism, const PlugFlowKind& duct,
                                                CarriedPhase* carried);
// The state of the stirred reactor with a population, at PlugFlowKind::upstreamTime after the steady state of the gas
// alone. NumericsError.
[[nodiscard]] GasState upstreamWithPopulation(const ReactorCase& reactorCase, const PlugFlowKind& duct,
                                              SplitParticles& particles);

}  // namespace lampblack::app
