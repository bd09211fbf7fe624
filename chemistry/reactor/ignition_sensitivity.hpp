// How ignition delays answer to the rate constants: d ln tau / d ln k of each reaction, from the forward sensitivities
// of CVODES. The delay is a zero of some G(t, p) along the solution; the theorem of implicit functions gives its
// derivative, d tau/dp = -(dG/dp)/(dG/dt). For fractions of species and a rise of temperature both are analytic; for
// the largest dT/dt, where G is the second derivative of T, five-point formulas around tau are used
// (docs/theory/reactors.md). Slowing down all reactions alike stretches time: the sum over all reactions is -1.
#pragma once

#include <functional>
#include <vector>

#include "chemistry/reactor/closed_reactor.hpp"
#include "chemistry/reactor/ignition.hpp"
#include "core/modules.hpp"

namespace lampblack::chemistry {

struct IgnitionSensitivities {
  // [criterion][parameter]: d ln tau / d ln k; empty for a criterion that was not met.
  std::vector<std::vector<double>> values;
  StiffIntegrator::Statistics statistics;
};

// Integrates `reactor` once more, with the sensitivities to its parameters (ClosedReactor::setParameters), to just
// behind the last of `events`, which a run without sensitivities and with the same tolerances found. `goesOn` is asked
// with the time (s) reached and the last one before each step; nothing is met where it says no.
IgnitionSensitivities ignitionSensitivities(const Mechanism& mechanism, ClosedReactor& reactor,
                                            const StiffIntegrator::Options& options,
                                            const std::vector<IgnitionCriterion>& criteria,
                                            const std::vector<std::optional<IgnitionEvent>>& events,
                                            const std::function<bool(double time, double end)>& goesOn = {});

}  // namespace lampblack::chemistry
