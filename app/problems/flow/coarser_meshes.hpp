// A steady state sought on coarser meshes first, each the start of the next finer one (nested iteration).
#pragma once

#include <mpi.h>

#include "app/problems/flow/flow_case.hpp"
#include "core/modules.hpp"
#include "io/results_writer.hpp"
#include "io/run_folder.hpp"

namespace lampblack::app {

// The deck's case with the steady state on meshes of 1/2, 1/4, ... of the cells in each direction (`meshes` of them) as
// its start; their runs are folders of `folder`, coarser_1 the finest. What a search leaves that is given up is a start
// too, but cold gas is none where the mechanism has reactions. From a steady state 50 steps in time follow at most,
// however many the deck asks for. Collective; NumericsError where a run fails for another
// reason.
FlowCase caseFromCoarserMeshes(MPI_Comm comm, const Deck& deck, int meshes, const RunFolder& folder,
                               const RunInfo& info);

}  // namespace lampblack::app
