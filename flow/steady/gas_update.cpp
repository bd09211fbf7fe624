#include "flow/steady/gas_update.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "flow/cell_errors.hpp"

namespace lampblack::flow {
namespace {

// What an iteration changes in a cell at most.
constexpr double mostRise = 100.0;      // K
constexpr double mostOfFraction = 0.1;  // mass fraction of any species
constexpr double leastOfTrace = 0.1;    // of itself, of a trace, that is left
constexpr double mostTaken = 0.9;       // of a species that is more than a trace, where not all may be taken
constexpr double gasReduction = 0.01;   // of the linear system's residual
constexpr int mostGasIterations = 60;
// Where so much is left of it after these, its factors lead nowhere: the next keep less of their fill, that share of
// it.
constexpr double leadsNowhere = 0.2, keepsLess = 0.5;
// The same where the load is an unknown, which is a ratio of what two systems give.
constexpr double loadedReduction = 0.02;
constexpr double smallRise = 1e-4;  // of the load, for differences
constexpr double roundOff = 1e-13;  // of what flows through a cell

}  // namespace

void checkTemperature(double temperature) {
  if (!(temperature > Thermo::minTemperature && temperature < Thermo::maxTemperature))
    throw NumericsError(fmt::format("an iteration towards the steady state leads to {:.6g} K", temperature));
}

void followGas(const FlowContext& context, State& state, int cell) {
  const auto c = static_cast<std::size_t>(cell), n = static_cast<std::size_t>(state.species);
  const std::size_t scalars = state.scalars.size();
  const std::span<const double> Y{&state.Y[c * n], n};
  const double before = state.density[c];
  checkTemperature(state.temperature[c]);
  state.density[c] = context.thermo.density(state.temperature[c], state.thermodynamicPressure, Y);
  state.enthalpy[c] = context.thermo.enthalpyMass(state.temperature[c], Y);
  for (std::size_t s = 0; s < scalars; ++s) state.carried[c * scalars + s] *= state.density[c] / before;
}

GasUpdate::GasUpdate(const FlowContext& context, const State& state, std::vector<Operator*> operators, Takes takes)
    : context_(context),
      operators_(std::move(operators)),
      takes_(takes),
      n_(static_cast<std::size_t>(state.species)),
      system_(context.mesh, context.halo, n_ + 1),
      made_(n_),
      enthalpies_(n_),
      capacities_(n_) {
  const auto owned = static_cast<std::size_t>(context.mesh.owned), width = n_ + 1;
  slopes_.resize(owned * width * width);
  right_.resize(owned * width);
  shares_.resize(owned);
  change_.resize(static_cast<std::size_t>(context.mesh.cells) * width);
}

// Of the species, and of the temperature,
//   rho cp DT/Dt = (enthalpy's) - sum over the species of h_k (theirs),
// divided by cp.
void GasUpdate::findLeft(const State& state, const FlowResidual& residual, std::size_t c, double* right) {
  const FlowResidual::Rates& rates = residual.rates();
  context_.thermo.speciesEnthalpies(state.temperature[c], enthalpies_);
  double heat = rates.enthalpy[c] - state.enthalpy[c] * rates.mass[c];
  for (std::size_t k = 0; k < n_; ++k) {
    right[k] = rates.species[c * n_ + k] - state.Y[c * n_ + k] * rates.mass[c];
    heat -= enthalpies_[k] * right[k];
  }
  right[n_] = heat / (residual.properties().heatCapacity[c] * kelvins);
}

bool GasUpdate::isAtRest(const State& state, const FlowResidual& residual, std::span<const double> through) {
  int rests = 1;
  for (std::size_t c = 0; c < through.size() && rests; ++c) {
    double* left = &right_[c * (n_ + 1)];
    findLeft(state, residual, c, left);
    for (std::size_t k = 0; k <= n_; ++k) rests = rests && std::abs(left[k]) <= roundOff * through[c];
  }
  MPI_Allreduce(MPI_IN_PLACE, &rests, 1, MPI_INT, MPI_MIN, context_.mesh.comm);
  std::ranges::fill(shares_, 1.0);
  return rests;
}

// What is left, and its derivatives by all that acts in the cell.
void GasUpdate::assembleBlock(const State& state, const FlowResidual& residual, int cell) {
  const auto c = static_cast<std::size_t>(cell);
  const std::size_t width = n_ + 1;
  const FlowResidual::Rates& rates = residual.rates();
  const double V = context_.mesh.volume[c], capacity = residual.properties().heatCapacity[c];
  findLeft(state, residual, c, &right_[c * width]);
  context_.thermo.speciesCp(state.temperature[c], capacities_);
  rates.made.ofSpecies(c, made_);
  double* block = system_.block(cell);
  double* slopes = &slopes_[c * width * width];
  for (std::size_t j = 0; j < width; ++j) {
    double* column = &slopes[j * width];
    double ofHeat = column[n_];
    for (std::size_t k = 0; k < n_; ++k) ofHeat -= enthalpies_[k] * column[k];
    if (j == n_)
      for (std::size_t k = 0; k < n_; ++k) ofHeat -= capacities_[k] * made_[k];
    const double unit = j == n_ ? kelvins : 1.0;
    for (std::size_t k = 0; k < n_; ++k) block[j * width + k] -= V * unit * column[k];
    block[j * width + n_] -= V * unit * ofHeat / (capacity * kelvins);
  }
}

void GasUpdate::assemble(const State& state, const FlowResidual& residual, std::span<const double> inertia) {
  const Mesh& m = context_.mesh;
  std::ranges::fill(slopes_, 0.0);
  for (Operator* op : operators_) op->addSlopes(state, {slopes_, {}});
  system_.clear();
  for (int c = 0; c < m.owned; ++c) {
    assembleBlock(state, residual, c);
    system_.addInertia(c, inertia[c]);
  }
  std::vector<int> all(n_);
  std::iota(all.begin(), all.end(), 0);
  std::vector<double> g(n_);
  const std::vector<double>& capacity = residual.properties().heatCapacity;
  for (int face = 0; face < m.faces; ++face) {
    residual.speciesDiffusion().conductance(face, all, g.data());
    const double flow = state.massFlux[face];
    for (std::size_t k = 0; k < n_; ++k) system_.connect(face, k, g[k], flow);
    const double w = m.high[face] >= 0 ? m.lowWeight[face] : 1.0;
    const double cp = w * capacity[m.low[face]] + (w < 1.0 ? (1.0 - w) * capacity[m.high[face]] : 0.0);
    system_.connect(face, n_, residual.heatConduction().conductance(face) / cp, flow);
  }
}

// Where gas ignites, what there is little of grows by itself. In a pseudo-time that is longer than that takes the
// linear system knows of another place without change, behind that of no gas at all. Whether it grows so tells the sign
// of its equation's diagonal once all else in the cell has answered to it, one over that of the inverse: what falls
// only because others do is no such thing, and traces of it would hold back cells for nothing.
bool GasUpdate::isMisled(const State& state, std::size_t c, double share) {
  const double *Y = &state.Y[c * n_], *change = &change_[c * (n_ + 1)], *left = &right_[c * (n_ + 1)];
  for (std::size_t k = 0; k < n_; ++k)
    if (left[k] > 0.0 && change[k] < 0.0 && Y[k] + share * change[k] < 2.0 * leastOfSpecies &&
        !(system_.inverseDiagonal(static_cast<int>(c), k) > 0.0))
      return true;
  return false;
}

double GasUpdate::shareOf(std::span<const double> Y, std::span<const double> change) const {
  double most = 0.0;
  for (std::size_t k = 0; k < n_; ++k) most = std::max(most, std::abs(change[k]));
  const double rise = kelvins * std::abs(change[n_]);
  double share = 1.0;
  if (rise > mostRise) share = mostRise / rise;
  if (share * most > mostOfFraction) share = mostOfFraction / most;
  for (std::size_t k = 0; k < n_ && takes_ == Takes::NineTenths; ++k)
    if (Y[k] > traceOfSpecies && -share * change[k] > mostTaken * Y[k]) share = -mostTaken * Y[k] / change[k];
  return share;
}

double GasUpdate::take(State& state, int cell, double& largestRise) {
  const auto c = static_cast<std::size_t>(cell);
  const double* change = &change_[c * (n_ + 1)];
  double* Y = &state.Y[c * n_];
  const double rise = kelvins * change[n_];
  largestRise = std::max(largestRise, std::abs(rise));
  const double share = shareOf({Y, n_}, {change, n_ + 1});
  const std::size_t width = n_ + 1;
  const double V = context_.mesh.volume[c];
  const double *slopes = &slopes_[c * width * width], *block = system_.block(cell);
  if (isMisled(state, c, share)) return 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < n_; ++k) {
    const double reacts = -V * slopes[k * (width + 1)], moves = block[k * (width + 1)] - reacts;
    const bool isFast = reacts > moves;
    const bool isMovedTrace = !isFast && Y[k] > 0.0 && Y[k] < traceOfSpecies;
    const double least = isFast ? leastOfSpecies : isMovedTrace ? leastOfTrace * Y[k] : std::min(Y[k], leastOfSpecies);
    Y[k] = std::max(std::max(Y[k], isFast ? leastOfSpecies : Y[k]) + share * change[k], least);
    sum += Y[k];
  }
  for (std::size_t k = 0; k < n_; ++k) Y[k] /= sum;
  state.temperature[c] += share * rise;
  return share;
}

// By the difference of what is left where the load is a little larger.
void GasUpdate::assembleLoad(const State& state, const LoadAsUnknown& load) {
  const std::size_t width = n_ + 1;
  const double present = load.control.load(), rise = smallRise * present;
  State other = state;
  load.control.scale(other, present + rise);
  other.updateHalo(context_.halo);
  load.beside.evaluate(other);
  for (std::size_t c = 0; c < static_cast<std::size_t>(context_.mesh.owned); ++c) {
    findLeft(other, load.beside, c, &rightOfLoad_[c * width]);
    for (std::size_t i = c * width; i < (c + 1) * width; ++i) rightOfLoad_[i] = (rightOfLoad_[i] - right_[i]) / rise;
  }
  load.control.setLoad(other, present);
}

double GasUpdate::addLoad(const State& state, const LoadAsUnknown& load) {
  rightOfLoad_.resize(right_.size());
  changeByLoad_.resize(change_.size());
  assembleLoad(state, load);
  system_.solve(rightOfLoad_, changeByLoad_, loadedReduction, mostGasIterations);
  const LoadControl& control = load.control;
  const auto rise = [&](const std::vector<double>& change) {
    return control.weighed([&](std::size_t cell) { return kelvins * change[cell * (n_ + 1) + n_]; });
  };
  const double change = control.change(control.left(state) - rise(change_), rise(changeByLoad_));
  for (std::size_t i = 0; i < change_.size(); ++i) change_[i] += change * changeByLoad_[i];
  return change;
}

void GasUpdate::saveOrLoad(StateArchive& archive) {
  double share = system_.keptFill();
  archive.shared("steady_kept_fill", share);
  system_.setKeptFill(share);
}

GasUpdate::Result GasUpdate::advance(State& state, const FlowResidual& residual, std::span<const double> inertia,
                                     const std::optional<LoadAsUnknown>& load) {
  prepare(state, residual, inertia);
  const BlockSystem::Result solved = solve(right_, change_, load ? loadedReduction : gasReduction, mostGasIterations);
  const bool isSolved = solved.reached <= leadsNowhere;
  if (solved.reached > leadsNowhere) system_.setKeptFill(keepsLess * system_.keptFill());
  const double loadChange = load ? addLoad(state, *load) : 0.0;
  Result result = take(state, change_);
  result.iterations = solved.iterations;
  result.isSolved = isSolved;
  result.loadChange = loadChange;
  return result;
}

void GasUpdate::prepare(const State& state, const FlowResidual& residual, std::span<const double> inertia) {
  assemble(state, residual, inertia);
  system_.factorise();
}

GasUpdate::Result GasUpdate::take(State& state, std::span<const double> change) {
  const Mesh& m = context_.mesh;
  if (change.data() != change_.data()) std::ranges::copy(change, change_.begin());
  Result result;
  inEachCell(m, [&](int cell) {
    const auto c = static_cast<std::size_t>(cell);
    shares_[c] = take(state, cell, result.largestRise);
    if (shares_[c] < 1.0) ++result.limited;
    followGas(context_, state, cell);
  });
  MPI_Allreduce(MPI_IN_PLACE, &result.largestRise, 1, MPI_DOUBLE, MPI_MAX, m.comm);
  MPI_Allreduce(MPI_IN_PLACE, &result.limited, 1, MPI_INT64_T, MPI_SUM, m.comm);
  state.updateHalo(context_.halo);
  return result;
}

}  // namespace lampblack::flow
