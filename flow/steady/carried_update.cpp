#include "flow/steady/carried_update.hpp"

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace lampblack::flow {
namespace {

constexpr double carriedReduction = 0.01;  // of the linear system's residual
constexpr int mostCarriedIterations = 60;
// What an iteration leaves of an amount at least and at most; and at most, of the largest amount anywhere, beside that.
constexpr double leastLeft = 0.1, mostLeft = 10.0, mostBeside = 1e-4;
// Of its change a cell takes half, and half of that, until what it leaves of the cell's equations is less than there
// was by so much of the share; but so many times at most.
constexpr double leastGain = 0.1;
constexpr int mostHalvings = 6;
// What a face may have, over the value upwind.
constexpr double mostOverUpwind = 3.0;
// Amounts, of the largest anywhere, below which what is left of an equation does not count more.
constexpr double leastCounted = 1e-8;

}  // namespace

CarriedUpdate::CarriedUpdate(const FlowContext& context, const State& state, const FlowResidual& residual,
                             const std::vector<Operator*>& operators)
    : context_(context),
      n_(state.scalars.size()),
      system_(context.mesh, context.halo, n_),
      sweeps_(context, n_),
      scales_(n_) {
  std::ranges::copy_if(operators, std::back_inserter(operators_), &Operator::actsOnCarried);
  isByCell_ = std::ranges::all_of(operators_, [&](Operator* op) { return op->carriedInCells(state) != nullptr; });
  if (!isByCell_) slopes_.resize(static_cast<std::size_t>(context.mesh.owned) * n_ * n_);
  right_.resize(static_cast<std::size_t>(context.mesh.owned) * n_);
  change_.resize(static_cast<std::size_t>(context.mesh.cells) * n_);
  start_.resize(right_.size());
  startRates_.resize(right_.size());
  shares_.resize(static_cast<std::size_t>(context.mesh.owned));
  made_ = residual.rates().made;
  conductance_.resize(static_cast<std::size_t>(context.mesh.faces) * n_);
  flux_.resize(conductance_.size());
  flow_.resize(conductance_.size());
  moved_.resize(right_.size());
}

void CarriedUpdate::findScales(const State& state) {
  std::ranges::fill(scales_, 0.0);
  for (std::size_t c = 0; c < static_cast<std::size_t>(context_.mesh.owned); ++c)
    for (std::size_t s = 0; s < n_; ++s)
      scales_[s] = std::max(scales_[s], std::abs(state.carried[c * n_ + s]) / state.density[c]);
  MPI_Allreduce(MPI_IN_PLACE, scales_.data(), static_cast<int>(n_), MPI_DOUBLE, MPI_MAX, context_.mesh.comm);
  for (std::size_t s = 0; s < n_; ++s) {
    scales_[s] = std::max(scales_[s], state.scalars[s].negligible);
    if (scales_[s] <= 0.0) scales_[s] = 1.0;
  }
}

void CarriedUpdate::assemble(const State& state, const FlowResidual& residual, std::span<const double> inertia) {
  const Mesh& m = context_.mesh;
  std::ranges::fill(slopes_, 0.0);
  std::ranges::fill(flow_, 0.0);
  for (Operator* op : operators_) {
    if (isByCell_) continue;
    op->addSlopes(state, {{}, slopes_});
    op->addCarriedFlow(flow_);
  }
  const FlowResidual::Rates& rates = residual.rates();
  system_.clear();
  for (int cell = 0; cell < m.owned; ++cell) {
    const auto c = static_cast<std::size_t>(cell);
    double* block = system_.block(cell);
    for (std::size_t s = 0; s < n_; ++s) {
      const double perMass = state.carried[c * n_ + s] / state.density[c];
      const bool moves = state.scalars[s].isTransported;
      right_[c * n_ + s] = moves ? (rates.carried[c * n_ + s] - perMass * rates.mass[c]) / scales_[s] : 0.0;
      for (std::size_t by = 0; by < n_ && moves && !isByCell_; ++by)
        block[by * n_ + s] -=
            m.volume[c] * state.density[c] * slopes_[(c * n_ + by) * n_ + s] * scales_[by] / scales_[s];
    }
    system_.addInertia(cell, inertia[c]);
  }
  std::ranges::fill(conductance_, 0.0);
  residual.carried().diffusiveFlux(state, residual.faces(), residual.properties(), conductance_, flux_);
  for (int face = 0; face < m.faces; ++face)
    for (std::size_t s = 0; s < n_; ++s) {
      if (!state.scalars[s].isTransported) continue;
      const std::size_t at = static_cast<std::size_t>(face) * n_ + s;
      if (isByCell_) {
        system_.connect(face, s, conductance_[at], 0.0);
        system_.drift(face, s, flowOf(state, residual, face, s));
        continue;
      }
      system_.connect(face, s, conductance_[at], state.massFlux[face]);
      if (flow_[at] != 0.0) system_.connect(face, s, 0.0, flow_[at]);
      const double drift = state.scalars[s].thermophoresis * residual.carried().driftFlux()[face];
      if (m.high[face] >= 0 && drift != 0.0) system_.drift(face, s, drift);
    }
  if (!isByCell_) dropFastGrowth(state);
}

// kg/s, upwind: what goes through a face, by a limited scheme, over what there is where it comes from. Where amounts
// fall by decades from cell to cell that is far from what flows there.
double CarriedUpdate::flowOf(const State& state, const FlowResidual& residual, int face, std::size_t s) const {
  const Mesh& m = context_.mesh;
  if (m.high[face] < 0) return std::max(state.massFlux[face], 0.0);
  const double flow = state.massFlux[face] + state.scalars[s].thermophoresis * residual.carried().driftFlux()[face];
  const auto from = static_cast<std::size_t>(flow > 0.0 ? m.low[face] : m.high[face]);
  const double perMass = state.carried[from * n_ + s] / state.density[from];
  const double passes = residual.carried().flux()[static_cast<std::size_t>(face) * n_ + s];
  if (!(perMass > 0.0) || !(passes * flow > 0.0)) return flow;
  return flow * std::min(passes / (flow * perMass), mostOverUpwind);
}

// What grows by itself faster than the pseudo-time and transport let it would be led the wrong way by its derivative,
// away from where its equation wants it.
void CarriedUpdate::dropFastGrowth(const State& state) {
  for (int cell = 0; cell < context_.mesh.owned; ++cell) {
    const auto c = static_cast<std::size_t>(cell);
    const double mass = context_.mesh.volume[c] * state.density[c];
    for (std::size_t s = 0; s < n_; ++s) {
      double& own = system_.block(cell)[s * (n_ + 1)];
      double& slope = slopes_[(c * n_ + s) * n_ + s];
      if (own > 0.0 || slope <= 0.0) continue;
      own += mass * slope;
      slope = 0.0;
    }
  }
}

void CarriedUpdate::take(State& state, int cell) const {
  const auto c = static_cast<std::size_t>(cell);
  for (std::size_t s = 0; s < n_; ++s) {
    const double change = shares_[c] * scales_[s] * change_[c * n_ + s];
    state.carried[c * n_ + s] = state.density[c] * limited(s, start_[c * n_ + s], change);
  }
}

double CarriedUpdate::limited(std::size_t scalar, double present, double change) const {
  const double least = leastLeft * std::max(present, 0.0);
  const double most = mostLeft * std::max(present, 0.0) + mostBeside * scales_[scalar];
  return std::clamp(present + change, least, most);
}

bool CarriedUpdate::isHeld(std::size_t scalar, double present, double change) const {
  return std::abs(limited(scalar, present, change) - (present + change)) > leastCounted * scales_[scalar];
}

// Of the change that was taken last.
std::int64_t CarriedUpdate::heldCells() const {
  std::int64_t held = 0;
  for (std::size_t c = 0; c < shares_.size(); ++c)
    for (std::size_t s = 0; s < n_; ++s) {
      const std::size_t i = c * n_ + s;
      if (!isHeld(s, start_[i], shares_[c] * scales_[s] * change_[i])) continue;
      ++held;
      break;
    }
  MPI_Allreduce(MPI_IN_PLACE, &held, 1, MPI_INT64_T, MPI_SUM, context_.mesh.comm);
  return held;
}

// 1/s, of the amounts: what the cell's equations have left after a share of its change (none: before it), its
// neighbours having changed by as much.
double CarriedUpdate::leftOf(const State& state, int cell, double share) const {
  const auto c = static_cast<std::size_t>(cell);
  const double V = context_.mesh.volume[c], mass = V * state.density[c];
  double sum = 0.0;
  for (std::size_t s = 0; s < n_; ++s) {
    if (!state.scalars[s].isTransported) continue;
    const std::size_t i = c * n_ + s;
    double left = (1.0 - share) * right_[i];
    if (share > 0.0) {
      double expected = 0.0;
      for (std::size_t by = 0; by < n_; ++by)
        expected += slopes_[(c * n_ + by) * n_ + s] * scales_[by] * change_[c * n_ + by];
      left += (V * (made_.netOfCarried(i, state.carried) - startRates_[i]) - share * mass * expected) / scales_[s] -
              share * moved_[i];
    }
    left /= mass * (std::abs(start_[i]) / scales_[s] + leastCounted);
    sum += left * left;
  }
  return std::sqrt(sum);
}

void CarriedUpdate::findMoved() {
  const Mesh& m = context_.mesh;
  std::ranges::fill(moved_, 0.0);
  for (int face = 0; face < m.faces; ++face) {
    const int low = m.low[face], high = m.high[face];
    for (std::size_t s = 0; s < n_; ++s) {
      const double flow = flow_[static_cast<std::size_t>(face) * n_ + s];
      if (flow == 0.0) continue;
      const std::size_t ofLow = static_cast<std::size_t>(low) * n_ + s;
      const std::size_t ofHigh = static_cast<std::size_t>(std::max(high, 0)) * n_ + s;
      const double rise = (high < 0 ? 0.0 : change_[ofHigh]) - change_[ofLow];
      if (low < m.owned) moved_[ofLow] += std::max(-flow, 0.0) * rise;
      if (high >= 0 && high < m.owned) moved_[ofHigh] -= std::max(flow, 0.0) * rise;
    }
  }
}

void CarriedUpdate::takeShares(State& state, const FlowResidual& residual) {
  const auto owned = static_cast<std::size_t>(context_.mesh.owned);
  std::vector<double> before(owned);
  for (std::size_t c = 0; c < owned; ++c) {
    for (std::size_t i = c * n_; i < (c + 1) * n_; ++i) {
      start_[i] = state.carried[i] / state.density[c];
      startRates_[i] = residual.rates().made.netOfCarried(i, state.carried);
    }
    before[c] = leftOf(state, static_cast<int>(c), 0.0);
  }
  findMoved();
  std::ranges::fill(shares_, 1.0);
  std::int64_t less = 1;
  for (int halvings = 0; less > 0; ++halvings) {
    for (int c = 0; c < context_.mesh.owned; ++c) take(state, c);
    if (halvings == mostHalvings) break;
    // Of a cell beside those of another rank the slopes count what these have taken.
    context_.halo.update(state.carried, static_cast<int>(n_));
    made_.clear();
    for (Operator* op : operators_) op->addRatesOfCarried(state, made_);
    less = 0;
    for (std::size_t c = 0; c < owned; ++c)
      if (!(leftOf(state, static_cast<int>(c), shares_[c]) <= (1.0 - leastGain * shares_[c]) * before[c])) {
        shares_[c] *= 0.5;
        ++less;
      }
    MPI_Allreduce(MPI_IN_PLACE, &less, 1, MPI_INT64_T, MPI_SUM, context_.mesh.comm);
  }
}

std::int64_t CarriedUpdate::sweep(State& state, const FlowResidual& residual, std::span<const double> inertia) {
  std::vector<double> rates(right_.size());
  for (std::size_t i = 0; i < rates.size(); ++i) rates[i] = residual.rates().made.netOfCarried(i, state.carried);
  std::vector<std::unique_ptr<Operator::CarriedInCells>> sources;
  for (Operator* op : operators_) sources.push_back(op->carriedInCells(state));
  return sweeps_.advance(state, {system_, inertia, right_, scales_, rates, sources});
}

void CarriedUpdate::prepare(const State& state, const FlowResidual& residual, std::span<const double> inertia) {
  findScales(state);
  assemble(state, residual, inertia);
  if (!isByCell_) system_.factorise();
}

int CarriedUpdate::solve(std::span<const double> right, std::span<double> change, double reduction) {
  for (std::size_t i = 0; i < right.size(); ++i) right_[i] = right[i] / scales_[i % n_];
  const int iterations = system_.solve(right_, change, reduction, mostCarriedIterations).iterations;
  for (std::size_t i = 0; i < change.size(); ++i) change[i] *= scales_[i % n_];
  return iterations;
}

std::int64_t CarriedUpdate::advance(State& state, const FlowResidual& residual, std::span<const double> inertia) {
  prepare(state, residual, inertia);
  std::int64_t held = 0;
  if (isByCell_) {
    held = sweep(state, residual, inertia);
  } else {
    system_.solve(right_, change_, carriedReduction, mostCarriedIterations);
    takeShares(state, residual);
    held = heldCells();
  }
  for (Operator* op : operators_) op->setDiffusivities(state);
  state.updateHalo(context_.halo);
  return held;
}

}  // namespace lampblack::flow
