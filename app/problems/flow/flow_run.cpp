#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

#include "app/problems/flow/coarser_meshes.hpp"
#include "app/problems/flow/flow_case.hpp"
#include "app/problems/flow/flow_loop.hpp"
#include "app/run/prepared_run.hpp"
#include "app/run/recorded_run.hpp"
#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "core/stop_request.hpp"

namespace lampblack::app {
namespace {

class PreparedFlow : public PreparedRun {
 public:
  PreparedFlow(MPI_Comm comm, const Deck& deck) : comm_(comm), deck_(deck), start_(MPI_Wtime()) {
    int ranks = 1;
    MPI_Comm_size(comm, &ranks);
    FlowCase flowCase;
    collectively(comm, [&] {
      flowCase = readFlowCase(deck);
      if (flowCase.output.storage.writers > ranks)
        throw deck.error("output.writers", fmt::format("expected {} at most, the number of ranks, found {}", ranks,
                                                       flowCase.output.storage.writers));
      if (flowCase.meshFile) return;
      std::size_t cells = 1;
      for (int axis = 0; axis < flowCase.dimension; ++axis)
        cells *= flowCase.mesh.vertices[static_cast<std::size_t>(axis)].size() - 1;
      if (cells < static_cast<std::size_t>(ranks))
        throw deck.error("mesh", fmt::format("{} cells cannot be spread over {} ranks", cells, ranks));
    });
    seed_ = flowCase.seed;
    coarserMeshes_ = flowCase.time.search ? flowCase.time.search->coarserMeshes : 0;
    species_ = flowCase.mechanism->numSpecies();
    reactions_ = flowCase.mechanism->numReactions();
    run_ = std::make_unique<FlowLoop>(comm, std::move(flowCase));
    notes_ = run_->notes();
    for (const std::string& warning : run_->quality().warnings()) notes_.push_back(warning);
  }

  [[nodiscard]] std::string summary() const override {
    return fmt::format("{} cells, {} species, {} reactions", run_->cells(), species_, reactions_);
  }

  [[nodiscard]] std::vector<std::string> details() const override {
    std::vector<std::string> lines = run_->quality().lines();
    for (const std::string& note : notes_) lines.push_back("note: " + note);
    return lines;
  }

  void run(const RunOptions& options) override {
    int rank = 0;
    MPI_Comm_rank(comm_, &rank);
    std::optional<WholeCheckpoint> restart;
    if (options.restart) {
      restart =
          options.restart->empty() ? newestCheckpoint(comm_, options.folder) : wholeCheckpoint(comm_, *options.restart);
      run_->load(*restart);
    }
    recordedRun(comm_, deck_, options, seed_, [&](const RunFolder& folder, const RunInfo& info, RunRecord& record) {
      if (rank == 0)
        for (const std::string& note : notes_) fmt::print("note: {}\n", note);
      if (restart) {
        record.restartedFrom = restart->file.string();
        printWarnings(restart->damaged);
        if (rank == 0) fmt::print("continues from {}\n", restart->file.string());
      }
      try {
        if (!restart && coarserMeshes_ > 0)
          run_ = std::make_unique<FlowLoop>(comm_, caseFromCoarserMeshes(comm_, deck_, coarserMeshes_, folder, info));
        run_->warnOfStart();
        run_->run(folder, info);
      } catch (const Stopped&) {
        run_->count(record);
        run_->measure(record);
        throw;
      } catch (...) {
        run_->count(record);  // how far it came
        throw;
      }
      run_->report(MPI_Wtime() - start_, record);
    });
  }

 private:
  MPI_Comm comm_;
  const Deck& deck_;
  double start_;
  std::uint64_t seed_ = 0;
  int coarserMeshes_ = 0;
  std::vector<std::string> notes_;
  std::size_t species_ = 0, reactions_ = 0;
  std::unique_ptr<FlowLoop> run_;
};

}  // namespace

std::unique_ptr<PreparedRun> prepareFlow(MPI_Comm comm, const Deck& deck) {
  return std::make_unique<PreparedFlow>(comm, deck);
}

}  // namespace lampblack::app
