#include "app/shell/rank_launcher.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "app/shell/other_programs.hpp"
#include "core/errors.hpp"
#include "core/parallel_session.hpp"

namespace lampblack::app {
namespace {

constexpr const char* launchedByUs = "LAMPBLACK_LAUNCHED";

std::string launcher() {
  if (const char* chosen = std::getenv("LAMPBLACK_MPIRUN"); chosen != nullptr) {
    if (const auto found = findProgram(chosen)) return *found;
    throw InputError(fmt::format("LAMPBLACK_MPIRUN: there is no program '{}'", chosen));
  }
  for (const char* name : {"mpirun", LAMPBLACK_MPIEXEC, "mpiexec"})
    if (const auto found = findProgram(name)) return *found;
  throw InputError(
      "--ranks: several ranks need mpirun, which is not in PATH. Install it (Debian: openmpi-bin), or name it in "
      "LAMPBLACK_MPIRUN");
}

// A batch system has its say about processors, and there may be more machines than this one.
bool inAllocation() {
  for (const char* variable : {"SLURM_JOB_ID", "PBS_JOBID", "LSB_JOBID", "PE_HOSTFILE"})
    if (std::getenv(variable) != nullptr) return true;
  return false;
}

#ifdef OMPI_MAJOR_VERSION
// How Open MPI places ranks on the processors of this machine.
std::vector<std::string> placement(const std::string& mpirun, int ranks) {
  if (inAllocation()) return {};
  const std::vector<std::string> free{"--bind-to", "none", "--oversubscribe"};
  if (ranks > processors()) {
    std::cout << fmt::format("More ranks ({}) than processors ({}): they will take turns.\n", ranks, processors());
    return free;
  }
  // With room to spare a second run may start beside this one; bound ones would share the same few cores. Open MPI may
  // count fewer slots than there are processors (containers, hyper-threads).
  const std::vector<std::string> bound{"--bind-to", "core"};
  if (2 * ranks > processors() &&
      runQuietly({mpirun, "-n", std::to_string(ranks), bound[0], bound[1], "/bin/true"}) == 0)
    return bound;
  return free;
}

std::vector<std::string> launch(int ranks) {
  const std::string mpirun = launcher();
  if (geteuid() == 0) {
    // Open MPI refuses to run as root unless told twice; in a container there is often nobody else.
    for (const char* family : {"OMPI", "PRTE"}) {
      setUnlessSet(fmt::format("{}_ALLOW_RUN_AS_ROOT", family).c_str(), "1");
      setUnlessSet(fmt::format("{}_ALLOW_RUN_AS_ROOT_CONFIRM", family).c_str(), "1");
    }
  }
  // Between SIGTERM and SIGKILL mpirun leaves the ranks a quarter of a second, too little to keep what they have if it
  // is mpirun that gets a signal; and after any failure it waits twice that long, though no rank is left.
  for (const char* family : {"OMPI", "PRTE"})
    setUnlessSet(fmt::format("{}_MCA_odls_base_sigkill_timeout", family).c_str(), inAllocation() ? "5" : "1");
  // Open MPI 5 looks for a network between ranks of one machine, and says on standard error where it finds none.
  if (OMPI_MAJOR_VERSION >= 5 && !inAllocation()) setUnlessSet("OMPI_MCA_btl", "^tcp");
  std::vector<std::string> words{mpirun};
  if (OMPI_MAJOR_VERSION < 5) words.push_back("--quiet");  // about exit codes, which are the program's to explain
  words.insert(words.end(), {"-n", std::to_string(ranks)});
  for (const std::string& word : placement(mpirun, ranks)) words.push_back(word);
  return words;
}
#else
std::vector<std::string> launch(int ranks) {
  return {launcher(), "-n", std::to_string(ranks)};
}
#endif

}  // namespace

int processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

bool needsLauncher(int ranks) {
  return ranks > 1 && !startedByLauncher() && std::getenv(launchedByUs) == nullptr;
}

int runOnRanks(int ranks, std::span<char* const> commandLine) {
  std::vector<std::string> words = launch(ranks);
  words.push_back(std::filesystem::read_symlink("/proc/self/exe"));
  for (const char* word : commandLine.subspan(1)) words.emplace_back(word);
  // Linear algebra libraries start a thread a core in each rank; here each rank is one thread.
  setUnlessSet("OMP_NUM_THREADS", "1");
  setUnlessSet("OPENBLAS_NUM_THREADS", "1");
  setUnlessSet(launchedByUs, "1");
  // Ranks ask nothing, and a launcher in the background that reads a terminal is stopped.
  if (const int nothing = open("/dev/null", O_RDONLY); nothing > STDIN_FILENO) {
    dup2(nothing, STDIN_FILENO);
    close(nothing);
  }
  return runForDescendants(words);
}

void checkRanks(MPI_Comm comm, int ranks) {
  int size = 1;
  MPI_Comm_size(comm, &size);
  if (ranks == 0 || ranks == size) return;
  collectively(comm, [&] {
    throw InputError(fmt::format(
        "--ranks {}: the launcher made a run of {} rank(s). Leave --ranks out under mpirun or srun; a launcher of "
        "another MPI starts ranks that do not know of each other (LAMPBLACK_MPIRUN names the right one)",
        ranks, size));
  });
}

}  // namespace lampblack::app
