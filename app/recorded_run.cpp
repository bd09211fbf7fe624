#include "app/recorded_run.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include "app/build_info.hpp"

namespace lampblack {

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
  const RunFolder folder = RunFolder::prepare(options.folder, options.force, comm);

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
  const auto writeRecord = [&] {
    if (rank == 0) writeRunRecord(folder.runRecord(), record);
  };
  const auto finish = [&](RunStatus status, const std::string& message) {
    record.status = status;
    record.message = message;
    record.finished = utcNow();
    record.wallTime = MPI_Wtime() - start;
    writeRecord();
  };
  writeRecord();
  try {
    work(folder, {record.version, record.gitHash, deck.resolved(), record.started}, record);
    finish(RunStatus::done, "");
  } catch (const std::exception& error) {
    finish(RunStatus::failed, error.what());
    throw;
  }
  if (rank == 0) fmt::print("results in {}\n", folder.path().string());
}

}  // namespace lampblack
