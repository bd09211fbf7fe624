// Checkpoints of a run of molecules: the sums over those that have ended.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>

#include "app/problems/pah/pah_case.hpp"
#include "core/modules.hpp"
#include "io/checkpoint_file.hpp"
#include "io/checkpoint_folder.hpp"
#include "particles/pah/growth_sums.hpp"

namespace lampblack::app {

// Molecules 0 to `done` of a run, whose sums are those of all ranks together.
struct PahProgress {
  std::uint64_t done = 0;
  GrowthSums sums;
};

// What decides what the sums of a checkpoint mean. How many repeats there are to be does not.
Fingerprint pahFingerprint(const PahCase& pah);

// Collective. Writes a checkpoint and removes the former one. Returns its name.
std::filesystem::path savePahProgress(MPI_Comm comm, const CheckpointFolder& folder, const PahCase& pah,
                                      const PahProgress& progress);
// Collective. InputError where it is of another run, or of more repeats than the case has.
PahProgress loadPahProgress(MPI_Comm comm, const WholeCheckpoint& checkpoint, const PahCase& pah);

}  // namespace lampblack::app
