// The grid of a flame on its way: where it is pinned, and how grid and domain follow it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "flow/flame/flame_solver_data.hpp"

namespace lampblack::flow {
namespace {

// The profile as the criteria of the grid see it: of what is carried, the sums that decide.
FlameProfile seenByGrid(const FlameProfile& profile, const CarriedModel* carried) {
  if (carried == nullptr || profile.layout.scalars == 0) return profile;
  const auto sums = carried->gridSums();
  if (sums.empty()) return profile;
  FlameLayout layout = profile.layout;
  layout.scalars = 0;
  FlameProfile seen = withLayout(profile, layout);
  layout.scalars = sums.size();
  seen = withLayout(seen, layout);
  for (std::size_t i = 0; i < profile.points(); ++i) {
    const auto values = profile.scalars(i);
    for (std::size_t k = 0; k < sums.size(); ++k) {
      double& sum = seen.at(i, layout.firstScalar() + k);
      for (std::size_t s = 0; s < values.size(); ++s) sum += sums[k][s] * carried->scalars()[s].scale * values[s];
    }
  }
  return seen;
}

// By the mass flux nothing is refined: it follows from the rest.
GridChange refineForAllButFlux(const FlameProfile& profile, const GridOptions& grid,
                               const std::vector<std::size_t>& keep) {
  const std::size_t width = profile.layout.width();
  const auto active = std::make_unique<bool[]>(width);
  std::fill(active.get(), active.get() + width, true);
  active[FlameLayout::massFlux] = false;
  return refineGrid(profile, grid, {active.get(), width}, keep);
}

}  // namespace

void FlameSolver::Data::anchorIn(const FlameProfile& profile) {
  if (problem.type != FlameType::Free) return;
  const std::size_t last = profile.points() - 1;
  const double unburnt = profile.temperature(0);
  anchorTemperature =
      options.anchorTemperature > 0 ? options.anchorTemperature : unburnt + 0.4 * (profile.peakTemperature() - unburnt);
  std::size_t best = 1;
  while (best < last && profile.temperature(best) < anchorTemperature) ++best;
  anchorZ = profile.z[best];
  anchorTemperature = profile.temperature(best);
}

std::vector<std::size_t> FlameSolver::Data::anchorPoint() const {
  std::vector<std::size_t> keep;
  if (problem.type == FlameType::Free)
    for (std::size_t i = 0; i < solution.profile.points(); ++i)
      if (solution.profile.z[i] == anchorZ) keep.push_back(i);
  return keep;
}

void FlameSolver::Data::setGridAndAnchor(FlameEquations& equations) {
  const FlameProfile& p = solution.profile;
  equations.setGrid(p.z);
  if (problem.type != FlameType::Free) return;
  const auto at = std::min_element(p.z.begin(), p.z.end(),
                                   [&](double a, double b) { return std::abs(a - anchorZ) < std::abs(b - anchorZ); });
  equations.setAnchor(static_cast<std::size_t>(at - p.z.begin()), anchorTemperature);
}

// Points where the flame has gone to: a front in coarse cells moves from one to the next by ignitions, each of which
// takes many small time steps.
void FlameSolver::Data::moveGridToFlame(FlameEquations& equations) {
  if (!options.refine) return;
  GridOptions coarse = options.grid;
  coarse.slope = std::max(coarse.slope, 0.2);
  coarse.curve = std::max(coarse.curve, 0.3);
  coarse.prune = std::max(coarse.prune, 0.02);
  try {
    const GridChange change = refineForAllButFlux(solution.profile, coarse, anchorPoint());
    if (!change.changed()) return;
    solution.profile = onGrid(solution.profile, change.z);
  } catch (const NumericsError&) {
    return;  // no more points are allowed: on with these
  }
  setGridAndAnchor(equations);
}

bool FlameSolver::Data::widen() {
  if (problem.type != FlameType::Free) return false;
  const FlameProfile& p = solution.profile;
  const std::size_t last = p.points() - 1;
  double steepest = 0;
  for (std::size_t i = 0; i < last; ++i)
    steepest = std::max(steepest, std::abs(p.temperature(i + 1) - p.temperature(i)) / (p.z[i + 1] - p.z[i]));
  const auto slope = [&](std::size_t i) {
    return std::abs(p.temperature(i + 1) - p.temperature(i)) / (p.z[i + 1] - p.z[i]) / steepest;
  };
  const double length = p.z.back() - p.z.front();
  const double left = slope(0) > 1e-3 ? 0.5 * length : 0, right = slope(last - 1) > 1e-3 ? 0.5 * length : 0;
  if (left == 0 && right == 0) return false;
  if (length > 1000 * problem.length) return false;
  solution.profile = widened(p, left, right);
  anchorZ += left;
  return true;
}

void FlameSolver::Data::refine(FlameEquations& equations, NewtonSolver& solver, const std::string& name) {
  GridOptions grid = options.grid;
  std::set<std::vector<double>> earlier;
  for (std::size_t pass = 0;; ++pass) {
    steady(equations, solver, pass == 0 ? name : fmt::format("{}, grid {}", name, pass + 1));
    if (!options.refine) return;
    if (widen()) continue;
    const auto stopRefinement = [&](const std::string& reason) {
      FlameStage stage = solution.stages.back();
      stage.newton.reason = reason;
      solution.stages.pop_back();
      fail(stage);
    };
    GridChange change;
    try {
      change = refineForAllButFlux(seenByGrid(solution.profile, carried), grid, anchorPoint());
      // Points may be superfluous on one grid and needed on the next, without end.
      const bool returns = !earlier.insert(solution.profile.z).second || earlier.contains(change.z);
      if (grid.prune > 0 && change.changed() && (returns || pass >= options.maximumGrids / 2)) {
        grid.prune = 0;
        change = refineForAllButFlux(seenByGrid(solution.profile, carried), grid, anchorPoint());
      }
    } catch (const NumericsError& error) {
      stopRefinement(error.what());
    }
    if (!change.changed()) return;
    if (pass + 1 == options.maximumGrids)
      stopRefinement(fmt::format("the grid still changes after {} refinements", options.maximumGrids));
    solution.profile = onGrid(solution.profile, change.z);
  }
}

}  // namespace lampblack::flow
