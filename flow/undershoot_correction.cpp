#include "flow/undershoot_correction.hpp"

#include <algorithm>
#include <utility>

#include "flow/cell_errors.hpp"

namespace lampblack::flow {
namespace {

// Mass fraction up to which what is below the first is filled, and which stays as it is.
constexpr double lowest = -1.01e-5, allowed = -1e-5;
constexpr double givenAway = 0.5;  // of what a cell has
constexpr int mostRounds = 6;      // beyond which the rest stays

// Of a species in a cell, kg.
double massOf(const Mesh& m, const State& state, int cell, std::size_t species) {
  return state.Y[static_cast<std::size_t>(cell) * static_cast<std::size_t>(state.species) + species] *
         state.density[cell] * m.volume[cell];
}

double available(const Mesh& m, const State& state, int cell, std::size_t species) {
  return givenAway * std::max(massOf(m, state, cell, species), 0.0);
}

// Calls with each cell that shares a face with this one.
template <typename Visit>
void atNeighbours(const Mesh& m, int cell, const Visit& visit) {
  for (int i = m.faceStart[cell]; i < m.faceStart[cell + 1]; ++i) {
    const int face = m.faceOfCell[i], low = m.low[face], high = m.high[face];
    if (high >= 0 && low != high) visit(low == cell ? high : low);
  }
}

}  // namespace

// Collective.
void UndershootCorrection::findLacking(const State& state) {
  const auto n = static_cast<std::size_t>(state.species);
  std::vector<double> least(n, 0.0);
  for (int c = 0; c < context_.mesh.owned; ++c)
    for (std::size_t k = 0; k < n; ++k) least[k] = std::min(least[k], state.Y[static_cast<std::size_t>(c) * n + k]);
  MPI_Allreduce(MPI_IN_PLACE, least.data(), static_cast<int>(n), MPI_DOUBLE, MPI_MIN, context_.mesh.comm);
  lowest_ = *std::ranges::min_element(least);
  lacking_.clear();
  for (std::size_t k = 0; k < n; ++k)
    if (least[k] < lowest) lacking_.push_back(k);
}

void UndershootCorrection::correct(State& state) {
  const Mesh& m = context_.mesh;
  const auto n = static_cast<std::size_t>(state.species), count = lacking_.size();
  asked_.assign(static_cast<std::size_t>(m.cells) * count, 0.0);
  given_.assign(asked_.size(), 1.0);
  for (int c = 0; c < m.owned; ++c)
    for (std::size_t i = 0; i < count; ++i) {
      const double lacks = allowed * state.density[c] * m.volume[c] - massOf(m, state, c, lacking_[i]);
      if (!(lacks > 0.0)) continue;
      double offered = 0.0;
      atNeighbours(m, c, [&](int other) { offered += available(m, state, other, lacking_[i]); });
      if (offered > 0.0) asked_[static_cast<std::size_t>(c) * count + i] = std::min(lacks / offered, 1.0);
    }
  context_.halo.update(asked_, static_cast<int>(count));
  for (int c = 0; c < m.owned; ++c)
    for (std::size_t i = 0; i < count; ++i) {
      double asked = 0.0;
      atNeighbours(m, c, [&](int other) { asked += asked_[static_cast<std::size_t>(other) * count + i]; });
      if (asked > 1.0) given_[static_cast<std::size_t>(c) * count + i] = 1.0 / asked;
    }
  context_.halo.update(given_, static_cast<int>(count));

  // All of it from the state as it is, so that both sides of a face find the same.
  std::vector<int> changed;
  std::vector<double> contents, row(n), enthalpies(n);
  for (int c = 0; c < m.owned; ++c) {
    double heat = 0.0;
    bool changes = false;
    std::ranges::fill(row, 0.0);
    const auto receive = [&](int to, int from, double sign) {
      for (std::size_t i = 0; i < count; ++i) {
        const double share =
            asked_[static_cast<std::size_t>(to) * count + i] * given_[static_cast<std::size_t>(from) * count + i];
        if (share == 0.0) continue;
        const double amount = sign * share * available(m, state, from, lacking_[i]);
        if (amount == 0.0) continue;
        changes = true;
        context_.thermo.speciesEnthalpies(0.5 * (state.temperature[to] + state.temperature[from]), enthalpies);
        const double* Y = &state.Y[static_cast<std::size_t>(to) * n];
        double sum = 0.0;
        for (std::size_t k = 0; k < n; ++k) sum += std::max(Y[k], 0.0);
        row[lacking_[i]] += amount;
        heat += amount * enthalpies[lacking_[i]];
        for (std::size_t k = 0; k < n; ++k) {
          const double back = amount * std::max(Y[k], 0.0) / sum;
          row[k] -= back;
          heat -= back * enthalpies[k];
        }
      }
    };
    atNeighbours(m, c, [&](int other) {
      receive(c, other, 1.0);
      receive(other, c, -1.0);
    });
    if (!changes) continue;
    changed.push_back(c);
    contents.insert(contents.end(), row.begin(), row.end());
    contents.push_back(heat);
  }
  for (std::size_t i = 0; i < changed.size(); ++i) {
    const int c = changed[i];
    const double mass = state.density[c] * m.volume[c];
    const double* change = &contents[i * (n + 1)];
    for (std::size_t k = 0; k < n; ++k) state.Y[static_cast<std::size_t>(c) * n + k] += change[k] / mass;
    state.enthalpy[c] += change[n] / mass;
  }
  std::vector<char> isChanged(static_cast<std::size_t>(m.owned), 0);
  for (const int c : changed) isChanged[c] = 1;
  inEachCell(m, [&](int c) {
    if (isChanged[c] == 0) return;
    const std::span<const double> Y{&state.Y[static_cast<std::size_t>(c) * n], n};
    state.temperature[c] = context_.thermo.temperatureFromEnthalpy(state.enthalpy[c], Y, state.temperature[c]);
  });
  state.updateHalo(context_.halo);
}

void UndershootCorrection::advance(State& state, double, double) {
  if (++sweep_ < sweeps_) return;
  sweep_ = 0;
  findLacking(state);
  lowestSinceRow_ = std::min(lowestSinceRow_, lowest_);
  for (int round = 0; round < mostRounds && !lacking_.empty(); ++round) {
    correct(state);
    findLacking(state);
  }
}

void UndershootCorrection::saveOrLoad(StateArchive& archive) {
  std::vector<double> kept{lowestSinceRow_};
  archive.shared("undershoots", kept);
  lowestSinceRow_ = kept.at(0);
  if (archive.loading()) sweep_ = 0;  // of a step that was broken off
}

std::vector<Quantity> UndershootCorrection::historyColumns() const {
  return {{"undershoot", "1",
           "most negative mass fraction since the last row, before what is below -1e-5 was taken from cells around"}};
}

std::vector<double> UndershootCorrection::historyValues(const State&) {
  return {std::exchange(lowestSinceRow_, 0.0)};
}

}  // namespace lampblack::flow
