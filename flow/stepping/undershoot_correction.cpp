#include "flow/stepping/undershoot_correction.hpp"

#include <fmt/format.h>

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

// What each cell asks for, of what the neighbours can give, and what each gives of that.
void UndershootCorrection::findShares(const State& state) {
  const Mesh& m = context_.mesh;
  const std::size_t count = lacking_.size();
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
}

// Adds to `row`, kg of each species and then J, what `to` gets from `from` and gives back of its mixture, times `sign`.
// Whether that is anything.
bool UndershootCorrection::addExchange(const State& state, int to, int from, double sign, std::span<double> row) {
  const auto n = static_cast<std::size_t>(state.species);
  const double* Y = &state.Y[static_cast<std::size_t>(to) * n];
  double sum = 0.0;  // of what there is in `to`; above zero once something is exchanged
  for (std::size_t i = 0; i < lacking_.size(); ++i) {
    const double share = asked_[static_cast<std::size_t>(to) * lacking_.size() + i] *
                         given_[static_cast<std::size_t>(from) * lacking_.size() + i];
    if (share == 0.0) continue;
    const double amount = sign * share * available(context_.mesh, state, from, lacking_[i]);
    if (amount == 0.0) continue;
    if (sum == 0.0) {
      for (std::size_t k = 0; k < n; ++k) sum += std::max(Y[k], 0.0);
      context_.thermo.speciesEnthalpies(0.5 * (state.temperature[to] + state.temperature[from]), enthalpies_);
    }
    row[lacking_[i]] += amount;
    row[n] += amount * enthalpies_[lacking_[i]];
    for (std::size_t k = 0; k < n; ++k) {
      const double back = amount * std::max(Y[k], 0.0) / sum;
      row[k] -= back;
      row[n] -= back * enthalpies_[k];
    }
  }
  return sum != 0.0;
}

void UndershootCorrection::correct(State& state) {
  const Mesh& m = context_.mesh;
  const auto n = static_cast<std::size_t>(state.species);
  findShares(state);
  // All of it from the state as it is, so that both sides of a face find the same.
  std::vector<int> changed;
  std::vector<double> changes, row(n + 1);
  enthalpies_.resize(n);
  for (int c = 0; c < m.owned; ++c) {
    bool isChanged = false;
    std::ranges::fill(row, 0.0);
    atNeighbours(m, c, [&](int other) {
      isChanged = addExchange(state, c, other, 1.0, row) || isChanged;
      isChanged = addExchange(state, other, c, -1.0, row) || isChanged;
    });
    if (!isChanged) continue;
    changed.push_back(c);
    changes.insert(changes.end(), row.begin(), row.end());
  }
  std::vector<char> isChanged(static_cast<std::size_t>(m.owned), 0);
  for (std::size_t i = 0; i < changed.size(); ++i) {
    const int c = changed[i];
    const double mass = state.density[c] * m.volume[c];
    const double* change = &changes[i * (n + 1)];
    for (std::size_t k = 0; k < n; ++k) state.Y[static_cast<std::size_t>(c) * n + k] += change[k] / mass;
    state.enthalpy[c] += change[n] / mass;
    isChanged[c] = 1;
  }
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
  if (lacking_.empty()) return;
  ++corrected_;
  lowestOfRun_ = std::min(lowestOfRun_, lowest_);
  for (int round = 0; round < mostRounds && !lacking_.empty(); ++round) {
    correct(state);
    findLacking(state);
  }
}

void UndershootCorrection::saveOrLoad(StateArchive& archive) {
  std::vector<double> kept{lowestSinceRow_, lowestOfRun_, corrected_};
  archive.shared("undershoots", kept);
  lowestSinceRow_ = kept.at(0);
  lowestOfRun_ = kept.at(1);
  corrected_ = kept.at(2);
  if (archive.loading()) sweep_ = 0;  // of a step that was broken off
}

std::vector<Quantity> UndershootCorrection::historyColumns() const {
  return {{"undershoot", "1",
           "most negative mass fraction since the last row, before what is below -1e-5 was taken from cells around"}};
}

std::vector<double> UndershootCorrection::historyValues(const State&) {
  return {std::exchange(lowestSinceRow_, 0.0)};
}

std::vector<std::string> UndershootCorrection::closingLines() const {
  if (corrected_ == 0.0) return {};
  return {
      fmt::format("mass fractions below {:g}, down to {:.2g}, that got back from the cells around what they lacked: in "
                  "{:.0f} steps",
                  allowed, lowestOfRun_, corrected_)};
}

}  // namespace lampblack::flow
