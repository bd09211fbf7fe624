// Cells whose reactions outrun a step: their rates, as transport takes them, are those that the cells and their
// neighbours find together (CoupledCells).
#include <algorithm>
#include <numeric>

#include "core/errors.hpp"
#include "flow/stepping/transport_operator.hpp"

namespace lampblack::flow {
namespace {

// How many cells around one that outruns the step take its rates and theirs from the coupled cells, and how many answer
// to them.
constexpr double ringTaken = 1.0, ringCoupled = 2.0;
constexpr double notCoupled = 100.0;

}  // namespace

// Whether the rates of a cell are those of the coupled cells.
bool TransportOperator::takesCoupled(int cell) const {
  return coupledRing_[static_cast<std::size_t>(cell)] <= ringTaken;
}

void TransportOperator::markCoupled() {
  const Mesh& m = context_.mesh;
  coupledRing_.assign(static_cast<std::size_t>(m.cells), notCoupled);
  for (int c = 0; c < m.owned; ++c)
    if (reactions_->outruns(static_cast<std::size_t>(c))) coupledRing_[c] = 0.0;
  for (double ring = 1.0; ring <= ringCoupled; ++ring) {
    context_.halo.update(coupledRing_, 1);
    for (int face = 0; face < m.faces; ++face) {
      const int low = m.low[face], high = m.high[face];
      if (high < 0) continue;
      double &ofLow = coupledRing_[low], &ofHigh = coupledRing_[high];
      if (ofLow == ring - 1.0 && low != high) ofHigh = std::min(ofHigh, ring);
      if (ofHigh == ring - 1.0) ofLow = std::min(ofLow, ring);
    }
  }
  context_.halo.update(coupledRing_, 1);
}

// What everything but the reactions brings to a cell in the mean state, per second.
void TransportOperator::addTendency(const State& mean, const State& state, int cell, std::span<const double> conducted,
                                    CoupledCells::Cell& to) {
  const Mesh& m = context_.mesh;
  const auto n = static_cast<std::size_t>(state.species);
  const double* reactions = &state.balance.reactions[static_cast<std::size_t>(cell) * n];
  to.brought.resize(n);
  state.balance.ofSpecies(static_cast<std::size_t>(cell), to.brought);
  for (std::size_t k = 0; k < n; ++k) to.brought[k] = m.volume[cell] * (to.brought[k] - reactions[k]);
  to.heat = m.volume[cell] * state.balance.enthalpy[cell];
  for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i) {
    const int face = m.faceOfCell[i];
    if (m.low[face] == m.high[face]) continue;
    const double sign = m.low[face] == cell ? -1.0 : 1.0, flux = state.massFlux[face];
    to.heat += sign * (fluxes_.through(mean, face, flux, row_) + conducted[face]);
    for (std::size_t k = 0; k < n; ++k) to.brought[k] += sign * row_[k];
  }
}

void TransportOperator::coupleReactions(const State& mean, State& state, double time, double dt) {
  if (!reactions_) return;
  const bool isFirst = sweep_ == 1;
  if (isFirst) couples_ = reactions_->findOutrunning(state, dt);
  if (!couples_) return;
  const Mesh& m = context_.mesh;
  const auto n = static_cast<std::size_t>(state.species);
  if (isFirst) markCoupled();
  const std::vector<double>& temperature = start_ ? start_->temperature : state.temperature;
  std::vector<double> conducted(static_cast<std::size_t>(m.faces));
  heatConduction_.presentFlux(mean, conducted);
  CoupledCells cells(n);
  for (int c = 0; c < m.owned; ++c) {
    if (coupledRing_[c] > ringCoupled) continue;
    const auto rowOf = [&](const std::vector<double>& all) {
      const auto first = all.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(c) * n);
      return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(n));
    };
    CoupledCells::Cell cell;
    cell.number = m.naturalCell[c];
    cell.mass = mean.density[c] * m.volume[c];
    cell.pressure = mean.thermodynamicPressure;
    cell.temperature = temperature[c];
    cell.enthalpy = state.start.enthalpy[c];
    cell.referenceTemperature = mean.temperature[c];
    cell.referenceEnthalpy = 0.5 * (state.start.enthalpy[c] + state.enthalpy[c]);
    cell.mixing = reactions_->mixingOf(static_cast<std::size_t>(c));
    cell.Y = rowOf(state.start.Y);
    cell.reference = rowOf(mean.Y);
    cell.reacts = rowOf(state.balance.reactions);
    for (double& rate : cell.reacts) rate *= m.volume[c];
    addTendency(mean, state, c, conducted, cell);
    cells.add(std::move(cell));
  }
  std::vector<int> species(n);
  std::iota(species.begin(), species.end(), 0);
  for (int face = 0; face < m.faces; ++face) {
    const int low = m.low[face], high = m.high[face];
    const auto isIn = [&](int c) { return c >= 0 && coupledRing_[c] <= ringCoupled; };
    if (low == high || (!isIn(low) && !isIn(high))) continue;
    // Of the two, the one that is in, and whose rank knows the face.
    const bool isTurned = !isIn(low);
    if ((isTurned ? high : low) >= m.owned) continue;
    CoupledCells::Link link;
    link.face = m.faceNumber[face];
    link.low = m.naturalCell[isTurned ? high : low];
    if (isIn(low) && isIn(high)) link.high = m.naturalCell[high];
    link.flow = isTurned ? -state.massFlux[face] : state.massFlux[face];
    link.conducts = heatConduction_.conductance(face);
    link.diffuses.resize(n);
    speciesDiffusion_.conductance(face, species, link.diffuses.data());
    cells.add(std::move(link));
  }
  cells.gather(m.comm);
  const auto react = [&](std::span<CoupledCells::Reacting> own, double part) { reactions_->react(own, time, part); };
  collectively(m.comm, [&] { cells.advance(m.comm, react, context_.thermo, dt, reactions_->parts()); });
  for (int c = 0; c < m.owned; ++c) {
    if (!takesCoupled(c)) continue;
    const std::span<const double> made = cells.made(m.naturalCell[c]);
    double* rate = &state.balance.reactions[static_cast<std::size_t>(c) * n];
    for (std::size_t k = 0; k < n; ++k) {
      row_[k] = made[k] / m.volume[c] - rate[k];
      rate[k] += row_[k];
    }
    expansion_.changeReactions(state, properties_, c, row_, isFirst);
    reactions_->take(static_cast<std::size_t>(c));
  }
}

}  // namespace lampblack::flow
