// A steady state sought on coarser meshes first, each the start of the next finer one (nested iteration).
#pragma once

#include <mpi.h>

#include "app/problems/flow/flow_case.hpp"
#include "core/modules.hpp"
#include "core/state_archive.hpp"
#include "io/results_writer.hpp"
#include "io/run_folder.hpp"

namespace lampblack::app {

// The deck's case with the steady state on meshes of 1/2, 1/4, ... of the cells in each direction (`meshes` of them) as
// its start; their runs are folders of `folder`, coarser_1 the finest. What a search leaves that is given up is a start
// too, but cold gas is none where the mechanism has reactions. From a steady state at most 50 of the steps in
// time that the deck asks for follow; where it gives no number of steps they are as many as they take from any start.
// Collective; NumericsError where a run fails for another reason.
FlowCase caseFromCoarserMeshes(MPI_Comm comm, const Deck& deck, int meshes, const RunFolder& folder,
                               const RunInfo& info);

// What came of the search on the coarser meshes, so that a run that goes on from a checkpoint tells it and takes no
// more steps in time than the run before.
void saveOrLoadCoarserMeshes(TimeControl::Search& search, StateArchive& archive);

}  // namespace lampblack::app
