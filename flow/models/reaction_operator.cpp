#include "flow/models/reaction_operator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "chemistry/reactor/reactor_failure.hpp"
#include "core/errors.hpp"
#include "core/group_failure.hpp"
#include "flow/cell_errors.hpp"
#include "flow/models/constant_pressure_cells.hpp"

namespace lampblack::flow {
namespace {

// Cells whose slopes, dense matrices, are kept at once.
constexpr std::size_t mostSlopesTogether = 32;

}  // namespace

ReactionOperator::ReactionOperator(const FlowContext& context, const Options& options)
    : ReactionOperator(context, options,
                       std::make_unique<ConstantPressureCells>(context.mechanism, context.thermo, options.reactor)) {}

ReactionOperator::ReactionOperator(const FlowContext& context, Options options, std::unique_ptr<CellReactor> reactor)
    : context_(context),
      options_(std::move(options)),
      reactor_(std::move(reactor)),
      // Some cells change between the methods from step to step: their costs are smoothed.
      work_(context, {.name = "chemistry", .subject = "chemistry", .isShared = options_.shareWork, .isSmoothed = true}),
      initialStep_(static_cast<std::size_t>(context.mesh.owned)),
      isLimited_(initialStep_.size()),
      heatRelease_(initialStep_.size()),
      growthRate_(context.mechanism, options_.reactor.leastFraction()),
      outruns_(initialStep_.size()),
      isTaken_(initialStep_.size()),
      grows_(initialStep_.size()),
      fastest_(initialStep_.size()),
      askedChange_(initialStep_.size()),
      unasked_(initialStep_.size()) {}

// Of the gas in which transport counts the rate as one per mass.
double ReactionOperator::densityOfRate(const State& state, std::size_t cell) const {
  return isLimited_[cell] != 0.0 ? state.density[cell] : meanDensity(state, cell);
}

// Of the step's start and end: reactions per mass and per volume are of second order to each other with it.
double ReactionOperator::meanDensity(const State& state, std::size_t cell) const {
  return state.start.Y.empty() ? state.density[cell] : 0.5 * (state.start.density[cell] + state.density[cell]);
}

void ReactionOperator::solve(double dt, std::span<const SharedCellWork::Task<CellReactor::Gas>> tasks,
                             std::span<CellReactor::Result> results, std::span<RowWriter> rows) {
  const std::size_t n = context_.mechanism.numSpecies();
  cells_.resize(tasks.size());
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const std::span<double> Y = rows[i].add(n);
    std::ranges::copy(tasks[i].rows.first(n), Y.begin());
    cells_[i] = {tasks[i].input, Y, tasks[i].rows.subspan(n)};
  }
  try {
    reactor_->advance(cells_, dt, results);
  } catch (const ReactorFailure& error) {
    if (!options_.keepFailed) throw;
    const auto number = static_cast<std::int64_t>(tasks[error.place()].label.number);
    throw FailureInGroup(error.what() + options_.keepFailed(number, error.cell()), error.place());
  }
}

ReactionOperator::Work ReactionOperator::workOver(double dt) {
  Work work;
  work.together = reactor_->cellsTogether();
  work.advance = [this, dt](const auto& tasks, const auto& results, const auto& rows) {
    solve(dt, tasks, results, rows);
  };
  return work;
}

void ReactionOperator::take(State& state, std::size_t cell, double dt, const CellReactor::Result& result,
                            std::span<const double> reacted) {
  const auto n = static_cast<std::size_t>(state.species);
  const double density = meanDensity(state, cell), densityOfLast = densityOfRate(state, cell);
  for (std::size_t k = 0; k < n; ++k) {
    double& Y = state.Y[cell * n + k];
    double& rate = state.balance.reactions[cell * n + k];
    rate = density * ((reacted[k] - Y) / dt + rate / densityOfLast);
    Y = reacted[k];
  }
  isLimited_[cell] = 0.0;
  // The reactor keeps the sum of Y, so that round-off in the rate would feed on itself.
  removeNetMass(state, cell);
  state.temperature[cell] = result.temperature;
  initialStep_[cell] = result.firstStep;
}

void ReactionOperator::count(const CellReactor::Result& result) {
  diagnostics_.solverSteps += result.steps;
  diagnostics_.retries += result.retries;
  diagnostics_.skippedCells += result.isSkipped;
  diagnostics_.integratedCells += 1.0 - result.isSkipped;
  diagnostics_.handedOverCells += result.isHandedOver;
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

// Called by whatever comes first in a step.
void ReactionOperator::begin(double dt) {
  work_.beginStep();
  step_ = dt;
}

void ReactionOperator::advance(State& state, double time, double dt) {
  begin(dt);
  std::vector<int> cells;
  for (int cell = 0; cell < context_.mesh.owned; ++cell)
    if (!isTaken_[static_cast<std::size_t>(cell)]) cells.push_back(cell);
  if (options_.map)
    advanceMapped(state, time, dt, cells);
  else
    advanceCells(state, time, dt, cells, [&](int cell, const CellReactor::Result& result, std::span<const double> Y) {
      take(state, static_cast<std::size_t>(cell), dt, result, Y);
    });
  state.updateHalo(context_.halo);
}

void ReactionOperator::advanceCells(const State& state, double time, double dt, std::span<const int> cells,
                                    const TakeCell& takeCell) {
  const auto n = static_cast<std::size_t>(state.species);
  const bool isFirst = state.start.Y.empty();  // no step was taken: there is but the present state
  const std::vector<double>& startY = isFirst ? state.Y : state.start.Y;
  const std::vector<double>& startEnthalpy = isFirst ? state.enthalpy : state.start.enthalpy;
  const double pressure =
      isFirst ? state.thermodynamicPressure : 0.5 * (state.start.thermodynamicPressure + state.thermodynamicPressure);
  std::vector<SharedCellWork::Item> items;
  for (const int cell : cells) items.push_back({cell, work_.expectedCost(cell)});
  Work work = workOver(dt);
  work.pack = [&](std::size_t item, RowWriter rows) -> CellReactor::Gas {
    const auto cell = static_cast<std::size_t>(cells[item]);
    const double* Y = &state.Y[cell * n];
    const double* before = &startY[cell * n];
    const std::span<double> values = rows.add(2 * n), start = values.first(n), source = values.last(n);
    std::copy_n(before, n, start.begin());
    // What transport alone has changed since then, at a constant rate.
    const double density = densityOfRate(state, cell);
    const double* rate = &state.balance.reactions[cell * n];
    for (std::size_t k = 0; k < n; ++k) source[k] = (Y[k] - before[k]) / dt - rate[k] / density;
    return {startEnthalpy[cell],     (state.enthalpy[cell] - startEnthalpy[cell]) / dt,
            state.temperature[cell], pressure,
            initialStep_[cell],      mixingOf(cell)};
  };
  work.unpack = [&](std::size_t item, const CellReactor::Result& result, std::span<const double> Y) {
    takeCell(cells[item], result, Y);
    count(result);
  };
  diagnostics_.imbalance.add(work_.advance(items, time, work));
}

double heatRelease(const FlowContext& context, const State& state, std::size_t cell, std::span<double> enthalpies) {
  const auto n = static_cast<std::size_t>(state.species);
  context.thermo.speciesEnthalpies(state.temperature[cell], enthalpies);
  double heat = 0.0;
  for (std::size_t k = 0; k < n; ++k) heat -= enthalpies[k] * state.balance.reactions[cell * n + k];
  return heat;
}

// The rates of each cell as the reactor has them, with their slopes where those are wanted: take(cell, rates, slopes).
template <typename Take>
void ReactionOperator::eachRates(const State& state, bool wantsSlopes, const Take& take) {
  const auto n = static_cast<std::size_t>(state.species), width = n + 1;
  const std::span<const CellMixing> mixing = mixing_ ? mixing_->of(state) : std::span<const CellMixing>();
  const std::size_t together =
      wantsSlopes ? std::min(mostSlopesTogether, reactor_->cellsTogether()) : reactor_->cellsTogether();
  const std::size_t ofSlopes = wantsSlopes ? width * width : 0;
  std::vector<double> values(together * n), slopes(together * ofSlopes);
  std::vector<CellReactor::Asked> asked;
  inGroupsOfCells(context_.mesh, static_cast<int>(together), [&](std::span<const int> cells) {
    asked.assign(cells.size(), {});
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto cell = static_cast<std::size_t>(cells[i]);
      asked[i].gas.temperature = state.temperature[cell];
      asked[i].gas.pressure = state.thermodynamicPressure;
      if (mixing_) asked[i].gas.mixing = mixing[cell];
      asked[i].Y = {&state.Y[cell * n], n};
      asked[i].rates = {{&values[i * n], n}, std::span(slopes).subspan(i * ofSlopes, ofSlopes)};
    }
    reactor_->rates(asked);
    for (std::size_t i = 0; i < cells.size(); ++i)
      take(static_cast<std::size_t>(cells[i]), asked[i].rates.values, asked[i].rates.slopes);
  });
}

void ReactionOperator::addRates(const State& state, State::Balance& rates) {
  const auto n = static_cast<std::size_t>(state.species);
  eachRates(state, false, [&](std::size_t cell, std::span<const double> rate, std::span<const double>) {
    for (std::size_t k = 0; k < n; ++k) rates.reactions[cell * n + k] += state.density[cell] * rate[k];
  });
}

void ReactionOperator::addSlopes(const State& state, const Slopes& slopes) {
  const auto n = static_cast<std::size_t>(state.species), width = n + 1;
  const auto weights = context_.mechanism.molecularWeights();
  std::vector<double> ofShare(width, 0.0);
  eachRates(state, true, [&](std::size_t cell, std::span<const double> rate, std::span<const double> J) {
    // Per kg there, and per m^3 here: the density changes as well.
    const double rho = state.density[cell], W = context_.thermo.meanMolecularWeight({&state.Y[cell * n], n});
    double* to = &slopes.gas[cell * width * width];
    if (mixing_) mixing_->slopesOfShare(state, static_cast<int>(cell), ofShare);
    for (std::size_t j = 0; j < width; ++j) {
      const double lighter = j < n ? W / weights[j] : 1.0 / state.temperature[cell];
      for (std::size_t k = 0; k < n; ++k)
        to[j * width + k] += rho * (J[j * width + k] + rate[k] * (ofShare[j] - lighter));
    }
  });
}

void ReactionOperator::endStep(State& state) {
  if (step_ > 0.0 && !state.start.Y.empty())  // else the state is a new one
    for (std::size_t cell = 0; cell < isLimited_.size(); ++cell) {
      limitRates(state, cell);
      diagnostics_.limitedCells += isLimited_[cell];
    }
  for (char& isTaken : isTaken_) {
    diagnostics_.coupledCells += isTaken;
    isTaken = 0;
  }
  work_.endStep();
  step_ = 0.0;
}

void ReactionOperator::setRates(State& state, std::span<const double> rates) {
  state.balance.reactions.assign(rates.begin(), rates.end());
  std::ranges::fill(isLimited_, 0.0);
}

}  // namespace lampblack::flow
