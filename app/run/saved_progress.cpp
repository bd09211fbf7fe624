#include "app/run/saved_progress.hpp"

#include <system_error>
#include <utility>

#include "app/run/warnings.hpp"
#include "core/errors.hpp"
#include "core/stop_request.hpp"

namespace lampblack::app {

SavedProgress::SavedProgress(MPI_Comm comm, const std::filesystem::path& runFolder, Fingerprint fingerprint,
                             double wallTime)
    : comm_(comm), folder_(runFolder), fingerprint_(std::move(fingerprint)), wallTime_(wallTime), since_(MPI_Wtime()) {
  MPI_Comm_rank(comm, &rank_);
  watchForCheckpointSignal();
}

int SavedProgress::isDue() {
  if (takeCheckpointSignal()) return 1;
  std::error_code ignored;
  return rank_ == 0 && (MPI_Wtime() - since_ > wallTime_ || std::filesystem::remove(folder_.request(), ignored)) ? 1
                                                                                                                 : 0;
}

std::filesystem::path SavedProgress::save(std::int64_t number, const ArchiveOwners& owners) {
  since_ = MPI_Wtime();
  collectively(comm_, [&] {
    if (rank_ == 0) folder_.make();
  });
  const std::filesystem::path file = folder_.checkpoint(number);
  CheckpointWriter writer(comm_, file, {}, fingerprint_);
  owners(writer);
  writer.texts("outputs", {});
  writer.finish();
  collectively(comm_, [&] {
    if (rank_ == 0) folder_.removeAllBut({file});
  });
  return file;
}

std::optional<WholeCheckpoint> chosenCheckpoint(MPI_Comm comm, const RunOptions& options) {
  if (!options.restart) return std::nullopt;
  return options.restart->empty() ? newestCheckpoint(comm, options.folder) : wholeCheckpoint(comm, *options.restart);
}

void loadProgress(MPI_Comm comm, const WholeCheckpoint& checkpoint, const Fingerprint& fingerprint,
                  const ArchiveOwners& owners) {
  CheckpointReader reader(comm, checkpoint.file, {}, fingerprint);
  owners(reader);
}

void recordRestart(const WholeCheckpoint& checkpoint, RunRecord& record) {
  record.restartedFrom = checkpoint.file.string();
  printWarnings(checkpoint.damaged);
}

}  // namespace lampblack::app
