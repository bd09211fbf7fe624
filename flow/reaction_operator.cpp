#include "flow/reaction_operator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/errors.hpp"

namespace lampblack::flow {

// How a cell is packed for the trip to another rank and back.
struct ReactionOperator::Layout {
  // in: centre (2), enthalpy, its constant source, guess of the temperature, pressure, first step, natural number, Y,
  // their constant sources
  static constexpr std::size_t inHeader = 8;
  // out: temperature, next first step, seconds, solver steps, retries, skipped, handed over, Y
  static constexpr std::size_t outHeader = 7;
};

namespace {

// Cells that are handed to the reactor at once: many more than it has lanes, so that few lanes wait for the last ones,
// and few enough for their states to stay in the processor's cache.
constexpr std::size_t cellsTogether = 256;

}  // namespace

ReactionOperator::ReactionOperator(const FlowContext& context, Options options)
    : context_(context),
      options_(options),
      reactor_(context.mechanism, options.reactor),
      sharing_(context.mesh.comm, options.shareWork),
      cost_(context.mesh.owned, 1e-4),
      initialStep_(context.mesh.owned, 0.0),
      rate_(cost_.size() * context.mechanism.numSpecies()) {}

// Of the step's start and end: reactions per mass and per volume are of second order to each other with it.
double ReactionOperator::meanDensity(const State& state, std::size_t cell) const {
  return before_.Y.empty() ? state.density[cell] : 0.5 * (before_.density[cell] + state.density[cell]);
}

void ReactionOperator::pack(const State& state, std::size_t cell, double dt, std::span<double> in) const {
  const auto n = static_cast<std::size_t>(state.species);
  const double* Y = &state.Y[cell * n];
  const double* before = before_.Y.empty() ? Y : &before_.Y[cell * n];
  const double enthalpy = before_.Y.empty() ? state.enthalpy[cell] : before_.enthalpy[cell];
  in[0] = context_.mesh.centre[cell][0];
  in[1] = context_.mesh.centre[cell][1];
  in[2] = enthalpy;
  in[3] = (state.enthalpy[cell] - enthalpy) / dt;
  in[4] = state.temperature[cell];
  in[5] = before_.Y.empty() ? state.thermodynamicPressure : 0.5 * (before_.pressure + state.thermodynamicPressure);
  in[6] = initialStep_[cell];
  in[7] = static_cast<double>(context_.mesh.naturalCell[cell]);
  const std::span<double> start = in.subspan(Layout::inHeader, n);
  const std::span<double> source = in.subspan(Layout::inHeader + n, n);
  std::copy_n(before, n, start.begin());
  // What transport alone has changed since then, at a constant rate.
  const double density = meanDensity(state, cell);
  for (std::size_t k = 0; k < n; ++k) source[k] = (Y[k] - before[k]) / dt - rate_[cell * n + k] / density;
}

void ReactionOperator::solve(double time, double dt, std::span<const std::span<const double>> in,
                             std::span<std::vector<double>> out) {
  const double start = MPI_Wtime();
  const std::size_t n = context_.mechanism.numSpecies(), count = in.size();
  const auto failure = [&](std::size_t i, const std::string& reason) {
    return NumericsError(fmt::format("chemistry failed in cell {:.0f} at ({:.6g}, {:.6g}) m at time {:.6g} s: {}",
                                     in[i][7], in[i][0], in[i][1], time, reason));
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
  // What is not of one cell is spread over all.
  double rest = MPI_Wtime() - start;
  for (const auto& result : results_) rest -= result.seconds;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& result = results_[i];
    out[i][0] = cells_[i].temperature;
    out[i][1] = cells_[i].initialStep;
    out[i][2] = result.seconds + std::max(rest, 0.0) / static_cast<double>(count);
    out[i][3] = result.steps;
    out[i][4] = result.retries;
    out[i][5] = result.skipped ? 1.0 : 0.0;
    out[i][6] = result.handedOver ? 1.0 : 0.0;
  }
}

void ReactionOperator::unpack(State& state, std::size_t cell, double dt, std::span<const double> out) {
  const auto n = static_cast<std::size_t>(state.species);
  const double density = meanDensity(state, cell);
  for (std::size_t k = 0; k < n; ++k) {
    double& Y = state.Y[cell * n + k];
    const double reacted = out[Layout::outHeader + k];
    rate_[cell * n + k] += density * (reacted - Y) / dt;
    Y = reacted;
  }
  // No net mass: the reactor keeps the sum of Y, so that round-off in the rate would feed on itself.
  double net = 0.0;
  for (std::size_t k = 0; k < n; ++k) net += rate_[cell * n + k];
  for (std::size_t k = 0; k < n; ++k) rate_[cell * n + k] -= net * state.Y[cell * n + k];
  state.temperature[cell] = out[0];
  initialStep_[cell] = out[1];
  // A smoothed cost: one solve's time is noisy on a shared machine.
  cost_[cell] = 0.5 * (cost_[cell] + out[2]);
  diagnostics_.solverSteps += out[3];
  diagnostics_.retries += out[4];
  diagnostics_.skippedCells += out[5];
  diagnostics_.integratedCells += 1.0 - out[5];
  diagnostics_.handedOverCells += out[6];
}

void ReactionOperator::advance(State& state, double time, double dt) {
  const auto n = static_cast<std::size_t>(state.species);
  WorkSharing::Items items;
  items.cost = cost_;
  items.pack = [&](std::size_t cell, std::vector<double>& in) {
    in.resize(Layout::inHeader + 2 * n);
    pack(state, cell, dt, in);
  };
  items.groupSize = cellsTogether;
  items.advanceGroup = [&](std::span<const std::span<const double>> in, std::span<std::vector<double>> out) {
    solve(time, dt, in, out);
  };
  items.unpack = [&](std::size_t cell, std::span<const double> out) { unpack(state, cell, dt, out); };
  const auto statistics = sharing_.run(items);
  diagnostics_.imbalanceBefore += statistics.imbalanceBefore;
  diagnostics_.imbalanceAfter += statistics.imbalanceAfter;
  ++diagnostics_.stages;
  imbalances_.before += statistics.imbalanceBefore;
  imbalances_.after += statistics.imbalanceAfter;
  ++stages_;
  state.updateHalo(context_.halo);
}

void ReactionOperator::endSweep(State& state) {
  for (std::size_t i = 0; i < rate_.size(); ++i) state.balance.species[i] += rate_[i];
}

void ReactionOperator::endStep(State& state) {
  const auto owned = static_cast<std::ptrdiff_t>(cost_.size());
  before_.Y.assign(state.Y.begin(), state.Y.begin() + static_cast<std::ptrdiff_t>(rate_.size()));
  before_.density.assign(state.density.begin(), state.density.begin() + owned);
  before_.enthalpy.assign(state.enthalpy.begin(), state.enthalpy.begin() + owned);
  before_.pressure = state.thermodynamicPressure;
}

// What a step begins with is the state: endStep() takes it from there after loading.
void ReactionOperator::saveOrLoad(StateArchive& archive) {
  archive.cells("chemistry_cost", cost_, 1);
  archive.cells("chemistry_first_step", initialStep_, 1);
  archive.cells("chemistry_rate", rate_, static_cast<int>(context_.mechanism.numSpecies()));
  std::array<double, 5> counted{diagnostics_.solverSteps, diagnostics_.integratedCells, diagnostics_.skippedCells,
                                diagnostics_.handedOverCells, diagnostics_.retries};
  archive.sums("chemistry_counts", counted);
  std::vector<double> stages{
      diagnostics_.imbalanceBefore, diagnostics_.imbalanceAfter, static_cast<double>(diagnostics_.stages),
      imbalances_.before,           imbalances_.after,           static_cast<double>(stages_)};
  archive.shared("chemistry_stages", stages);
  diagnostics_ = {counted[0], counted[1],   counted[2],   counted[3],
                  counted[4], stages.at(0), stages.at(1), static_cast<int>(stages.at(2))};
  imbalances_ = {stages.at(3), stages.at(4)};
  stages_ = static_cast<int>(stages.at(5));
}

ReactionOperator::Diagnostics ReactionOperator::takeDiagnostics() {
  Diagnostics all = diagnostics_;
  double sums[5] = {all.solverSteps, all.integratedCells, all.skippedCells, all.handedOverCells, all.retries};
  MPI_Allreduce(MPI_IN_PLACE, sums, 5, MPI_DOUBLE, MPI_SUM, context_.mesh.comm);
  all.solverSteps = sums[0];
  all.integratedCells = sums[1];
  all.skippedCells = sums[2];
  all.handedOverCells = sums[3];
  all.retries = sums[4];
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
          {"imbalance_before", "1", "busiest rank's chemistry cost over the mean, as partitioned"},
          {"imbalance_after", "1", "the same as measured, with work sharing"}};
}

std::vector<double> ReactionOperator::historyValues(const State&) {
  const Diagnostics d = takeDiagnostics();
  return {d.solverSteps, d.integratedCells, d.skippedCells,  d.handedOverCells,
          d.retries,     d.imbalanceBefore, d.imbalanceAfter};
}

std::optional<Operator::Imbalance> ReactionOperator::imbalance() const {
  if (stages_ == 0) return {};
  return Imbalance{imbalances_.before / stages_, imbalances_.after / stages_};
}

}  // namespace lampblack::flow
