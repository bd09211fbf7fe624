#include "app/problems/flame/flame_branch.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "io/csv.hpp"
#include "io/table.hpp"

namespace lampblack::app {
namespace {

double strainAt(const FlameBranchResult& result, double load) {
  return result.strain ? load * *result.strain : std::nan("");
}

// Of the points of a branch.
TableOf<const FlameBranchPoint&> pointsTable(const FlameBranchResult& result) {
  using Point = FlameBranchPoint;
  return {{{"load", "1", "factor on the strain: of strain rates and of the streams' mass fluxes"},
           [](const Point& p) { return p.load; }},
          {{"strain_rate", "1/s", "global strain rate, or that of the potential flow; NaN where there is none"},
           [&result](const Point& p) { return strainAt(result, p.load); }},
          {{"maximum_temperature", "K", "largest temperature"}, [](const Point& p) { return p.peakTemperature; }},
          {{"points", "1", "points of the grid"}, [](const Point& p) { return static_cast<double>(p.gridPoints); }},
          {{"newton_steps", "1", "Newton steps"}, [](const Point& p) { return static_cast<double>(p.newton.steps); }}};
}

}  // namespace

FlameBranchResult followBranch(MPI_Comm comm, FlameCase& flame, const FlameProfile& start,
                               const FlameSummary& summary) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  FlameBranchResult result;
  if (flame.problem.nozzles == FlameNozzles::Potential)
    result.strain = flame.problem.strainRate;
  else if (summary.strain)
    result.strain = summary.strain->global;
  if (rank == 0) fmt::print("\nbranch: load, strain rate, largest temperature\n");
  result.branch = followFlame(comm, flame.mechanism, flame.problem, flame.soot.get(), start, *flame.continuation,
                              [&](const FlameBranchPoint& point, const FlameProfile&) {
                                if (rank != 0) return;
                                fmt::print("  {:>12.6g} {:>12.6g} 1/s {:>10.2f} K  {:>5} points\n", point.load,
                                           strainAt(result, point.load), point.peakTemperature, point.gridPoints);
                                std::fflush(stdout);
                              });
  if (rank == 0) fmt::print("the branch ends: {}\n", result.branch.reason);
  return result;
}

std::vector<NamedNumber> namedBranchNumbers(const FlameBranchResult& result) {
  std::vector<NamedNumber> numbers{{"branch_points", "1", static_cast<double>(result.branch.points.size())}};
  for (const TurningPoint& turn : result.branch.turningPoints) {
    if (!turn.highest) continue;
    numbers.push_back({"extinction_load", "1", turn.load});
    if (result.strain) numbers.push_back({"extinction_strain", "1/s", strainAt(result, turn.load)});
    numbers.push_back({"extinction_temperature", "K", result.branch.points.at(turn.index).peakTemperature});
    break;
  }
  return numbers;
}

void writeBranch(ResultsWriter& results, const FlameBranchResult& result) {
  pointsTable(result).of(result.branch.points).write(results, "/continuation");
  const TableOf<const TurningPoint&> turns{
      {{"load", "1", "factor on the strain"}, [](const TurningPoint& t) { return t.load; }},
      {{"strain_rate", "1/s", "as of the points"}, [&](const TurningPoint& t) { return strainAt(result, t.load); }},
      {{"highest", "1", "1: the load is highest here (extinction); 0: lowest (ignition)"},
       [](const TurningPoint& t) { return t.highest ? 1.0 : 0.0; }},
      {{"point", "1", "number of the point of the branch nearest to it, from 0"},
       [](const TurningPoint& t) { return static_cast<double>(t.index); }}};
  turns.of(result.branch.turningPoints).write(results, "/continuation/turning_points");
  results.attribute("/continuation", "complete", static_cast<std::int64_t>(result.branch.complete ? 1 : 0));
  results.attribute("/continuation", "reason", result.branch.reason);
}

std::string branchTable(const FlameBranchResult& result) {
  const auto [columns, rows] = pointsTable(result).of(result.branch.points);
  std::string text = csvHeader(columns);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool last = (i + 1) % columns.size() == 0;
    text += (std::isfinite(rows[i]) ? fmt::format("{}", rows[i]) : "") + (last ? "\n" : ",");
  }
  return text;
}

}  // namespace lampblack::app
