#include "app/flow/coarser_meshes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "app/flow/flow_loop.hpp"
#include "app/flow/initial_flow.hpp"
#include "app/run/warnings.hpp"
#include "core/errors.hpp"

namespace lampblack::app {

namespace {

// The case of a deck that starts from what an earlier run left; nothing: from the deck's own start.
FlowCase caseFrom(const Deck& deck, const std::filesystem::path& earlier) {
  FlowCase flowCase = readFlowCase(deck);
  if (!earlier.empty()) flowCase.initialFields = flowcase::readEarlierFlow(earlier, {}, flowCase);
  return flowCase;
}

}  // namespace

FlowCase caseFromCoarserMeshes(MPI_Comm comm, const Deck& deck, const RunFolder& folder, const RunInfo& info) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::filesystem::path earlier;
  FlowCase flowCase;
  for (int level = deck.integer<int>("time.steady.coarser_meshes"); level >= 1; --level) {
    collectively(comm, [&] {
      const std::string refinement =
          fmt::format("mesh.refinement={}", deck.number("mesh.refinement") * std::ldexp(1.0, -level));
      flowCase = caseFrom(Deck::parse(deck.resolved(), deck.path(), {refinement, "output.species=[all]"}, flowSchema()),
                          earlier);
      flowCase.trajectories.reset();
      flowCase.time.search->stability.reset();
      flowCase.time.search->branch.reset();
      flowCase.time.search->rounds.reset();
      flowCase.output.tables = {};
    });
    const RunFolder own = RunFolder::prepare(folder.path() / fmt::format("coarser_{}", level), true, comm);
    FlowLoop loop(comm, flowCase);
    if (rank == 0) fmt::print("a coarser mesh first, of {} cells\n", loop.cells());
    earlier = own.results();
    try {
      loop.run(own, info);
      loop.tellSearch();
    } catch (const NumericsError& error) {
      earlier = own.partialResults();
      if (!std::filesystem::exists(earlier)) throw;
      printWarnings({fmt::format("the coarser mesh: {}; its last state is the start of the finer one", error.what())});
    }
  }
  collectively(comm, [&] { flowCase = caseFrom(deck, earlier); });
  return flowCase;
}

}  // namespace lampblack::app
