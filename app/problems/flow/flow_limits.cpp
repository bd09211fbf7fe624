#include "app/problems/flow/flow_limits.hpp"

#include <fmt/format.h>
#include <petscsystypes.h>

#include <limits>

#include "io/request_limits.hpp"

namespace lampblack::app {
namespace {

constexpr double number = sizeof(double);  // bytes

void refuseTrajectories(const Deck& deck, const TrajectoryRequest& request) {
  const double paths = static_cast<double>(request.starts.size());
  const double steps = request.duration / request.timeStep;
  // A sample of the gas and a record with its distribution, kept for every step until all are written.
  const double bytes = number * static_cast<double>(30 + request.bins.count);
  requireMemory(deck, "trajectories.time_step",
                fmt::format("{:.3g} time steps along each path, with {} bins,", steps, request.bins.count),
                paths * steps * bytes);
  requireOutputs(deck, "trajectories.time_step", "rows of trajectories", paths * steps, bytes);
}

}  // namespace

void requireCells(const Deck& deck, double cells, std::size_t species) {
  const std::string key = deck.number("mesh.refinement") > 1 ? "mesh.refinement" : "mesh";
  // The state, its halo and faces, and per species: mass fraction, rate, diffusivity, two fluxes, the solver's vectors,
  // and the smallest and largest value in the present piece of time (Steadiness).
  requireMemory(deck, key, fmt::format("a mesh of {:.9g} cells with {} species", cells, species),
                cells * number * (66 + 8 * static_cast<double>(species)));
  // PETSc numbers cells, faces and vertices together, about four a cell.
  constexpr PetscInt most = std::numeric_limits<PetscInt>::max() / 4;
  if (cells > static_cast<double>(most))
    throw deck.error(key, fmt::format("{:.9g} cells are too many; at most {} can be numbered", cells, most));
}

void refuseExcess(const Deck& deck, const FlowCase& flowCase, double cells) {
  const OutputControl& output = flowCase.output;
  if (flowCase.time.search) return;  // the first state and the last, and no end of time that tells of rows
  const double outputs = flowCase.time.end / output.interval;
  requireOutputs(deck, "output.interval", "outputs of the fields", outputs,
                 cells * number * (6 + static_cast<double>(output.species.size())));
  const double steps = flowCase.time.end / flowCase.time.maximumStep;
  const double columns = 22 + 4 * static_cast<double>(flowCase.mechanism->numElements());
  requireOutputs(deck, deck.isGiven("output.interval") ? "output.interval" : "output.history_steps",
                 "rows of the history", outputs + steps / output.historySteps, columns * number);
  if (flowCase.trajectories) refuseTrajectories(deck, *flowCase.trajectories);
}

}  // namespace lampblack::app
