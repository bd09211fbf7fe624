// Steps in which cells take the reactions of others (ReferenceMap).
#include <algorithm>
#include <cmath>
#include <map>

#include "core/errors.hpp"
#include "flow/models/reaction_operator.hpp"

namespace lampblack::flow {

// What of the owned cells `state` has before its reactions, and has to be advanced: the references, the others' own by
// themselves where they are checked, and then again those for which the reference does not do.
void ReactionOperator::advanceMapped(State& state, double time, double dt, std::span<const int> cells) {
  const auto n = static_cast<std::size_t>(state.species);
  const auto placeOf = [&](std::size_t i) { return static_cast<std::size_t>(cells[i]); };
  std::vector<ReferenceCells::Cell> kinds;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t cell = placeOf(i);
    kinds.push_back({context_.mesh.naturalCell[cell],
                     options_.map->binOf(state.temperature[cell], state.density[cell], {&state.Y[cell * n], n})});
  }
  const ReferenceCells references(context_.mesh.comm, kinds);
  struct Own {  // of a checked cell
    double temperature = 0.0;
    std::vector<double> Y;
  };
  std::map<int, Own> own;
  std::vector<int> integrated;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool isChecked = !references.isReference(i) && options_.map->isChecked(kinds[i].number, time);
    if (isChecked) own[cells[i]];
    if (isChecked || references.isReference(i)) integrated.push_back(cells[i]);
  }
  advanceCells(state, time, dt, integrated,
               [&](int cell, const CellReactor::Result& result, std::span<const double> Y) {
                 if (const auto found = own.find(cell); found != own.end())
                   found->second = {result.temperature, {Y.begin(), Y.end()}};
                 else
                   take(state, static_cast<std::size_t>(cell), dt, result, Y);
               });

  // Rates per mass, and where all of it reacts; then the first step of the next.
  const auto give = [&](std::size_t i, std::span<double> row) {
    const std::size_t cell = placeOf(i);
    const double share = mixingOf(cell).reactingShare;
    const double perMass = share > 0.0 ? 1.0 / (meanDensity(state, cell) * share) : 0.0;
    for (std::size_t k = 0; k < n; ++k) row[k] = perMass * state.balance.reactions[cell * n + k];
    row[n] = initialStep_[cell];
  };
  MapTally tally;
  tally.cells = static_cast<double>(cells.size());
  std::vector<int> refused;
  std::vector<double> reacted(n), enthalpies(n);
  references.spread(n + 1, give, [&](std::size_t i, std::span<const double> row) {
    const std::size_t cell = placeOf(i);
    const auto result = takeFromOther(state, cell, dt, row, reacted);
    if (!result) return refused.push_back(cells[i]);
    ++tally.mapped;
    if (const auto found = own.find(cells[i]); found != own.end()) {
      ++tally.checked;
      const Own& exact = found->second;
      context_.thermo.speciesEnthalpies(exact.temperature, enthalpies);
      double heat = 0.0, error = 0.0;
      for (std::size_t k = 0; k < n; ++k) {
        const double difference = reacted[k] - exact.Y[k];
        tally.fractionError = std::max(tally.fractionError, std::abs(difference));
        error += enthalpies[k] * difference;
        heat += enthalpies[k] * (dt * state.balance.reactions[cell * n + k] / meanDensity(state, cell) - difference);
      }
      tally.heat += std::abs(heat);
      tally.heatError += std::abs(error);
      tally.temperatureError = std::max(tally.temperatureError, std::abs(result->temperature - exact.temperature));
    }
  });
  tally.refused = static_cast<double>(refused.size());
  diagnostics_.map.add(tally);
  int areRefused = !refused.empty();
  MPI_Allreduce(MPI_IN_PLACE, &areRefused, 1, MPI_INT, MPI_MAX, context_.mesh.comm);
  if (areRefused)
    advanceCells(state, time, dt, refused, [&](int cell, const CellReactor::Result& result, std::span<const double> Y) {
      take(state, static_cast<std::size_t>(cell), dt, result, Y);
    });
}

// A cell reacts over a step, to `reacted`, at the rates (1/s, of the mass fractions where all of it reacts) of a row
// from its reference; nothing where mass fractions would be below zero.
std::optional<CellReactor::Result> ReactionOperator::takeFromOther(State& state, std::size_t cell, double dt,
                                                                   std::span<const double> row,
                                                                   std::span<double> reacted) {
  const double density = densityOfRate(state, cell), share = mixingOf(cell).reactingShare;
  const std::size_t n = reacted.size();
  for (std::size_t k = 0; k < n; ++k) {
    const double before = state.balance.reactions[cell * n + k] / density;
    reacted[k] = state.Y[cell * n + k] + dt * (share * row[k] - before);
    if (reacted[k] < options_.reactor.leastFraction()) return {};
  }
  CellReactor::Result result;
  result.firstStep = row[n];
  try {
    result.temperature =
        context_.thermo.temperatureFromEnthalpy(state.enthalpy[cell], reacted, state.temperature[cell]);
  } catch (const NumericsError&) {
    return {};
  }
  take(state, cell, dt, result, reacted);
  return result;
}

}  // namespace lampblack::flow
