// From a solution between turning points to the flame that lasts.
#include <algorithm>
#include <cmath>

#include "flow/flame/flame_solver_data.hpp"

namespace lampblack::flow {
namespace {

constexpr double push = 0.005;                    // of the rise of temperature: the disturbance
constexpr double stepOverGrowth = 0.5;            // implicit Euler steps above 1 would damp the mode
constexpr double leastTime = 10, mostTime = 200;  // in times of growth
constexpr double settled = 0.02;                  // of the rise so far, within a time of growth: the new flame is near
constexpr int mostTries = 2;

}  // namespace

void FlameSolver::Data::leaveUnstableFlame(FlameEquations& equations, NewtonSolver& solver, const GrowingMode& mode) {
  const double start = MPI_Wtime();
  FlameProfile& p = solution.profile;
  FlameStage stage;
  stage.name = "away from the unstable flame";
  const double before = p.peakTemperature();
  const double disturbance = push * (before - p.temperature(0));
  std::vector<double> lower(p.size()), upper(p.size());
  equations.bounds(lower, upper);
  for (std::size_t i = 0; i < p.size(); ++i)
    p.x[i] = std::clamp(p.x[i] + disturbance * mode.direction[i], lower[i], upper[i]);
  equations.clipNegativeAmounts(p.x);

  double dt = stepOverGrowth / mode.rate, time = 0;
  while (time < mostTime / mode.rate) {
    const double peak = p.peakTemperature();
    if (!solver.timeStep(equations, p.x, dt, stage.newton)) {
      dt *= options.transient.cut;
      if (dt < options.transient.smallestStep) break;
      continue;
    }
    equations.clipNegativeAmounts(p.x);
    time += dt;
    const double change = std::abs(p.peakTemperature() - peak) / (dt * mode.rate);
    if (time > leastTime / mode.rate && change < settled * (p.peakTemperature() - before)) break;
    dt = std::min(options.transient.growth * dt, stepOverGrowth / mode.rate);
  }
  stage.newton.converged = p.peakTemperature() > before + 0.1 * disturbance;
  if (!stage.newton.converged) stage.newton.reason = "the disturbance towards higher temperatures does not grow";
  finish(stage, start);
}

void FlameSolver::Data::preferStable(FlameEquations& equations, NewtonSolver& solver, const std::string& name) {
  // The last steps begin with factors of their own, and change the profile by less than the tolerances of Newton's
  // method.
  const bool atHand = options.polish > 0;
  std::optional<GrowingMode> mode = growingMode(equations, solution.profile.x, atHand);
  for (int tries = 0; mode && tries < mostTries; ++tries) {
    const FlameProfile unstable = solution.profile;
    const std::size_t stages = solution.stages.size();
    bool hotter = false;
    try {
      leaveUnstableFlame(equations, solver, *mode);
      toLastSteps(equations, solver, name + ", stable");
      hotter = solution.profile.peakTemperature() > unstable.peakTemperature();
    } catch (const FlameFailure&) {
      hotter = false;
    }
    if (!hotter) {
      solution.profile = unstable;
      solution.stages.resize(stages);
      setGridAndAnchor(equations);
      break;
    }
    mode = growingMode(equations, solution.profile.x, atHand);
  }
  solution.growthRate.reset();
  if (mode) solution.growthRate = mode->rate;
}

}  // namespace lampblack::flow
