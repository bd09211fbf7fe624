#include "app/problems/flow/coarser_meshes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "app/problems/flow/flow_loop.hpp"
#include "app/problems/flow/initial_flow.hpp"
#include "app/run/warnings.hpp"
#include "core/errors.hpp"

namespace lampblack::app {

namespace {

// Steps in time that a start from a steady state needs at most: it has but to follow the finer cells.
constexpr int mostStepsFromSteady = 50;

// What a run on a coarser mesh left; no results: the start is the deck's own.
struct Earlier {
  std::filesystem::path results;
  bool isSteady = false;
};

// The case of a deck that starts from there.
FlowCase caseFrom(const Deck& deck, const Earlier& earlier) {
  FlowCase flowCase = readFlowCase(deck);
  if (earlier.results.empty()) return flowCase;
  flowCase.initialFields = flowcase::readEarlierFlow(earlier.results, {}, flowCase);
  int& steps = flowCase.time.search->steps;  // 0: as many as they take
  if (earlier.isSteady) steps = std::min(steps, mostStepsFromSteady);
  return flowCase;
}

}  // namespace

FlowCase caseFromCoarserMeshes(MPI_Comm comm, const Deck& deck, int meshes, const RunFolder& folder,
                               const RunInfo& info) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  Earlier earlier;
  std::vector<TimeControl::Search::Coarser> told;
  FlowCase flowCase;
  for (int level = meshes; level >= 1; --level) {
    const auto read = [&] {
      const std::string refinement =
          fmt::format("mesh.refinement={}", deck.number("mesh.refinement") * std::ldexp(1.0, -level));
      flowCase = caseFrom(Deck::parse(deck.resolved(), deck.path(), {refinement, "output.species=[all]"}, flowSchema()),
                          earlier);
      flowCase.trajectories.reset();
      flowCase.time.search->stability.reset();
      flowCase.time.search->branch.reset();
      flowCase.time.search->rounds.reset();
      flowCase.output.tables = {};
    };
    try {
      collectively(comm, read);
    } catch (const InputError& error) {  // such as a burner narrower than a cell
      if (deck.has("time.steady.coarser_meshes")) throw;
      printWarnings({fmt::format("no coarser mesh of {} of the cells in each direction: {}", std::ldexp(1.0, -level),
                                 error.what())});
      continue;
    }
    const RunFolder own = RunFolder::prepare(folder.path() / RunFolder::coarser(level), true, comm);
    FlowLoop loop(comm, flowCase);
    if (rank == 0) fmt::print("a coarser mesh first, of {} cells\n", loop.cells());
    std::filesystem::path found = own.results();
    try {
      loop.run(own, info);
    } catch (const NumericsError& error) {
      found = own.partialResults();
      if (!std::filesystem::exists(found)) throw;
      printWarnings({fmt::format("the coarser mesh: {}", error.what())});
    }
    loop.tellSearch();
    told.push_back(loop.searchAsCoarser());
    // A flame that does not stand on a coarse mesh may stand on the next; gas that is cold would stay so.
    if (told.back().isStart)
      earlier = {found, told.back().isSteady};
    else
      printWarnings({"nothing burns on the coarser mesh; the next one does not start from it"});
  }
  collectively(comm, [&] { flowCase = caseFrom(deck, earlier); });
  flowCase.time.search->coarser = told;
  return flowCase;
}

}  // namespace lampblack::app
