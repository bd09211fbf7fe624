#include "flow/flame/flame_state.hpp"

#include <algorithm>

#include "flow/flame/stream_mixture.hpp"

namespace lampblack::flow {

const char* nameOf(FlameState state) {
  switch (state) {
    case FlameState::Burning:
      return "burning";
    case FlameState::Out:
      return "out";
    case FlameState::UnstableBranch:
      return "unstable branch";
    case FlameState::Inert:
      return "inert";
  }
  return "";
}

bool isWarm(const FlameProblem& problem, const FlameProfile& profile) {
  double boundary = problem.left.temperature;
  if (problem.right) boundary = std::max(boundary, problem.right->temperature);
  if (problem.type == FlameType::Wall) boundary = std::max(boundary, problem.wallTemperature);
  return profile.peakTemperature() > boundary + 1;
}

FlameState stateOf(const Mechanism& mechanism, const FlameProblem& problem, const FlameSolution& solution) {
  // A temperature that is given says nothing about what burns.
  const bool warm = isWarm(problem, solution.profile);
  if (problem.given || !warm) {
    if (!inertReason(mechanism, problem).empty()) return FlameState::Inert;
    if (!warm) return FlameState::Out;
  }
  return solution.growthRate ? FlameState::UnstableBranch : FlameState::Burning;
}

}  // namespace lampblack::flow
