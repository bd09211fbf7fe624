// Checkpoints of a run of molecules: the sums over those that have ended.
#pragma once

#include <mpi.h>

#include <cstdint>

#include "app/problems/pah/pah_case.hpp"
#include "app/run/saved_progress.hpp"
#include "core/modules.hpp"
#include "particles/pah/growth_sums.hpp"

namespace lampblack::app {

// Molecules 0 to `done` of a run, whose sums are those of all ranks together.
struct PahProgress {
  std::uint64_t done = 0;
  GrowthSums sums;
};

// What decides what the sums of a checkpoint mean. How many repeats there are to be does not.
Fingerprint pahFingerprint(const PahCase& pah);

// What a checkpoint has of a progress, which has to live as long.
ArchiveOwners pahOwners(MPI_Comm comm, PahProgress& progress);
// Collective. InputError where it is of another run, or of more repeats than the case has.
PahProgress loadPahProgress(MPI_Comm comm, const WholeCheckpoint& checkpoint, const PahCase& pah);

}  // namespace lampblack::app
