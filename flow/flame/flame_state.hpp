// What a solution of a flame's equations is to its user.
#pragma once

#include "chemistry/mechanism/mechanism.hpp"
#include "core/modules.hpp"
#include "flow/flame/flame_solver.hpp"

namespace lampblack::flow {

enum class FlameState {
  Burning,         // warmer somewhere than what bounds it
  Out,             // its streams could burn and do not
  UnstableBranch,  // burning, but the least disturbance would end it (flame_stability.hpp)
  Inert            // its streams cannot burn
};

// "burning", "out", "unstable branch", "inert".
[[nodiscard]] const char* nameOf(FlameState state);

// Whether anything is warmer than the streams and walls that bound the flame.
[[nodiscard]] bool isWarm(const FlameProblem& problem, const FlameProfile& profile);

[[nodiscard]] FlameState stateOf(const Mechanism& mechanism, const FlameProblem& problem,
                                 const FlameSolution& solution);

}  // namespace lampblack::flow
