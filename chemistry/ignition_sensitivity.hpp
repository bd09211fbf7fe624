// How ignition delays answer to the rate constants: d ln tau / d ln k of each reaction, from the forward sensitivities
// of CVODES. The delay is a zero of a derivative along the solution; the theorem of implicit functions gives its
// derivative: with a(t, p) the quantity of which the largest value marks ignition, d tau/dp = -(d a'/dp) / a''. The
// time derivatives are taken by five-point formulas in the time around tau (docs/theory/reactors.md).
#pragma once

#include <vector>

#include "chemistry/closed_reactor.hpp"
#include "chemistry/ignition.hpp"

namespace lampblack {

struct IgnitionSensitivities {
  // [criterion][parameter]: d ln tau / d ln k; empty for a criterion that was not met.
  std::vector<std::vector<double>> values;
  StiffIntegrator::Statistics statistics;
};

// Integrates `reactor` once more, with the sensitivities to its parameters (ClosedReactor::setParameters), to just
// behind the last of `events`, which a run without sensitivities and with the same tolerances found.
IgnitionSensitivities ignitionSensitivities(const Mechanism& mechanism, ClosedReactor& reactor,
                                            const StiffIntegrator::Options& options,
                                            const std::vector<IgnitionCriterion>& criteria,
                                            const std::vector<std::optional<IgnitionEvent>>& events);

}  // namespace lampblack
