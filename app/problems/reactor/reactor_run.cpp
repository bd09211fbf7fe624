#include <fmt/format.h>

#include <memory>

#include "app/problems/reactor/reactor_case.hpp"
#include "app/problems/reactor/reactor_driver.hpp"
#include "app/run/prepared_run.hpp"
#include "core/errors.hpp"
#include "core/stop_request.hpp"
#include "io/table.hpp"

namespace lampblack::app {
namespace {

std::unique_ptr<ReactorDriver> driverOf(const ReactorCase& reactorCase) {
  if (reactorCase.ensemble) return ensembleReactorDriver(reactorCase);
  return reactorCase.kind->driver(reactorCase);
}

class PreparedReactor : public PreparedRunOf<ReactorCase> {
 public:
  PreparedReactor(MPI_Comm comm, const Deck& deck) : PreparedRunOf(comm, deck, readReactorCase) {
    collectively(comm, [&] { driver_ = driverOf(case_); });
  }

  [[nodiscard]] std::string summary() const override {
    std::string text = deck_.choice("reactor.type");
    if (!case_.kind->prefix(0).empty()) text += fmt::format(" of {}", case_.kind->reactors());
    return fmt::format("{}, {} species, {} reactions", text, case_.mechanism->numSpecies(),
                       case_.mechanism->numReactions());
  }

  void run(const RunOptions& options) override {
    recordedRun(comm_, deck_, options, 0, [&](const RunFolder& folder, const RunInfo& info, RunRecord& record) {
      runDriver(comm_, *driver_, folder, info, record);
    });
  }

 private:
  std::unique_ptr<ReactorDriver> driver_;
};

}  // namespace

void runDriver(MPI_Comm comm, ReactorDriver& driver, const RunFolder& folder, const RunInfo& info, RunRecord& record) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const double begin = MPI_Wtime();
  const auto measure = [&] {
    const double seconds = MPI_Wtime() - begin;
    record.stages = {{"integration", seconds, seconds, seconds}};
  };
  try {
    driver.run(comm, folder);
  } catch (const Stopped&) {
    measure();
    throw;
  }
  collectively(comm, [&] {
    if (rank != 0) return;
    record.resultsJson = jsonObject([&](JsonWriter& json) { driver.record(json); });
    record.steps = driver.steps();
    record.simulatedTime = driver.simulatedTime();
    measure();
  });
  ResultsWriter results(comm, folder.results(), info);
  driver.write(results);
  record.peakMemoryPerRank = peakMemory(comm);
  if (const int signal = agreedStopRequest(comm); signal != 0) {
    results.closePartial();
    raiseStopped(comm, signal,
                 fmt::format("at t = {:.6g} s: the rows until then are in {} and {}", driver.simulatedTime(),
                             folder.history().string(), folder.partialResults().string()));
  }
  results.close();
  if (rank == 0) driver.print();
}

std::unique_ptr<PreparedRun> prepareReactor(MPI_Comm comm, const Deck& deck) {
  return std::make_unique<PreparedReactor>(comm, deck);
}

}  // namespace lampblack::app
