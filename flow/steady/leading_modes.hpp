// Whether a flow stays in a state: how disturbances of it grow or decay, exp(lambda t), by the leading eigenvalues of
// what a march over a fixed time makes of them, which are exp(lambda T). They come first in Arnoldi's method, whose
// products are marches of the disturbed and of the undisturbed flow (Edwards, Tuckerman, Friesner and Sorensen 1994;
// Tuckerman and Barkley 2000). No matrix is needed, and nothing is to be known of the equations.
// docs/theory/flow.md, "Steady".
#pragma once

#include <mpi.h>

#include <functional>
#include <vector>

#include "core/modules.hpp"

namespace lampblack::flow {

struct Mode {
  double growthRate = 0.0;  // 1/s; below zero: it decays
  double frequency = 0.0;   // Hz; zero: it does not oscillate
  double error = 0.0;       // 1/s, by the residual of its vector: of both growth rate and angular frequency
};

struct LeadingModes {
  std::vector<Mode> modes;  // the fastest growing first; an oscillation once
  int vectors = 0;          // that were marched
  // Whether a disturbance grows, beyond its error; whether all decay. Neither: it is not decided.
  [[nodiscard]] bool grows() const { return !modes.empty() && modes.front().growthRate > modes.front().error; }
  [[nodiscard]] bool decays() const { return !modes.empty() && modes.front().growthRate < -modes.front().error; }
};

// What is marched, this rank's part: values that a step begins with.
struct MarchedFlow {
  // Over `time`; the same bits for the same values. Collective.
  std::function<void(std::vector<double>&)> march;
  double time = 0.0;           // s
  std::vector<double> state;   // that is asked about
  std::vector<double> scales;  // one over what is a large change of a value; zero where it follows from others
  std::vector<double> shares;  // of the domain, of the place where a value is
};

struct ModeOptions {
  int vectors = 40;           // at most
  double disturbance = 1e-4;  // the largest of any value, in units of its scale
};

// Collective. `start`: the first disturbance, of any size but zero. NumericsError where the disturbed flow cannot be
// marched.
[[nodiscard]] LeadingModes leadingModes(MPI_Comm comm, const MarchedFlow& flow, std::vector<double> start,
                                        const ModeOptions& options);

}  // namespace lampblack::flow
