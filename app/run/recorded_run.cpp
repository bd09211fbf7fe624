#include "app/run/recorded_run.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <new>
#include <optional>

#include "app/run/build_info.hpp"
#include "core/long_lines.hpp"
#include "core/stop_request.hpp"
#include "core/system_error.hpp"
#include "io/checkpoint_folder.hpp"
#include "io/disk_space.hpp"

namespace lampblack::app {

namespace {

// Whether a run continues in the folder that its checkpoint is from.
bool goesOnHere(const RunOptions& options) {
  if (!options.restart) return false;
  if (options.restart->empty()) return true;
  std::error_code error;
  return std::filesystem::equivalent(options.restart->parent_path(), CheckpointFolder(options.folder).path(), error);
}

}  // namespace

double peakMemory(MPI_Comm comm) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  double bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
  MPI_Allreduce(MPI_IN_PLACE, &bytes, 1, MPI_DOUBLE, MPI_MAX, comm);
  return bytes;
}

void recordedRun(MPI_Comm comm, const Deck& deck, const RunOptions& options, std::uint64_t seed, const RunWork& work) {
  const double start = MPI_Wtime();
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const RunFolder folder = goesOnHere(options) ? RunFolder::resume(options.folder, comm)
                                               : RunFolder::prepare(options.folder, options.force, comm);

  RunRecord record;
  record.deckPath = std::filesystem::absolute(deck.path()).string();
  record.deckJson = deck.resolvedJson();
  record.overrides = options.overrides;
  record.version = buildVersion();
  record.gitHash = buildGitHash();
  record.libraries = libraryVersions();
  record.seed = seed;
  record.started = utcNow();
  MPI_Comm_size(comm, &record.ranks);
  std::optional<SpareSpace> spare;  // so that a full disk does not keep the record from saying so
  const auto finish = [&](RunStatus status, const std::string& message) {
    record.status = status;
    record.message = withoutLongLines(message);
    record.finished = utcNow();
    record.wallTime = MPI_Wtime() - start;
    if (rank != 0) return;
    spare.reset();
    writeRunRecord(folder.runRecord(), record);
  };
  // What ends the run is told, not what may go wrong with its record.
  const auto finishBadly = [&](RunStatus status, const std::string& message) {
    try {
      finish(status, message);
    } catch (const std::exception&) {
      return;
    }
  };
  collectively(comm, [&] {
    if (rank != 0) return;
    constexpr std::int64_t results = std::int64_t{64} << 10;  // more than a run adds to its record
    spare.emplace(folder.path(), static_cast<std::int64_t>(toJson(record).size()) + results);
    writeRunRecord(folder.runRecord(), record);
  });
  try {
    work(folder, {record.version, record.gitHash, deck.resolved(), record.started}, record);
    collectively(comm, [&] { finish(RunStatus::done, ""); });
  } catch (const Stopped& stopped) {
    finishBadly(RunStatus::stopped, stopped.what());
    throw;
  } catch (const std::bad_alloc&) {
    finishBadly(RunStatus::failed, outOfMemory().what());
    throw;
  } catch (const std::exception& error) {
    finishBadly(RunStatus::failed, error.what());
    throw;
  }
  if (rank == 0) fmt::print("results in {}\n", folder.path().string());
}

}  // namespace lampblack::app
