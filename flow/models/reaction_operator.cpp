#include "flow/models/reaction_operator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/errors.hpp"

namespace lampblack::flow {

// How a cell is packed for the trip to another rank and back.
struct ReactionOperator::Layout {
  // in: centre (2), enthalpy, its constant source, guess of the temperature, pressure, first step, natural number, Y,
  // their constant sources
  static constexpr std::size_t inHeader = 9;
  // out: temperature, next first step, work, solver steps, retries, skipped, handed over, Y
  static constexpr std::size_t outHeader = 7;
};

namespace {

// Cells that are handed to the reactor at once: many more than it has lanes, so that few lanes wait for the last ones,
// and few enough for their states to stay in the processor's cache.
constexpr std::size_t cellsTogether = 256;

// Steps of cells that are coupled with their neighbours: how much their reactions grow in a part, and in how many parts
// at most, beyond which the step has to be shorter.
constexpr double growthInPart = 0.8;
constexpr double outrunning = 1.0;  // growth in a step beyond which cells are coupled
constexpr int mostParts = 60;
// Only where a species changes by more than that in a step is it asked how fast its reactions grow.
constexpr double changeThatCounts = 0.01;
// One in which nothing grew is asked again after so many steps, or once a step changes so much more.
constexpr double stepsUnasked = 8.0, moreChange = 1.25;
// A cell that reacts less than that share of what it did when it outran a step is no foot of a flame any more: what is
// left of its growth rate after a step.
constexpr double slowShare = 0.25, forgotten = 0.8;

constexpr double firstCost = 1.0;  // before a cell was ever advanced: that of all others

}  // namespace

ReactionOperator::ReactionOperator(const FlowContext& context, Options options)
    : context_(context),
      options_(options),
      reactor_(context.mechanism, options.reactor),
      sharing_(context.mesh.comm, options.shareWork),
      cost_(context.mesh.owned, firstCost),
      costOfStep_(cost_.size()),
      initialStep_(context.mesh.owned, 0.0),
      isLimited_(cost_.size()),
      heatRelease_(cost_.size()),
      growthRate_(context.mechanism, -100.0 * options.reactor.absoluteTolerance),
      outruns_(cost_.size()),
      isTaken_(cost_.size()),
      grows_(cost_.size()),
      fastest_(cost_.size()),
      askedChange_(cost_.size()),
      askedAgo_(cost_.size()) {}

// Of the gas in which transport counts the rate as one per mass.
double ReactionOperator::densityOfRate(const State& state, std::size_t cell) const {
  return isLimited_[cell] != 0.0 ? state.density[cell] : meanDensity(state, cell);
}

// Of the step's start and end: reactions per mass and per volume are of second order to each other with it.
double ReactionOperator::meanDensity(const State& state, std::size_t cell) const {
  return state.start.Y.empty() ? state.density[cell] : 0.5 * (state.start.density[cell] + state.density[cell]);
}

// What solve() reads in front of a cell's mass fractions and sources. `reactor`: enthalpy, heating, guess of the
// temperature, pressure and first step.
void ReactionOperator::packHead(std::size_t cell, const std::array<double, 5>& reactor, std::span<double> in) const {
  const Vector3& centre = context_.mesh.centre[cell];
  in[0] = centre[0];
  in[1] = centre[1];
  std::ranges::copy(reactor, in.begin() + 2);
  in[7] = static_cast<double>(context_.mesh.naturalCell[cell]);
  in[8] = centre[2];
}

void ReactionOperator::pack(const State& state, std::size_t cell, double dt, std::span<double> in) const {
  const auto n = static_cast<std::size_t>(state.species);
  const double* Y = &state.Y[cell * n];
  const double* before = state.start.Y.empty() ? Y : &state.start.Y[cell * n];
  const double enthalpy = state.start.Y.empty() ? state.enthalpy[cell] : state.start.enthalpy[cell];
  const double pressure = state.start.Y.empty()
                              ? state.thermodynamicPressure
                              : 0.5 * (state.start.thermodynamicPressure + state.thermodynamicPressure);
  packHead(cell,
           {enthalpy, (state.enthalpy[cell] - enthalpy) / dt, state.temperature[cell], pressure, initialStep_[cell]},
           in);
  const std::span<double> start = in.subspan(Layout::inHeader, n);
  const std::span<double> source = in.subspan(Layout::inHeader + n, n);
  std::copy_n(before, n, start.begin());
  // What transport alone has changed since then, at a constant rate.
  const double density = densityOfRate(state, cell);
  const double* rate = &state.balance.reactions[cell * n];
  for (std::size_t k = 0; k < n; ++k) source[k] = (Y[k] - before[k]) / dt - rate[k] / density;
}

void ReactionOperator::solve(double time, double dt, std::span<const std::span<const double>> in,
                             std::span<std::vector<double>> out) {
  const std::size_t n = context_.mechanism.numSpecies(), count = in.size();
  const auto failure = [&](std::size_t i, const std::string& reason) {
    return NumericsError(fmt::format("chemistry failed in cell {:.0f} at {} at time {:.6g} s: {}", in[i][7],
                                     placeText({in[i][0], in[i][1], in[i][8]}, context_.mesh.dimension), time, reason));
  };
  cells_.resize(count);
  results_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    out[i].resize(Layout::outHeader + n);
    const std::span<double> Y = std::span(out[i]).subspan(Layout::outHeader);
    std::ranges::copy(in[i].subspan(Layout::inHeader, n), Y.begin());
    try {
      cells_[i] = {context_.thermo.temperatureFromEnthalpy(in[i][2], Y, in[i][4]),
                   in[i][5],
                   Y,
                   in[i].subspan(Layout::inHeader + n),
                   in[i][6],
                   in[i][3]};
    } catch (const NumericsError& error) {
      throw failure(i, error.what());
    }
  }
  try {
    reactor_.advance(cells_, dt, results_);
  } catch (const ReactorFailure& error) {
    const std::size_t i = error.place();
    const auto kept =
        options_.keepFailed ? options_.keepFailed(static_cast<std::int64_t>(in[i][7]), error.cell()) : std::string();
    throw failure(i, error.what() + kept);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto& result = results_[i];
    out[i][0] = cells_[i].temperature;
    out[i][1] = cells_[i].initialStep;
    out[i][2] = result.work;
    out[i][3] = result.steps;
    out[i][4] = result.retries;
    out[i][5] = result.skipped ? 1.0 : 0.0;
    out[i][6] = result.handedOver ? 1.0 : 0.0;
  }
}

void ReactionOperator::unpack(State& state, std::size_t cell, double dt, std::span<const double> out) {
  const auto n = static_cast<std::size_t>(state.species);
  const double density = meanDensity(state, cell), densityOfLast = densityOfRate(state, cell);
  for (std::size_t k = 0; k < n; ++k) {
    double& Y = state.Y[cell * n + k];
    double& rate = state.balance.reactions[cell * n + k];
    const double reacted = out[Layout::outHeader + k];
    rate = density * ((reacted - Y) / dt + rate / densityOfLast);
    Y = reacted;
  }
  isLimited_[cell] = 0.0;
  // The reactor keeps the sum of Y, so that round-off in the rate would feed on itself.
  removeNetMass(state, cell);
  state.temperature[cell] = out[0];
  initialStep_[cell] = out[1];
  cost_[cell] = 0.5 * (cost_[cell] + out[2]);  // some cells change between the methods from step to step
  count(cell, out);
}

// What the reactor has done in a cell.
void ReactionOperator::count(std::size_t cell, std::span<const double> out) {
  costOfStep_[cell] += out[2];
  diagnostics_.solverSteps += out[3];
  diagnostics_.retries += out[4];
  diagnostics_.skippedCells += out[5];
  diagnostics_.integratedCells += 1.0 - out[5];
  diagnostics_.handedOverCells += out[6];
}

void ReactionOperator::removeNetMass(State& state, std::size_t cell) {
  const auto n = static_cast<std::size_t>(state.species);
  double* rate = &state.balance.reactions[cell * n];
  double net = 0.0;
  for (std::size_t k = 0; k < n; ++k) net += rate[k];
  for (std::size_t k = 0; k < n; ++k) rate[k] -= net * state.Y[cell * n + k];
}

// The rates are what the next step's transport takes for its own. If a species goes on changing as it has, they may
// use up what there is of it, or add a half: one that has reacted away within a step would else be far below zero
// there, and one that has begun to form far too much, and what diffuses from such a cell be wrong by as much. A steady
// state never comes here. What is left of the rates does not conserve elements: it has to be taken out again with the
// density it was put in with (densityOfRate), though that is of first order in time only.
void ReactionOperator::limitRates(State& state, std::size_t cell) {
  const auto n = static_cast<std::size_t>(state.species);
  const double* Y = &state.Y[cell * n];
  const double* before = &state.start.Y[cell * n];
  double* rate = &state.balance.reactions[cell * n];
  const auto excess = [&](std::size_t k) {
    const double available = std::max(Y[k], 0.0), change = Y[k] - before[k];
    return rate[k] > 0.0 ? std::max(change - 0.5 * available, 0.0) : std::min(change + available, 0.0);
  };
  double largest = 0.0;
  for (std::size_t k = 0; k < n; ++k) largest = std::max(largest, std::abs(rate[k] * excess(k)));
  if (largest == 0.0) return;
  std::vector<double> enthalpies(n);
  heatRelease_[cell] = heatRelease(context_, state, cell, enthalpies);
  const double perStep = meanDensity(state, cell) / step_;
  for (std::size_t k = 0; k < n; ++k) {
    const double tooMuch = perStep * excess(k);
    rate[k] = rate[k] > 0.0 ? std::max(rate[k] - tooMuch, 0.0) : std::min(rate[k] - tooMuch, 0.0);
  }
  removeNetMass(state, cell);
  isLimited_[cell] = 1.0;
}

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
    if (grows == 0.0 && change < moreChange * askedChange_[cell] && ++askedAgo_[cell] < stepsUnasked) continue;
    askedChange_[cell] = change;
    askedAgo_[cell] = 0.0;
    const double growth =
        growthRate_.of(state.temperature[cell], state.thermodynamicPressure, {&state.Y[cell * n], n}, dt);
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
  const std::size_t n = context_.mechanism.numSpecies();
  WorkSharing::Items items;
  std::vector<std::size_t> local;
  for (const CoupledCells::Reacting& cell : cells) {
    local.push_back(static_cast<std::size_t>(context_.mesh.findOwned(cell.number)));
    items.cost.push_back(cell.cost > 0.0 ? cell.cost : cost_[local.back()]);
  }
  items.pack = [&](std::size_t item, std::vector<double>& in) {
    const CoupledCells::Reacting& cell = cells[item];
    in.resize(Layout::inHeader);
    packHead(local[item], {cell.enthalpy, cell.heating, cell.temperature, cell.pressure, cell.initialStep}, in);
    in.insert(in.end(), cell.Y.begin(), cell.Y.end());
    in.insert(in.end(), cell.source.begin(), cell.source.end());
  };
  items.groupSize = cellsTogether;
  items.advanceGroup = [&](std::span<const std::span<const double>> in, std::span<std::vector<double>> out) {
    solve(time, part, in, out);
  };
  items.unpack = [&](std::size_t item, std::span<const double> out) {
    CoupledCells::Reacting& cell = cells[item];
    cell.temperature = out[0];
    cell.initialStep = out[1];
    cell.cost = out[2];
    std::ranges::copy(out.subspan(Layout::outHeader, n), cell.Y.begin());
    count(local[item], out);
  };
  items.work = [](std::span<const double> out) { return out[2]; };
  sharing_.run(items);
}

// Called by whatever comes first in a step.
void ReactionOperator::begin(double dt) {
  if (step_ == 0.0) std::ranges::fill(costOfStep_, 0.0);
  step_ = dt;
}

void ReactionOperator::advance(State& state, double time, double dt) {
  begin(dt);
  const auto n = static_cast<std::size_t>(state.species);
  WorkSharing::Items items;
  std::vector<std::size_t> cells;
  for (std::size_t cell = 0; cell < cost_.size(); ++cell) {
    if (isTaken_[cell]) continue;
    cells.push_back(cell);
    items.cost.push_back(cost_[cell]);
  }
  items.pack = [&](std::size_t item, std::vector<double>& in) {
    in.resize(Layout::inHeader + 2 * n);
    pack(state, cells[item], dt, in);
  };
  items.groupSize = cellsTogether;
  items.advanceGroup = [&](std::span<const std::span<const double>> in, std::span<std::vector<double>> out) {
    solve(time, dt, in, out);
  };
  items.unpack = [&](std::size_t item, std::span<const double> out) { unpack(state, cells[item], dt, out); };
  items.work = [](std::span<const double> out) { return out[2]; };
  const auto statistics = sharing_.run(items);
  diagnostics_.imbalanceBefore += statistics.imbalanceBefore;
  diagnostics_.imbalanceAfter += statistics.imbalanceAfter;
  ++diagnostics_.stages;
  imbalances_.before += statistics.imbalanceBefore;
  imbalances_.after += statistics.imbalanceAfter;
  ++stages_;
  state.updateHalo(context_.halo);
}

double heatRelease(const FlowContext& context, const State& state, std::size_t cell, std::span<double> enthalpies) {
  const auto n = static_cast<std::size_t>(state.species);
  context.thermo.speciesEnthalpies(state.temperature[cell], enthalpies);
  double heat = 0.0;
  for (std::size_t k = 0; k < n; ++k) heat -= enthalpies[k] * state.balance.reactions[cell * n + k];
  return heat;
}

void ReactionOperator::endStep(State& state) {
  if (step_ > 0.0 && !state.start.Y.empty())  // else the state is a new one
    for (std::size_t cell = 0; cell < cost_.size(); ++cell) {
      limitRates(state, cell);
      diagnostics_.limitedCells += isLimited_[cell];
    }
  for (char& isTaken : isTaken_) {
    diagnostics_.coupledCells += isTaken;
    isTaken = 0;
  }
  step_ = 0.0;
}

// What a step begins with is the state: endStep() takes it from there after loading.
void ReactionOperator::saveOrLoad(StateArchive& archive) {
  if (archive.loading()) {  // of a step that was broken off
    step_ = 0.0;
    std::ranges::fill(isTaken_, 0);
  }
  archive.cells("chemistry_cost", cost_, 1);
  archive.cells("chemistry_first_step", initialStep_, 1);
  archive.cells("chemistry_rate_is_limited", isLimited_, 1);
  archive.cells("heat_release", heatRelease_, 1);
  archive.cells("reaction_growth", grows_, 1);
  archive.cells("reaction_speed", fastest_, 1);
  archive.cells("reaction_change_when_asked", askedChange_, 1);
  archive.cells("reaction_steps_unasked", askedAgo_, 1);
  std::array<double, 7> counted{diagnostics_.solverSteps,     diagnostics_.integratedCells, diagnostics_.skippedCells,
                                diagnostics_.handedOverCells, diagnostics_.retries,         diagnostics_.coupledCells,
                                diagnostics_.limitedCells};
  archive.sums("chemistry_counts", counted);
  std::vector<double> stages{diagnostics_.imbalanceBefore,
                             diagnostics_.imbalanceAfter,
                             static_cast<double>(diagnostics_.stages),
                             imbalances_.before,
                             imbalances_.after,
                             static_cast<double>(stages_),
                             growth_,
                             growthInStep_};
  archive.shared("chemistry_stages", stages);
  diagnostics_ = {counted[0], counted[1], counted[2],   counted[3],   counted[4],
                  counted[5], counted[6], stages.at(0), stages.at(1), static_cast<int>(stages.at(2))};
  imbalances_ = {stages.at(3), stages.at(4)};
  stages_ = static_cast<int>(stages.at(5));
  growth_ = stages.at(6);
  growthInStep_ = stages.at(7);
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
  if (all.stages > 0) {
    all.imbalanceBefore /= all.stages;
    all.imbalanceAfter /= all.stages;
  }
  diagnostics_ = {};
  return all;
}

std::vector<Quantity> ReactionOperator::historyColumns() const {
  return {{"stiff_solver_steps", "1", "internal steps of the stiff solver over all cells since the last row"},
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
}

std::vector<double> ReactionOperator::historyValues(const State&) {
  const Diagnostics d = takeDiagnostics();
  return {d.solverSteps,  d.integratedCells, d.skippedCells, d.handedOverCells, d.retries,
          d.limitedCells, d.coupledCells,    growthInStep_,  d.imbalanceBefore, d.imbalanceAfter};
}

void ReactionOperator::fields(const State& state, const FieldSink& sink) const {
  std::vector<double> heat = heatRelease_, enthalpies(static_cast<std::size_t>(state.species));
  for (std::size_t cell = 0; cell < heat.size(); ++cell)
    if (isLimited_[cell] == 0.0) heat[cell] = heatRelease(context_, state, cell, enthalpies);
  sink({"heat_release", "W/m^3", "heat set free by the gas reactions, mean of the last step"}, heat);
}

void ReactionOperator::addCost(const Mesh&, CellCost& cost) const {
  std::vector<double>& to = options_.shareWork ? cost.shared : cost.own;
  for (std::size_t cell = 0; cell < to.size(); ++cell) to[cell] += costOfStep_[cell];
}

std::optional<Operator::Imbalance> ReactionOperator::imbalance() const {
  if (stages_ == 0) return {};
  return Imbalance{imbalances_.before / stages_, imbalances_.after / stages_};
}

}  // namespace lampblack::flow
