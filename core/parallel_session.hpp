// MPI and PETSc, for as long as a program needs them. A process that no launcher started is a job of one rank: it
// starts without Open MPI's daemon, without a search for networks and without a folder for the session, in some 20 ms
// instead of 400 ms, and two such processes cannot take away each other's files.
#pragma once

namespace lampblack {

// Whether this process is a rank that a launcher started (mpirun, srun, ...), and others may be beside it.
bool startedByLauncher();

// Which rank of how many this process is; before MPI starts and after it ends, the only one.
struct Place {
  int rank = 0, ranks = 1;
};
Place placeOfProcess();

class ParallelSession {
 public:
  // Starts MPI and PETSc, whose errors come back as codes from then on. NumericsError where PETSc does not start. What
  // the user has set in the environment (OMPI_MCA_..., HWLOC_COMPONENTS) is kept.
  ParallelSession();
  // Ends both, collectively: no rank before all have come here.
  ~ParallelSession();
  ParallelSession(const ParallelSession&) = delete;
  ParallelSession& operator=(const ParallelSession&) = delete;

  // Whether MPI has started in this process and has not ended.
  static bool runs();
};

}  // namespace lampblack
