// Many cells at once: steps of the Rosenbrock method in vector lanes, what those cannot do one cell after the other.
// Which way a cell goes depends on the cell alone.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "chemistry/reactor/reactor_impl.hpp"

namespace lampblack::chemistry {

void ConstantPressureReactor::advance(std::span<Cell> cells, double dt, std::span<Result> results) {
  auto& self = *impl_;
  if (results.size() != cells.size()) throw std::logic_error("ConstantPressureReactor: not one result a cell");
  std::ranges::fill(results, Result{});
  self.beginAll(cells, dt);
  if (dt == 0) return;
  if (self.lanes) self.advanceInLanes(dt, results);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Stopwatch watch;
    self.place = i;
    self.finish(cells[i], dt, results[i]);
    results[i].seconds += watch.seconds();
    results[i].work += self.counted.cell;
  }
}

void ConstantPressureReactor::Impl::beginAll(std::span<const Cell> cells, double dt) {
  states.resize(cells.size() * (n + 1));
  ends.resize(cells.size());
  reactors.assign(cells.size(), {});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    place = i;
    begin(cells[i], dt);
    ends[i] = end;
    auto& reactor = reactors[i];
    reactor.state = std::span(states).subspan(i * (n + 1), n + 1);
    std::ranges::copy(start, reactor.state.begin());
    reactor.pressure = cells[i].pressure;
    reactor.heating = cells[i].heating;
    reactor.rateFactor = cells[i].rateFactor;
    reactor.duration = dt;
    reactor.firstStep = cells[i].initialStep;
    reactor.source = cells[i].source;
  }
}

// Leaves the outcomes in `reactors`.
void ConstantPressureReactor::Impl::advanceInLanes(double dt, std::span<Result> results) {
  const Stopwatch watch;
  const std::size_t count = reactors.size();
  const int maxSteps = Options::laneSteps * options.rosenbrockSteps;
  // Where the chemistry may be negligible, or has no rates, skip() decides.
  largestRates.assign(count, options.negligibleChange);
  if (options.negligibleChange > 0) lanes->largestChemicalRates(reactors, largestRates);
  const double forRates = watch.seconds() / static_cast<double>(count);
  cellInLane.clear();
  for (std::size_t i = 0; i < count; ++i)
    if (largestRates[i] * dt >= options.negligibleChange && isForRosenbrock(reactors[i].firstStep, dt, maxSteps))
      cellInLane.push_back(i);
  // Those with the most steps first, so that lanes are empty at the end for a short time only.
  const auto expected = [this](std::size_t i) { return reactors[i].firstStep > 0 ? reactors[i].firstStep : HUGE_VAL; };
  std::ranges::stable_sort(cellInLane, {}, expected);
  inLanes.clear();
  for (const std::size_t i : cellInLane) inLanes.push_back(reactors[i]);
  const Stopwatch ofSteps;
  lanes->advance(inLanes, {options.relativeTolerance, options.absoluteTolerance, maxSteps});
  const double seconds = ofSteps.seconds();
  int attempts = 0;
  for (const auto& reactor : inLanes) attempts += reactor.steps + reactor.rejected;
  for (std::size_t i = 0; i < count; ++i) {
    results[i].seconds = forRates;
    results[i].rhsEvaluations = options.negligibleChange > 0 ? 1 : 0;
  }
  for (std::size_t i = 0; i < inLanes.size(); ++i) {
    const int own = inLanes[i].steps + inLanes[i].rejected;
    Result& result = results[cellInLane[i]];
    reactors[cellInLane[i]] = inLanes[i];
    result.steps = inLanes[i].steps;
    result.rhsEvaluations += 3 * own;
    result.jacobianEvaluations = own;
    result.work += counted.laneStep * own;
    if (attempts > 0) result.seconds += seconds * own / attempts;
  }
}

void ConstantPressureReactor::Impl::finish(Cell& cell, double dt, Result& result) {
  using Outcome = ReactorLanes::Reactor::Outcome;
  const auto& reactor = reactors[place];
  end = ends[place];
  std::ranges::copy(cell.Y, start.begin());
  start[n] = cell.temperature;
  reason.clear();
  if (reactor.outcome == Outcome::Left) return advance(cell, dt, {}, result);
  cell.initialStep = reactor.nextStep;
  if (reactor.outcome == Outcome::Arrived && accept(cell, reactor.state)) return;
  advanceByBdf(cell, dt, reactor.firstStep, 1, {}, result);
}

}  // namespace lampblack::chemistry
