#include "flow/steady/carried_sweeps.hpp"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "flow/cell_errors.hpp"

namespace lampblack::flow {
namespace {

constexpr int mostSweeps = 6;
constexpr double sweepReduction = 0.01;  // of a sweep's change, beside that of the first, that ends them
constexpr int mostStepsOfCell = 10;      // of Newton's method in a cell, a sweep
constexpr double cellReduction = 0.01;   // of what is left in a cell, in a sweep
// What a step leaves of an amount at least and at most; and at most, beside that, over the scale.
constexpr double leastOfAmount = 0.1, mostOfAmount = 10.0, mostAdded = 1e-4;
// A step is halved, so many times, until it leaves less by a tenth of the share.
constexpr double leastTaken = 0.1;
constexpr int mostShares = 5;
constexpr double leastAmount = 1e-8;  // over the scale

}  // namespace

CarriedSweeps::CarriedSweeps(const FlowContext& context, std::size_t fields) : context_(context), n_(fields) {
  const auto owned = static_cast<std::size_t>(context.mesh.owned);
  order_.reserve(owned);
  x_.resize(static_cast<std::size_t>(context.mesh.cells) * n_);
  leaves_.resize(owned * n_);
  constant_.resize(owned * n_);
  for (std::vector<double>* all : {&fed_, &left_, &trial_, &change_, &amounts_, &rates_}) all->resize(n_);
  slopes_.resize(n_ * n_);
  matrix_.resize(n_ * n_);
  pivots_.resize(n_);
}

// Cells behind those that the gas comes from, where it does not come back: depth first, upstream.
void CarriedSweeps::findOrder(const State& state) {
  const Mesh& m = context_.mesh;
  order_.clear();
  std::vector<char> isSeen(static_cast<std::size_t>(m.owned), 0);
  struct Visit {
    int cell, next;
  };
  std::vector<Visit> way;
  for (int first = 0; first < m.owned; ++first) {
    if (isSeen[first] != 0) continue;
    isSeen[first] = 1;
    way.push_back({first, m.faceStart[first]});
    while (!way.empty()) {
      Visit& visit = way.back();
      if (visit.next == m.faceStart[visit.cell + 1]) {
        order_.push_back(visit.cell);
        way.pop_back();
        continue;
      }
      const int face = m.faceOfCell[visit.next++];
      const bool isLow = m.low[face] == visit.cell;
      const int other = isLow ? m.high[face] : m.low[face];
      if (other < 0 || other >= m.owned || isSeen[other] != 0) continue;
      if (isLow ? state.massFlux[face] >= 0.0 : state.massFlux[face] <= 0.0) continue;
      isSeen[other] = 1;
      way.push_back({other, m.faceStart[other]});
    }
  }
}

// What the system of changes does not have, of second order above all: what it brings feeds the cell, what it takes is
// taken in proportion to what there is, so that nothing is left below zero.
void CarriedSweeps::prepare(const State& state, const Problem& problem) {
  const Mesh& m = context_.mesh;
  for (std::size_t c = 0; c < static_cast<std::size_t>(m.cells); ++c)
    for (std::size_t s = 0; s < n_; ++s)
      x_[c * n_ + s] = std::max(state.carried[c * n_ + s], 0.0) / (state.density[c] * problem.scales[s]);
  for (int cell = 0; cell < m.owned; ++cell) {
    const auto c = static_cast<std::size_t>(cell);
    std::ranges::fill(fed_, 0.0);
    problem.transport.addBrought(cell, x_, fed_);
    for (std::size_t s = 0; s < n_; ++s) {
      const std::size_t i = c * n_ + s;
      const double diagonal = problem.transport.block(cell)[s * (n_ + 1)];
      const double inertia = problem.inertia[c] * x_[i];
      const double beside =
          problem.right[i] + diagonal * x_[i] - inertia - fed_[s] - m.volume[c] * problem.rates[i] / problem.scales[s];
      leaves_[i] = diagonal + (beside < 0.0 && x_[i] > 0.0 ? -beside / x_[i] : 0.0);
      constant_[i] = inertia + std::max(beside, 0.0);
    }
  }
}

void CarriedSweeps::findSources(const State& state, const Problem& problem, int cell, std::span<const double> x,
                                bool slopes) {
  for (std::size_t s = 0; s < n_; ++s) amounts_[s] = state.density[cell] * problem.scales[s] * x[s];
  std::ranges::fill(rates_, 0.0);
  if (slopes) std::ranges::fill(slopes_, 0.0);
  for (const auto& source : problem.sources)
    source->add(cell, amounts_, rates_, slopes ? std::span<double>(slopes_) : std::span<double>());
}

double CarriedSweeps::findLeft(const State& state, const Problem& problem, int cell, std::span<const double> x) {
  const auto c = static_cast<std::size_t>(cell);
  double sum = 0.0;
  for (std::size_t s = 0; s < n_; ++s) {
    const std::size_t i = c * n_ + s;
    left_[s] = state.scalars[s].isTransported ? constant_[i] + fed_[s] - leaves_[i] * x[s] +
                                                    context_.mesh.volume[c] * rates_[s] / problem.scales[s]
                                              : 0.0;
    const double over = left_[s] / (leaves_[i] * (x[s] + leastAmount));
    sum += over * over;
  }
  return std::sqrt(sum);
}

bool CarriedSweeps::solveCell(const State& state, const Problem& problem, int cell) {
  const auto c = static_cast<std::size_t>(cell);
  const double mass = context_.mesh.volume[c] * state.density[c];
  const std::span<double> x{&x_[c * n_], n_};
  std::ranges::fill(fed_, 0.0);
  problem.transport.addBrought(cell, x_, fed_);
  double first = 0.0;
  bool isHeld = false;
  for (int step = 0; step < mostStepsOfCell; ++step) {
    findSources(state, problem, cell, x, true);
    const double before = findLeft(state, problem, cell, x);
    if (step == 0) first = before;
    if (before <= (step == 0 ? 0.0 : cellReduction * first)) break;
    for (std::size_t by = 0; by < n_; ++by)
      for (std::size_t s = 0; s < n_; ++s) {
        const double slope =
            state.scalars[s].isTransported ? mass * slopes_[by * n_ + s] * problem.scales[by] / problem.scales[s] : 0.0;
        double& value = matrix_[by * n_ + s];
        value = -slope;
        if (s != by) continue;
        // What grows by itself faster than it is carried away would be led the wrong way by its derivative.
        value = leaves_[c * n_ + s] > slope ? leaves_[c * n_ + s] - slope : leaves_[c * n_ + s];
      }
    std::ranges::copy(left_, change_.begin());
    if (!dense_.factorise(n_, matrix_.data(), pivots_.data()))
      throw NumericsError("an iteration towards the steady state finds no change of what a cell carries");
    dense_.solve(n_, matrix_.data(), pivots_.data(), 1, change_.data());
    double share = 1.0;
    for (int halvings = 0;; ++halvings) {
      for (std::size_t s = 0; s < n_; ++s)
        trial_[s] = std::clamp(x[s] + share * change_[s], leastOfAmount * x[s], mostOfAmount * x[s] + mostAdded);
      if (halvings == mostShares) break;
      findSources(state, problem, cell, trial_, false);
      if (findLeft(state, problem, cell, trial_) <= (1.0 - leastTaken * share) * before) break;
      share *= 0.5;
    }
    isHeld = false;
    for (std::size_t s = 0; s < n_; ++s) {
      isHeld = isHeld || std::abs(trial_[s] - (x[s] + share * change_[s])) > leastAmount;
      moved_ += mass * std::abs(trial_[s] - x[s]);
      x[s] = trial_[s];
    }
  }
  return isHeld;
}

std::int64_t CarriedSweeps::advance(State& state, const Problem& problem) {
  const Mesh& m = context_.mesh;
  findOrder(state);
  prepare(state, problem);
  double first = 0.0;
  int sweeps = 0;
  std::int64_t held = 0;
  while (sweeps < mostSweeps) {
    moved_ = 0.0;
    held = 0;
    inEachCell(
        m, [&](int c) { held += solveCell(state, problem, c) ? 1 : 0; },
        [&](int i) { return order_[static_cast<std::size_t>(sweeps % 2 == 0 ? i : m.owned - 1 - i)]; });
    MPI_Allreduce(MPI_IN_PLACE, &moved_, 1, MPI_DOUBLE, MPI_SUM, m.comm);
    context_.halo.update(x_, static_cast<int>(n_));
    if (sweeps++ == 0) first = moved_;
    if (moved_ <= sweepReduction * first) break;
  }
  for (std::size_t c = 0; c < static_cast<std::size_t>(m.owned); ++c)
    for (std::size_t s = 0; s < n_; ++s)
      if (state.scalars[s].isTransported)
        state.carried[c * n_ + s] = state.density[c] * problem.scales[s] * x_[c * n_ + s];
  MPI_Allreduce(MPI_IN_PLACE, &held, 1, MPI_INT64_T, MPI_SUM, m.comm);
  return held;
}

}  // namespace lampblack::flow
