#include "flow/flame/flame_continuation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/errors.hpp"
#include "core/stop_request.hpp"

namespace lampblack::flow {
namespace {

std::vector<double> copyOf(std::span<const double> values) {
  return {values.begin(), values.end()};
}

// Puts the branch on a grid that suits its last point.
bool adaptGrid(BranchTracer& tracer, FlameEquations& equations, FlameProfile& profile, const GridOptions& grid) {
  const auto active = std::make_unique<bool[]>(profile.layout.width());
  std::fill_n(active.get(), profile.layout.width(), true);
  const GridChange change = refineGrid(profile, grid, {active.get(), profile.layout.width()}, {});
  if (!change.changed()) return true;
  // A direction has no bounds and no sum of one to keep: it is the difference of two profiles on the new grid.
  FlameProfile ahead = profile;
  const double step = tracer.nextStep();
  for (std::size_t i = 0; i < ahead.x.size(); ++i) ahead.x[i] += step * tracer.tangent()[i];
  ahead = onGrid(ahead, change.z);
  profile = onGrid(profile, change.z);
  std::vector<double> tangent(profile.x.size());
  for (std::size_t i = 0; i < tangent.size(); ++i) tangent[i] = (ahead.x[i] - profile.x[i]) / step;
  equations.setConstraint(std::nullopt);
  equations.setGrid(profile.z);
  return tracer.resume(profile.x, tangent);
}

}  // namespace

FlameBranch followFlame(MPI_Comm comm, std::shared_ptr<const Mechanism> mechanism, const FlameProblem& problem,
                        CarriedModel* carried, const FlameProfile& start, const FlameContinuationOptions& options,
                        const std::function<void(const FlameBranchPoint&, const FlameProfile&)>& onPoint) {
  if (problem.type == FlameType::Free)
    throw InputError("a freely propagating flame has no strain along which it could be continued");
  FlameEquations equations(comm, std::move(mechanism), problem, carried, options.tolerances);
  equations.setGrid(start.z);

  FlameBranch branch;
  branch.last = start;
  BranchTracer tracer(equations, options.continuation);
  if (!tracer.start(start.x)) throw NumericsError(fmt::format("no branch starts from this flame: {}", tracer.reason()));

  const auto record = [&] {
    branch.last.x = copyOf(tracer.x());
    branch.points.push_back(
        {tracer.x().back(), branch.last.peakTemperature(), branch.last.points(), tracer.points().back().newton});
    if (onPoint) onPoint(branch.points.back(), branch.last);
  };
  record();
  while (true) {
    const FlameBranchPoint& point = branch.points.back();
    branch.complete = true;
    if (point.load < options.lowestLoad || point.load > options.highestLoad)
      branch.reason = "the end of the range of the load";
    else if (point.peakTemperature < options.lowestPeakTemperature)
      branch.reason = fmt::format("the peak temperature fell below {:g} K", options.lowestPeakTemperature);
    else if (branch.points.size() >= options.maximumPoints)
      branch.reason = fmt::format("{} points", options.maximumPoints);
    else if (branch.turningPoints.size() >= options.maximumTurningPoints)
      branch.reason = fmt::format("{} turning points", options.maximumTurningPoints);
    if (!branch.reason.empty()) break;

    branch.complete = false;
    branch.reason.clear();
    try {
      if (options.pointsBetweenGrids > 0 && branch.points.size() % options.pointsBetweenGrids == 0 &&
          !adaptGrid(tracer, equations, branch.last, options.grid))
        branch.reason = fmt::format("the flame did not converge on its new grid: {}", tracer.reason());
      else if (!tracer.advance())
        branch.reason = tracer.reason();
    } catch (const NumericsError& error) {
      branch.reason = error.what();
    } catch (const Stopped& stop) {
      branch.reason = stop.what();
      branch.stop = stop.signal();
    }
    if (!branch.reason.empty()) break;
    record();
    branch.turningPoints = tracer.turningPoints();
  }
  return branch;
}

}  // namespace lampblack::flow
