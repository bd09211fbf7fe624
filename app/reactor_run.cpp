#include "app/reactor_run.hpp"

#include <fmt/format.h>

#include <memory>

#include "app/reactor_case.hpp"
#include "app/reactor_driver.hpp"
#include "core/errors.hpp"

namespace lampblack {
namespace {

std::unique_ptr<ReactorDriver> driverOf(const ReactorCase& reactorCase) {
  switch (reactorCase.type) {
    case ReactorType::ConstantPressure:
    case ReactorType::ConstantVolume:
      return closedReactorDriver(reactorCase);
    case ReactorType::PlugFlow:
      return plugFlowDriver(reactorCase);
    case ReactorType::Stirred:
      return reactorCase.end > 0 ? stirredTransientDriver(reactorCase) : steadyNetworkDriver(reactorCase);
    case ReactorType::Network:
      return steadyNetworkDriver(reactorCase);
  }
  return nullptr;
}

}  // namespace

std::string checkReactor(MPI_Comm comm, const Deck& deck) {
  ReactorCase reactorCase;
  collectively(comm, [&] { reactorCase = readReactorCase(deck); });
  std::string text = deck.choice("reactor.type");
  if (reactorCase.type == ReactorType::Network) text += fmt::format(" of {}", reactorCase.network.reactors.size());
  return fmt::format("{}, {} species, {} reactions", text, reactorCase.mechanism->numSpecies(),
                     reactorCase.mechanism->numReactions());
}

void runReactor(MPI_Comm comm, const Deck& deck, const RunOptions& options) {
  ReactorCase reactorCase;
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  collectively(comm, [&] { reactorCase = readReactorCase(deck); });
  const std::unique_ptr<ReactorDriver> driver = driverOf(reactorCase);
  recordedRun(comm, deck, options, 0, [&](const RunFolder& folder, const RunInfo& info, RunRecord& record) {
    const double begin = MPI_Wtime();
    collectively(comm, [&] {
      if (rank != 0) return;
      driver->compute(folder);
      JsonWriter json;
      json.beginObject();
      driver->record(json);
      json.endObject();
      record.resultsJson = json.text();
      record.steps = driver->steps();
      record.simulatedTime = driver->simulatedTime();
      const double seconds = MPI_Wtime() - begin;
      record.stages = {{"integration", seconds, seconds, seconds}};
    });
    ResultsWriter results(comm, folder.results(), info);
    driver->write(results);
    results.close();
    record.peakMemoryPerRank = peakMemory(comm);
    if (rank == 0) driver->print();
  });
}

}  // namespace lampblack
