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

using Search = TimeControl::Search;

// Of what came of the search on coarser meshes: the finest that is a start.
void limitSteps(Search& search, const std::vector<Search::Coarser>& coarser) {
  const auto start = std::find_if(coarser.rbegin(), coarser.rend(), [](const auto& mesh) { return mesh.isStart; });
  // 0: as many as they take
  if (start != coarser.rend() && start->isSteady) search.steps = std::min(search.steps, mostStepsFromSteady);
}

// The case of a deck that starts from results on a coarser mesh; none: the start is the deck's own.
FlowCase caseFrom(const Deck& deck, const std::filesystem::path& results, const std::vector<Search::Coarser>& coarser) {
  FlowCase flowCase = readFlowCase(deck);
  if (results.empty()) return flowCase;
  flowCase.initialFields = flowcase::readEarlierFlow(results, {}, flowCase, flowcase::EarlierDeck::ThisOne);
  limitSteps(*flowCase.time.search, coarser);
  return flowCase;
}

}  // namespace

FlowCase caseFromCoarserMeshes(MPI_Comm comm, const Deck& deck, int meshes, const RunFolder& folder,
                               const RunInfo& info) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::filesystem::path earlier;
  std::vector<Search::Coarser> told;
  FlowCase flowCase;
  for (int level = meshes; level >= 1; --level) {
    const auto read = [&] {
      const std::string refinement =
          fmt::format("mesh.refinement={}", deck.number("mesh.refinement") * std::ldexp(1.0, -level));
      flowCase = caseFrom(Deck::parse(deck.resolved(), deck.path(), {refinement, "output.species=[all]"}, flowSchema()),
                          earlier, told);
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
      earlier = found;
    else
      printWarnings({"nothing burns on the coarser mesh; the next one does not start from it"});
  }
  collectively(comm, [&] { flowCase = caseFrom(deck, earlier, told); });
  flowCase.time.search->coarser = told;
  return flowCase;
}

void saveOrLoadCoarserMeshes(TimeControl::Search& search, StateArchive& archive) {
  constexpr std::size_t width = 6;
  std::vector<double> numbers;
  for (const Search::Coarser& mesh : search.coarser)
    numbers.insert(numbers.end(),
                   {static_cast<double>(mesh.cells), mesh.isSteady ? 1.0 : 0.0, mesh.isStart ? 1.0 : 0.0,
                    static_cast<double>(mesh.steps), static_cast<double>(mesh.iterations), mesh.processorTime});
  archive.shared("coarser_meshes", numbers);
  if (!archive.loading()) return;
  search.coarser.clear();
  for (std::size_t i = 0; i + width <= numbers.size(); i += width)
    search.coarser.push_back({static_cast<std::int64_t>(numbers[i]), numbers[i + 1] != 0.0, numbers[i + 2] != 0.0,
                              static_cast<int>(numbers[i + 3]), static_cast<int>(numbers[i + 4]), numbers[i + 5]});
  limitSteps(search, search.coarser);
}

}  // namespace lampblack::app
