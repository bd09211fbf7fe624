// What the chemistry of a flow keeps from step to step, and what it tells.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "flow/models/reaction_operator.hpp"

namespace lampblack::flow {

// What a step begins with is the state: endStep() takes it from there after loading.
void ReactionOperator::saveOrLoad(StateArchive& archive) {
  if (archive.loading()) {  // of a step that was broken off
    step_ = 0.0;
    std::ranges::fill(isTaken_, 0);
  }
  work_.saveOrLoad(archive);
  archive.cells("chemistry_first_step", initialStep_, 1);
  archive.cells("chemistry_rate_is_limited", isLimited_, 1);
  archive.cells("heat_release", heatRelease_, 1);
  archive.cells("reaction_growth", grows_, 1);
  archive.cells("reaction_speed", fastest_, 1);
  archive.cells("reaction_change_when_asked", askedChange_, 1);
  archive.cells("reaction_steps_unasked", unasked_, 1);
  std::array<double, 7> counted{diagnostics_.solverSteps,     diagnostics_.integratedCells, diagnostics_.skippedCells,
                                diagnostics_.handedOverCells, diagnostics_.retries,         diagnostics_.coupledCells,
                                diagnostics_.limitedCells};
  archive.sums("chemistry_counts", counted);
  diagnostics_.imbalance.saveOrLoad(archive, "chemistry_imbalance_since_row");
  diagnostics_ = {counted[0],      counted[1], counted[2], counted[3],
                  counted[4],      counted[5], counted[6], diagnostics_.imbalance,
                  diagnostics_.map};
  if (options_.map) diagnostics_.map.saveOrLoad(archive, context_.mesh.comm);
  archive.shared("reaction_largest_growth", growth_);
  archive.shared("reaction_growth_in_step", growthInStep_);
}

ReactionOperator::Diagnostics ReactionOperator::takeDiagnostics() {
  Diagnostics all = diagnostics_;
  double sums[7] = {all.solverSteps, all.integratedCells, all.skippedCells, all.handedOverCells,
                    all.retries,     all.limitedCells,    all.coupledCells};
  MPI_Allreduce(MPI_IN_PLACE, sums, 7, MPI_DOUBLE, MPI_SUM, context_.mesh.comm);
  all.solverSteps = sums[0];
  all.integratedCells = sums[1];
  all.skippedCells = sums[2];
  all.handedOverCells = sums[3];
  all.retries = sums[4];
  all.limitedCells = sums[5];
  all.coupledCells = sums[6];
  if (options_.map) {
    mapOfRun_.add(all.map);
    all.map = all.map.overRanks(context_.mesh.comm);
  }
  diagnostics_ = {};
  return all;
}

std::vector<Quantity> ReactionOperator::historyColumns() const {
  std::vector<Quantity> columns{
      {"stiff_solver_steps", "1", "internal steps of the stiff solver over all cells since the last row"},
      {"reacting_cells", "1", "cells integrated since the last row, over all stages"},
      {"skipped_cells", "1", "cells skipped for negligible rates since the last row, over all stages"},
      {"cells_by_cvode", "1", "cells for which the Rosenbrock method's few steps did not do, over all stages"},
      {"stiff_solver_retries", "1", "repeated stiff solves since the last row"},
      {"limited_rate_cells", "1",
       "cells that reacted so fast that the next step's transport took less of it, over all steps"},
      {"coupled_cells", "1", "cells whose reactions outran a step, with those around, over all steps"},
      {"reaction_growth", "1",
       "largest growth rate of the reactions in a cell times the last step; zero where it is below 0.9"},
      {"imbalance_before", "1", "busiest rank's chemistry cost over the mean, as partitioned"},
      {"imbalance_after", "1", "the same as it turned out, with work sharing"}};
  if (options_.map) {
    const std::vector<Quantity> ofMap = MapTally::columns();
    columns.insert(columns.end(), ofMap.begin(), ofMap.end());
  }
  return columns;
}

std::vector<double> ReactionOperator::historyValues(const State&) {
  const Diagnostics d = takeDiagnostics();
  const Imbalance mean = d.imbalance.mean();
  std::vector<double> values{d.solverSteps,  d.integratedCells, d.skippedCells, d.handedOverCells, d.retries,
                             d.limitedCells, d.coupledCells,    growthInStep_,  mean.before,       mean.after};
  if (options_.map) {
    const std::vector<double> ofMap = d.map.values();
    values.insert(values.end(), ofMap.begin(), ofMap.end());
    mapTold_ = mapOfRun_.overRanks(context_.mesh.comm);
  }
  return values;
}

std::vector<std::string> ReactionOperator::closingLines() const {
  if (!options_.map) return {};
  return {mapTold_.line()};
}

std::vector<double> ReactionOperator::heatReleases(const State& state) const {
  std::vector<double> heat = heatRelease_, enthalpies(static_cast<std::size_t>(state.species));
  for (std::size_t cell = 0; cell < heat.size(); ++cell)
    if (isLimited_[cell] == 0.0) heat[cell] = heatRelease(context_, state, cell, enthalpies);
  return heat;
}

void ReactionOperator::fields(const State& state, const FieldSink& sink) const {
  sink({"heat_release", "W/m^3", "heat set free by the gas reactions, mean of the last step"}, heatReleases(state));
}

}  // namespace lampblack::flow
