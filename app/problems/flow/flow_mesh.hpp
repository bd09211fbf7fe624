// The mesh of a flow, from what its deck says: a box, or a file.
#pragma once

#include <mpi.h>

#include <span>

#include "app/problems/flow/flow_case.hpp"
#include "core/modules.hpp"

namespace lampblack::app {

// Collective. The patches of the mesh are the boundaries of the case, in their order. Of a file its content is hashed,
// into `flowCase`, and what is passed over becomes notes of it; groups inside the gas whose boundary is a wall become
// walls of no thickness. InputError, on all ranks, at a key of the deck where the file is damaged, is not of the deck's
// geometry, has other names than the deck's boundaries, or more cells than there is room for, where it is read again
// and has changed, or where one of several parts that do not touch has no outlet. `weight`: of the cells whose
// permanent numbers are this rank's block (BlockExchange), or empty on all ranks.
Mesh makeMesh(MPI_Comm comm, FlowCase& flowCase, std::span<const double> weight = {});

}  // namespace lampblack::app
