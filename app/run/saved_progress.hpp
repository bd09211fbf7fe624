// Checkpoints of runs whose whole state is one archive: when one is due, and the file of the last one.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "app/run/recorded_run.hpp"
#include "core/modules.hpp"
#include "core/state_archive.hpp"
#include "io/checkpoint_file.hpp"
#include "io/checkpoint_folder.hpp"

namespace lampblack::app {

using ArchiveOwners = std::function<void(StateArchive&)>;

class SavedProgress {
 public:
  // `wallTime`: s, between two. From here on SIGUSR1 asks for a checkpoint.
  SavedProgress(MPI_Comm comm, const std::filesystem::path& runFolder, Fingerprint fingerprint, double wallTime);
  // Of this rank alone: whether one is asked for, or due by the time; 1 or 0, for agreedStopRequest().
  [[nodiscard]] int isDue();
  // Collective. Writes a checkpoint and removes the former one. Returns its name.
  std::filesystem::path save(std::int64_t number, const ArchiveOwners& owners);

 private:
  MPI_Comm comm_;
  int rank_ = 0;
  CheckpointFolder folder_;
  Fingerprint fingerprint_;
  double wallTime_, since_;
};

// Collective. The checkpoint that a run is to go on from, if any: that of the options, or the newest of the folder.
[[nodiscard]] std::optional<WholeCheckpoint> chosenCheckpoint(MPI_Comm comm, const RunOptions& options);
// Collective. InputError where it is of another run.
void loadProgress(MPI_Comm comm, const WholeCheckpoint& checkpoint, const Fingerprint& fingerprint,
                  const ArchiveOwners& owners);
// Notes it in the record, and warns of newer ones that are damaged.
void recordRestart(const WholeCheckpoint& checkpoint, RunRecord& record);

}  // namespace lampblack::app
