#include "core/parallel_session.hpp"

#include <fmt/format.h>
#include <petscsys.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/petsc.hpp"

namespace lampblack {
namespace {

// What launchers tell each of their ranks: Open MPI's, those that speak PMIx, PMI-1 or PMI-2, IBM's.
constexpr std::array launcherVariables{"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE", "PMI_FD",
                                       "JSM_NAMESPACE_RANK"};

// A step of SLURM with several tasks that speaks none of these: MPI has to say so, rather than run the case in each
// task.
bool inStepOfSlurm() {
  const char* tasks = std::getenv("SLURM_STEP_NUM_TASKS");
  return tasks != nullptr && std::atoi(tasks) > 1;
}

// Unless the user has set it.
void set(const char* variable, const std::string& value) {
  constexpr int keepWhatIsSet = 0;
  setenv(variable, value.c_str(), keepWhatIsSet);
}

// Parameters of Open MPI (4 has all of them; 5 starts no daemon, and passes over what it does not know).
void startAlone() {
  set("OMPI_MCA_ess_singleton_isolated", "1");
  set("OMPI_MCA_pml", "ob1");
  set("OMPI_MCA_btl", "self");
  // All such processes believe that they are the same job: a folder for each, which Open MPI makes and takes away.
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (!error) set("OMPI_MCA_orte_top_session_dir", folder / fmt::format("lampblack.{}.{}", geteuid(), getpid()));
  // hwloc looks for displays and devices of the machine unless told not to.
  set("HWLOC_COMPONENTS", "-gl,-opencl,-cuda,-nvml,-rsmi,-levelzero,-pci,-linuxio");
}

}  // namespace

bool startedByLauncher() {
  return inStepOfSlurm() ||
         std::ranges::any_of(launcherVariables, [](const char* name) { return std::getenv(name) != nullptr; });
}

Place placeOfProcess() {
  Place place;
  if (!ParallelSession::runs()) return place;
  MPI_Comm_rank(MPI_COMM_WORLD, &place.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &place.ranks);
  return place;
}

ParallelSession::ParallelSession() {
  if (!startedByLauncher()) startAlone();
  // Nobody here shares a place in a file. Open MPI's default for those that do is a semaphore called by the file's bare
  // name, which a process that is killed leaves in /dev/shm: whoever opens a file of that name waits for ever.
  set("OMPI_MCA_sharedfp", "individual");
  // PETSc reads its own options from the environment and from a file, not from our command line.
  checkPetsc(PetscInitializeNoArguments());
  checkPetsc(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
}

ParallelSession::~ParallelSession() {
  // A rank that aborts while another ends MPI may leave mpirun waiting for ever (Open MPI 4.1 with PMIx 4.2: a tenth of
  // all such aborts; none while the other is in a barrier).
  MPI_Barrier(MPI_COMM_WORLD);
  static_cast<void>(PetscFinalize());  // it prints what went wrong
}

bool ParallelSession::runs() {
  int started = 0, ended = 0;
  MPI_Initialized(&started);
  MPI_Finalized(&ended);
  return started != 0 && ended == 0;
}

}  // namespace lampblack
