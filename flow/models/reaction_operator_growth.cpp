// Cells whose reactions outrun a step, and the steps of those that are coupled with their neighbours.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "flow/models/asked_again.hpp"
#include "flow/models/reaction_operator.hpp"

namespace lampblack::flow {

namespace {

// Steps of cells that are coupled with their neighbours: how much their reactions grow in a part, and in how many parts
// at most, beyond which the step has to be shorter.
constexpr double growthInPart = 0.8;
constexpr double outrunning = 1.0;  // growth in a step beyond which cells are coupled
constexpr int mostParts = 60;
// Only where a species changes by more than that in a step is it asked how fast its reactions grow.
constexpr double changeThatCounts = 0.01;
// A cell that reacts less than that share of what it did when it outran a step is no foot of a flame any more: what is
// left of its growth rate after a step.
constexpr double slowShare = 0.25, forgotten = 0.8;

}  // namespace

bool ReactionOperator::findOutrunning(const State& state, double dt) {
  begin(dt);
  const auto n = static_cast<std::size_t>(state.species);
  std::ranges::fill(outruns_, 0);
  std::ranges::fill(isTaken_, 0);
  std::array<double, 2> largestOf{0.0, 0.0};
  for (std::size_t cell = 0; cell < outruns_.size(); ++cell) {
    const double* rate = &state.balance.reactions[cell * n];
    double largest = 0.0;
    for (std::size_t k = 0; k < n; ++k) largest = std::max(largest, std::abs(rate[k]));
    double& grows = grows_[cell];
    const double change = largest / state.density[cell] * dt;
    if (change < changeThatCounts && isLimited_[cell] == 0.0) {
      grows = fastest_[cell] = askedChange_[cell] = 0.0;
      continue;
    }
    const bool isDue = AskedAgain::isDue(change, askedChange_[cell], unasked_[cell]);
    if (grows == 0.0 && !isDue) continue;
    const CellMixing mixing = mixingOf(cell);
    double growth = growthRate_.of(state.temperature[cell], state.thermodynamicPressure, {&state.Y[cell * n], n}, dt,
                                   mixing.reactingShare);
    // Nothing in a cell goes faster than its fine structures mix with it.
    if (mixing.fineTime > 0.0) growth = std::min(growth, mixing.reactingShare / mixing.fineTime);
    double& fastest = fastest_[cell];
    const double speed = largest / state.density[cell];
    grows = std::max(growth, speed < slowShare * fastest ? forgotten * grows : grows);
    outruns_[cell] = grows * dt > outrunning;
    fastest = outruns_[cell] ? std::max(fastest, speed) : 0.0;
    largestOf[0] = std::max(largestOf[0], grows);
    largestOf[1] = std::max(largestOf[1], growth);
  }
  MPI_Allreduce(MPI_IN_PLACE, largestOf.data(), 2, MPI_DOUBLE, MPI_MAX, context_.mesh.comm);
  growth_ = largestOf[0];
  growthInStep_ = largestOf[1] * dt;
  parts_ = std::clamp(static_cast<int>(std::ceil(growth_ * dt / growthInPart)), 2, mostParts);
  return growth_ * dt > outrunning;
}

double ReactionOperator::largestStep(const State&) {
  return growth_ > 0.0 ? growthInPart * mostParts / growth_ : std::numeric_limits<double>::infinity();
}

void ReactionOperator::react(std::span<CoupledCells::Reacting> cells, double time, double part) {
  std::vector<SharedCellWork::Item> items;
  for (const CoupledCells::Reacting& cell : cells) {
    const int local = context_.mesh.findOwned(cell.number);
    items.push_back({local, cell.cost > 0.0 ? cell.cost : work_.expectedCost(local)});
  }
  Work work = workOver(part);
  work.pack = [&](std::size_t item, RowWriter rows) {
    rows.add(cells[item].Y);
    rows.add(cells[item].source);
    return cells[item].gas;
  };
  work.unpack = [&](std::size_t item, const CellReactor::Result& result, std::span<const double> Y) {
    CoupledCells::Reacting& cell = cells[item];
    cell.gas.temperature = result.temperature;
    cell.gas.firstStep = result.firstStep;
    cell.cost = result.cost;
    std::ranges::copy(Y, cell.Y.begin());
    count(result);
  };
  work_.advance(items, time, work, SharedCellWork::Over::Part);
}

}  // namespace lampblack::flow
