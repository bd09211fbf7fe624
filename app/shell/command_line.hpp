// The command line of the program: what `main` does, as a function that a process may call more than once.
#pragma once

#include "core/modules.hpp"

namespace lampblack::app {

// Carries out one command line, whose first word is the program's name. Reports go to standard output, messages to
// standard error. MPI starts where the command needs it or a launcher started the process, and ends with the command,
// unless the caller has started it (ParallelSession). Collective where there are several ranks.
//
// Returns the exit code: 0 done; 2 the input is wrong; 3 the numbers or the machine (a full disk, no memory) failed;
// 128 plus its number after a signal; 1 a bug in Lampblack. An error that only some ranks have ends the process.
int runCommandLine(int argc, char** argv);

}  // namespace lampblack::app
