// What tests of SteadySearch have in common: steps in time of a search, and what goes over to another one.
#pragma once

#include <vector>

#include "core/modules.hpp"
#include "core/state_backup.hpp"
#include "flow/steady/steady_search.hpp"

namespace lampblack::flow::test {

inline constexpr double high = 0.1;  // a residual far from any end

// Takes steps of this heat until iterations begin, at most so many; how many it took.
inline int steps(SteadySearch& search, double heat = 1.0, int most = 10000, double residual = high) {
  for (int step = 1; step <= most; ++step) {
    search.addStep(heat, false);
    if (search.wantsResidual()) search.addResidualOfStep(residual);
    if (search.phase() == SteadySearch::Phase::Iterations) return step;
  }
  return most;
}

// By what a checkpoint has.
inline void pass(SteadySearch& from, SteadySearch& to) {
  StateBackup kept(0, 0);
  kept.save([&](StateArchive& archive) { from.saveOrLoad(archive); });
  kept.restore([&](StateArchive& archive) { to.saveOrLoad(archive); });
}

}  // namespace lampblack::flow::test
