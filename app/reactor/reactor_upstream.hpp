// A stirred reactor that a stream passes before it enters a duct, as in experiments where a flame is stabilised in one
// and soot grows in the other: what leaves it is the inlet of the plug flow, with the particles that the gas carries.
#pragma once

#include "app/reactor/reactor_case.hpp"
#include "core/modules.hpp"
#include "coupling/split_reactor.hpp"

namespace lampblack::app {

// Of a plug flow with such a reactor: its steady state, with what the gas carries (null: nothing). NumericsError.
[[nodiscard]] GasState steadyUpstream(const ReactorCase& reactorCase, CarriedPhase* carried);
// The same with a population, which is that of the end: from the steady state of the gas alone over the time that the
// case gives it to settle.
[[nodiscard]] GasState settledUpstream(const ReactorCase& reactorCase, SplitParticles& particles,
                                       const SplitReactor::Options& options);

}  // namespace lampblack::app
