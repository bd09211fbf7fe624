// How the speed of a free flame depends on the rate constants, all at once: one solution with the transposed Jacobian
// (adjoint method; Cao, Li, Petzold, Serban 2003 for the transient case). The Jacobian is that of the whole residual
// with the derivatives of the transport coefficients, by differences of neighbouring points together (Curtis, Powell,
// Reid 1974). Derivation: docs/theory/flames.md.
#pragma once

#include <mpi.h>

#include <memory>
#include <vector>

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "flow/flame/flame_equations.hpp"

namespace lampblack::flow {

// d ln S_u / d ln k of every reaction in the mechanism's order, forward and reverse constant together, at a converged
// free flame (std::logic_error for others) on its grid. With what is carried, whose own rates stay. Collective; the
// same on all ranks. NumericsError where the Jacobian is singular; Stopped.
[[nodiscard]] std::vector<double> speedSensitivities(MPI_Comm comm, std::shared_ptr<const Mechanism> mechanism,
                                                     const FlameProblem& problem, CarriedModel* carried,
                                                     const FlameTolerances& tolerances, const FlameProfile& profile);

}  // namespace lampblack::flow
