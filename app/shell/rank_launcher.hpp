// Runs on several ranks without a script: this program starts itself again under mpirun.
#pragma once

#include <mpi.h>

#include <span>

#include "core/modules.hpp"

namespace lampblack::app {

// Processors that this process may use.
int processors();

// Whether this process has to become several: it was asked for more than one rank and is no rank of a launcher itself.
bool needsLauncher(int ranks);

// Runs mpirun with that many ranks of this very command line, passes signals on to the ranks (mpirun would end them
// before they have kept what they have), and returns the exit code. mpirun is LAMPBLACK_MPIRUN where that is set, else
// the one of PATH, else that of the build. InputError where there is none.
int runOnRanks(int ranks, std::span<char* const> commandLine);

// InputError where the ranks that a launcher started are not as many as --ranks says; a launcher of another MPI starts
// ranks that do not know of each other. `ranks` of zero: --ranks was not given.
void checkRanks(MPI_Comm comm, int ranks);

}  // namespace lampblack::app
